// The fuzz targets that read scenes and images, and the mutator that keeps the structure of glTF files.
#include "fuzz/replay.h"

#include "base/error.h"
#include "gltf_builder.h"
#include "scene/gltf/container.h"
#include "scene/gltf/document.h"

#include <cstdio>

namespace reflet::test::fuzz_replay_test {
namespace {

TEST(FuzzTargets, ThatReadScenesAndImagesSurviveTheirSeedsAndDamagedOnes) {
    fuzz::replay({{"gltf", fuzz::gltf},
                  {"draco", fuzz::draco},
                  {"meshopt", fuzz::meshopt},
                  {"fingerprint", fuzz::fingerprint},
                  {"png", fuzz::png},
                  {"jpeg", fuzz::jpeg},
                  {"webp", fuzz::webp},
                  {"ktx2", fuzz::ktx2},
                  {"hdr", fuzz::hdr},
                  {"exr", fuzz::exr},
                  {"view_file", fuzz::viewFile},
                  {"camera_path", fuzz::cameraPath}},
                 fuzz::sceneSeeds(), 120);
}

/// Whether all of the document's checks up to accessors and nodes pass.
bool opens(const std::filesystem::path& path) {
    try {
        GltfReport report(path.string(), {});
        (void)readGltfDocument(path, report);
        return true;
    } catch (const Error&) {
        return false;
    }
}

/// Strictly: a .glb whose lengths are wrong does not read.
bool containerReads(const std::filesystem::path& path) {
    try {
        GltfReport report(path.string(), {}, true);
        (void)readGltfContainer(path, report);
        return true;
    } catch (const Error&) {
        return false;
    }
}

TEST(GltfMutator, KeepsAllFilesReadableAndMostOfThemValidUpToTheirAccessors) {
    std::mt19937 random(3);
    const auto path = testFolder() / "scene.glb";
    int all = 0;
    int changed = 0;
    int open = 0;
    for (const fuzz::Seed& seed : fuzz::sceneSeeds()) {
        const auto original = fuzz::gltfParts(seed.bytes);
        if (seed.target != "gltf") {
            continue;
        }
        ASSERT_TRUE(original.has_value()) << seed.name;
        for (int i = 0; i < 100; ++i) {
            fuzz::GltfParts parts = *original;
            fuzz::mutateDocument(parts.document, random);
            writeBytes(path, fuzz::gltfFile(parts));
            ASSERT_TRUE(containerReads(path)) << parts.document;
            ++all;
            changed += parts.document != original->document ? 1 : 0;
            open += opens(path) ? 1 : 0;
        }
    }
    std::printf("of %d mutated files %d changed, %d open\n", all, changed, open);
    EXPECT_GT(changed, all * 3 / 4);
    EXPECT_GT(open, all / 3);
    EXPECT_LT(open, all);
}

TEST(GltfMutator, TakesNothingThatIsNoDocument) {
    for (const char* bytes : {"", "glTF", "[]", "{", "glTF\2\0\0\0\0\0\0\0"}) {
        EXPECT_FALSE(fuzz::gltfParts(bytes).has_value()) << bytes;
    }
    EXPECT_FALSE(fuzz::gltfParts(std::string(200, '[') + std::string(200, ']')).has_value());
}

}  // namespace
}  // namespace reflet::test::fuzz_replay_test
