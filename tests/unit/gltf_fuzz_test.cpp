// Fuzzing: loading thousands of damaged glTF files returns a valid scene or throws Error.
#include "base/error.h"
#include "gltf_encoders.h"
#include "scene/pose.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace reflet::test::gltf_fuzz_test {
namespace {

bool isFinite(const vec3& v) {
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

void expectSound(const Scene& scene) {
    for (const Mesh& mesh : scene.meshes) {
        ASSERT_EQ(mesh.attributes.size(), mesh.positions.size());
        ASSERT_LT(mesh.material, scene.materials.size());
        for (size_t v = 0; v < mesh.positions.size(); ++v) {
            ASSERT_TRUE(isFinite(mesh.positions[v]));
            ASSERT_NEAR(glm::length(mesh.attributes[v].normal), 1.0F, 1e-4F);
            ASSERT_NEAR(glm::length(vec3(mesh.attributes[v].tangent)), 1.0F, 1e-4F);
        }
        for (const uint32_t index : mesh.indices) {
            ASSERT_LT(index, mesh.positions.size());
        }
    }
    for (const Instance& instance : scene.instances) {
        ASSERT_LT(instance.mesh, scene.meshes.size());
        ASSERT_TRUE(isFinite(vec3(instance.objectToWorld[3])));
    }
    for (const double time : {0.0, 1.3}) {
        const ScenePose pose = scenePose(scene, time);
        ASSERT_TRUE(std::isfinite(pose.time));
        for (size_t i = 0; i < scene.instances.size(); ++i) {
            ASSERT_TRUE(isFinite(vec3(pose.objectToWorld[i][3])));
            ASSERT_EQ(worldPositions(scene, pose, i).size(), scene.meshes[scene.instances[i].mesh].positions.size());
        }
    }
}

/// Whether it loads.
bool survives(const std::filesystem::path& path, const std::string& bytes) {
    writeBytes(path, bytes);
    try {
        expectSound(loadGltf(path));
        return true;
    } catch (const Error& error) {
        EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos) << error.what();
        return false;
    }
}

TEST(GltfFuzz, AGlbThatIsCutOffAnywhereIsAnError) {
    const std::string whole = everything().glbBytes();
    const auto path = testFolder() / "scene.glb";
    ASSERT_TRUE(survives(path, whole));
    for (size_t length = 0; length < whole.size(); ++length) {
        ASSERT_FALSE(survives(path, whole.substr(0, length))) << length;
    }
}

TEST(GltfFuzz, AGltfThatIsCutOffAnywhereIsAnError) {
    const std::string whole = everything().gltfBytes();
    const auto path = testFolder() / "scene.gltf";
    ASSERT_TRUE(survives(path, whole));
    for (size_t length = 0; length < whole.size(); ++length) {
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

TEST(GltfFuzz, DamagedBytesNeverDoMoreThanThrow) {
    std::mt19937 random(1);
    const auto folder = testFolder();
    for (const std::string& whole : {everything().glbBytes(), everything().gltfBytes(), slider().gltfBytes(),
                                     bent().gltfBytes(), morphing().gltfBytes(), compressed().gltfBytes()}) {
        int loaded = 0;
        for (int i = 0; i < 2000; ++i) {
            loaded += survives(folder / "scene.gltf", damaged(whole, random)) ? 1 : 0;
        }
        EXPECT_GT(loaded, 10);  // not always fatal: otherwise only the first check would be tested
    }
}

/// Replaces one number of the document, which random bytes rarely do.
TEST(GltfFuzz, NumbersThatAreReplacedNeverDoMoreThanThrow) {
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
