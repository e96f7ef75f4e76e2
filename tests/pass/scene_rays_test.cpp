// Ray tracing on the device: 400,000 rays through each scene against Embree; and ray query against the BVH traversal,
// on devices that support it.
#include "pass/scene_rays_harness.h"

#include "scene/builtin.h"
#include "scene/gltf/gltf.h"
#include "support/swept_scenes.h"

#include <cstdlib>
#include <filesystem>
#include <iostream>

namespace reflet::test::scene_rays_test {
namespace {

constexpr size_t rayCount = 400000;
constexpr size_t otherwiseAtMost = rayCount / 10000;

// Also prints the differences.
void expectSame(const std::string& name, const HitDifference& d) {
    std::cout << name << ": " << d << '\n';
    EXPECT_LE(d.other, otherwiseAtMost) << name;
    EXPECT_EQ(d.any, 0U) << name;
    EXPECT_LT(d.distance, 3.0) << name;
    EXPECT_LT(d.barycentric, 2e-3) << name;
}

// Files named by REFLET_TEST_SCENES, with colons between them.
std::vector<std::filesystem::path> filesToTest() {
    const char* list = std::getenv("REFLET_TEST_SCENES");
    std::vector<std::filesystem::path> files;
    std::istringstream text(list != nullptr ? list : "");
    for (std::string file; std::getline(text, file, ':');) {
        files.emplace_back(file);
    }
    return files;
}

class SceneRaysBothWays : public SceneRaysTest {
protected:
    // Traversal against Embree, and ray query against traversal where the device has it.
    static void expectSameOf(const std::string& name, const Scene& scene) {
        const auto rays = randomRays(scene, rayCount);
        const auto hits = trace(SceneRays(device(), scene, RayMethod::traversal), rays);
        const HitDifference d = difference(scene, rays, traceWithEmbree(scene, rays), hits);
        expectSame(name, d);
        EXPECT_EQ(d.elsewhere, 0U) << name;
        if (hasRayQuery()) {
            const auto queried = trace(SceneRays(device(), scene, RayMethod::query), rays);
            expectSame(name + " by ray query", difference(scene, rays, hits, queried));
        }
    }
};

class SceneRaysOfScene : public SceneRaysBothWays, public ::testing::WithParamInterface<std::string> {};

// Over 5 s: many rays, of which a few graze edges.
TEST_P(SceneRaysOfScene, HitWhatEmbreeHits) {
    expectSameOf(GetParam(), withoutCutOuts(findBuiltinScene(GetParam())->make()));
}

INSTANTIATE_TEST_SUITE_P(Builtin, SceneRaysOfScene, ::testing::ValuesIn(sweptScenes()),
                         [](const auto& chosen) { return nameInTests(chosen.param); });

using SceneRaysOfFile = SceneRaysBothWays;

TEST_F(SceneRaysOfFile, HitWhatEmbreeHits) {
    const auto files = filesToTest();
    if (files.empty()) {
        GTEST_SKIP() << "REFLET_TEST_SCENES names no scene files";
    }
    for (const auto& file : files) {
        expectSameOf(file.filename(), withoutCutOuts(loadGltf(file)));
    }
}

}  // namespace
}  // namespace reflet::test::scene_rays_test
