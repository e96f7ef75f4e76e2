// Fuzzing: loading thousands of damaged glTF files returns a valid scene or throws Error.
#include "base/error.h"
#include "gltf_encoders.h"
#include "gltf_showcase.h"
#include "valid_scene.h"

#include <gtest/gtest.h>

#include <random>

namespace reflet::test::gltf_fuzz_test {
namespace {

/// The parameter: whether loading is strict.
class GltfFuzz : public ::testing::TestWithParam<bool> {};

INSTANTIATE_TEST_SUITE_P(Strictness, GltfFuzz, ::testing::Values(true, false),
                         [](const auto& test) { return test.param ? "Strict" : "Forgiving"; });

/// Whether it loads. Without an error, the scene must be valid.
bool survives(const std::filesystem::path& path, const std::string& bytes) {
    writeBytes(path, bytes);
    try {
        const Scene scene = loadGltf(path, {.strict = GltfFuzz::GetParam()});
        expectValid(scene);
        return true;
    } catch (const Error& error) {
        EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos) << error.what();
        return false;
    }
}

TEST_P(GltfFuzz, AGlbThatIsCutOffIsAnErrorUnlessPartOfItCanBeDrawn) {
    const std::string whole = everything().glbBytes();
    const auto path = testFolder() / "scene.glb";
    ASSERT_TRUE(survives(path, whole));
    size_t drawn = 0;
    for (size_t length = GetParam() ? 0 : 1; length < whole.size(); length += 2) {
        drawn += survives(path, whole.substr(0, length)) ? 1 : 0;
    }
    EXPECT_EQ(drawn > 0, !GetParam());
}

TEST_P(GltfFuzz, AGltfThatIsCutOffAnywhereIsAnError) {
    const std::string whole = everything().gltfBytes();
    const auto path = testFolder() / "scene.gltf";
    ASSERT_TRUE(survives(path, whole));
    for (size_t length = GetParam() ? 0 : 1; length < whole.size(); length += 2) {
        ASSERT_FALSE(survives(path, whole.substr(0, length))) << length;
    }
}

/// Changes one to four bytes: flips a bit, or sets a random byte or digit.
std::string damaged(std::string bytes, std::mt19937& random) {
    const unsigned changes = 1 + random() % 4;
    for (unsigned i = 0; i < changes; ++i) {
        char& byte = bytes[random() % bytes.size()];
        switch (random() % 3) {
            case 0:
                byte = static_cast<char>(static_cast<unsigned char>(byte) ^ 1U << random() % 8);
                break;
            case 1:
                byte = static_cast<char>(random() % 256);
                break;
            default:
                byte = static_cast<char>('0' + random() % 10);
        }
    }
    return bytes;
}

// Over 5 s: four thousand files.
TEST_P(GltfFuzz, DamagedBytesNeverDoMoreThanThrow) {
    std::mt19937 random(1);
    const auto folder = testFolder();
    for (auto& [name, builder] : showcase()) {
        const std::string whole = name == "everything" ? builder.glbBytes() : builder.gltfBytes();
        int loaded = 0;
        for (int i = 0; i < 500; ++i) {
            loaded += survives(folder / "scene.gltf", damaged(whole, random)) ? 1 : 0;
        }
        EXPECT_GT(loaded, 10) << name;  // not always fatal: otherwise only the first check would be tested
    }
}

/// Replaces one number of the document, which random bytes rarely do.
TEST_P(GltfFuzz, NumbersThatAreReplacedNeverDoMoreThanThrow) {
    using nlohmann::json;
    const std::array<json, 12> values{0, 1, 2, 3, -1, 255, 256, 65535, 5121, 1e30, 4294967295U, 18446744073709551615U};
    const auto path = testFolder() / "scene.glb";
    for (const GltfBuilder& original : {everything(), morphing(), compressed()}) {
        const json flat = original.document.flatten();
        for (const auto& [pointer, value] : flat.items()) {
            for (size_t i = 0; value.is_number() && i < values.size(); ++i) {
                GltfBuilder b = original;
                b.document[json::json_pointer(pointer)] = values.at(i);
                survives(path, b.glbBytes());
            }
        }
    }
}

}  // namespace
}  // namespace reflet::test::gltf_fuzz_test
