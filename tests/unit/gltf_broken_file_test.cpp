// Invalid glTF containers and files: each is reported in one line, as an error or as a warning.
#include "base/error.h"
#include "gltf_builder.h"
#include "scene/gltf/report.h"

#include <gtest/gtest.h>

#include <ostream>

namespace reflet::test::gltf_broken_file_test {
namespace {

using nlohmann::json;

struct BrokenBytes {
    const char* name;
    std::string bytes;
    const char* starts;
    const char* consequence = nullptr;  ///< of the warning if loading is not strict; null: it is an error
};

std::ostream& operator<<(std::ostream& stream, const BrokenBytes& broken) {
    return stream << broken.name;
}

class BrokenGltfBytes : public ::testing::TestWithParam<BrokenBytes> {};

TEST_P(BrokenGltfBytes, AreReportedInOneLine) {
    const auto path = testFolder() / "scene.gltf";
    writeBytes(path, GetParam().bytes);
    expectProblem(path, GetParam().starts, GetParam().consequence);
}

std::string bytesName(const ::testing::TestParamInfo<BrokenBytes>& info) {
    return info.param.name;
}

std::string glbWith(size_t at, char value) {
    std::string bytes = triangle().glbBytes();
    bytes[at] = value;
    return bytes;
}

INSTANTIATE_TEST_SUITE_P(
    Container, BrokenGltfBytes,
    ::testing::Values(BrokenBytes{"Empty", "", "is empty"},
                      BrokenBytes{"DocumentIsAnArray", "[]", "JSON: is an array, not an object"},
                      BrokenBytes{"NotJson", "hello\n<world>", "JSON: is not valid JSON at line 1, byte 1 of 13"},
                      BrokenBytes{"HugeNumber", "{\"asset\":{},\n\"x\":-1e999}",
                                  "JSON: has a number beyond the range of doubles at line 2, byte 18 of 24"},
                      BrokenBytes{"CutOff", R"({"asset":)", "JSON: is not valid JSON at line 1"},
                      BrokenBytes{"NanLiteral", R"({"asset":{"version":NaN}})", "JSON: is not valid JSON"},
                      BrokenBytes{"NumberOverflow", R"({"asset":{"version":1e999}})", "JSON: "},
                      BrokenBytes{"BadUtf8", "{\"a\":\"\xFF\xFE\"}", "JSON: is not valid JSON"},
                      BrokenBytes{"DeepArrays", std::string(1000000, '['), "JSON: is nested more than 128 levels deep"},
                      BrokenBytes{"GlbHeaderOnly", "glTF\2", "GLB header: is truncated"},
                      BrokenBytes{"GlbVersion1", glbWith(4, 1), "GLB header: says version 1"},
                      BrokenBytes{"GlbLength", glbWith(11, 1), "GLB header: says the file has ",
                                  "what the file has will be read"},
                      BrokenBytes{"GlbFirstChunkLength", glbWith(15, 1), "GLB chunk: at byte 12 says it has "},
                      BrokenBytes{"GlbFirstChunkType", glbWith(16, 'X'), "GLB chunk: the first one is not JSON"},
                      BrokenBytes{"GlbMagic", glbWith(0, 'X'), "JSON: is not valid JSON"}),
    bytesName);

TEST(BrokenGltfFile, AMissingFileAndAFolderAreErrors) {
    const auto folder = testFolder();
    EXPECT_EQ(complaint(folder / "gone.gltf").rfind("there is no file", 0), 0U);
    EXPECT_NE(complaint(folder).find("is not a file"), std::string::npos);
}

TEST(BrokenGltfFile, ASymbolicLinkOutOfTheFolderIsRefused) {
    const auto folder = testFolder();
    std::filesystem::create_directories(folder / "inside");
    writeBytes(folder / "secret.png", "secret");
    std::filesystem::create_symlink(folder / "secret.png", folder / "inside" / "link.png");
    GltfBuilder b = everything();
    b.document["images"][0] = {{"uri", "link.png"}};
    const auto path = b.writeGltf(folder / "inside" / "scene.gltf");
    EXPECT_EQ(complaint(path), "images[0].uri: link.png leads out of the scene's folder");
}

TEST(BrokenGltfFile, ATruncatedBufferFileIsAnError) {
    const auto folder = testFolder();
    GltfBuilder b = triangle();
    writeBytes(folder / "short.bin", "1234567890");
    b.add("buffers", {{"byteLength", 36}, {"uri", "short.bin"}});
    EXPECT_EQ(complaint(b.writeGltf(folder / "scene.gltf")), "buffers[0]: has 10 bytes, but its byteLength is 36");
}

TEST(BrokenGltfFile, ASceneCannotTakeUnboundedMemory) {
    GltfReport report("scene.gltf", nullptr);
    report.charge("meshes[0]", 7ULL << 30U);
    EXPECT_NO_THROW(report.charge("meshes[1]", 1ULL << 30U));
    EXPECT_THROW(report.charge("meshes[2]", 1), Error);
    EXPECT_THROW(report.charge("meshes[2]", ~0ULL), Error);
}

TEST(BrokenGltfFile, AChainOfAHundredThousandNodesIsPlaced) {
    GltfBuilder b = triangle();
    for (int i = 1; i < 100000; ++i) {
        b.document["nodes"][static_cast<size_t>(i - 1)]["children"] = {i};
        b.add("nodes", {{"translation", {1, 0, 0}}});
    }
    b.document["nodes"][99999]["mesh"] = 0;
    const Scene scene = load(std::move(b)).scene;
    ASSERT_EQ(scene.instances.size(), 2U);
    EXPECT_EQ(vec3(scene.instances[1].objectToWorld[3]), vec3(99999, 0, 0));
}

TEST(BrokenGltfFile, ASceneOutOfRangeIsAUsageErrorThatSaysHowManyThereAre) {
    const auto path = triangle().writeGltf(testFolder() / "scene.gltf");
    try {
        loadGltf(path, {.scene = 3, .warn = nullptr});
        FAIL();
    } catch (const UsageError& error) {
        EXPECT_EQ(error.what(), path.string() + ": there is no scene 3: the file has 1 scene, numbered from 0");
    }
}

}  // namespace
}  // namespace reflet::test::gltf_broken_file_test
