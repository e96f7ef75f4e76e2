// Rays through the scene's triangles on the device against Embree's.
#include "pass/scene_rays_harness.h"

#include "base/error.h"
#include "reference/ray_scene.h"
#include "scene/builtin.h"
#include "scene/gltf.h"

#include <chrono>

namespace reflet::test {
namespace {

// How two ways of tracing the same rays differ.
struct Difference {
    size_t hits = 0;
    size_t triangles = 0;  ///< both hit, but not the same triangle
    size_t found = 0;      ///< one hits, the other does not
    size_t any = 0;        ///< anyHit and closestHit do not agree
    size_t far = 0;        ///< distances differ by more than rounding
    double distance = 0;   ///< largest relative difference of distances, where triangles are the same
    double barycentrics = 0;
};

std::vector<uint32_t> firstIndices(const Scene& scene) {
    std::vector<uint32_t> first;
    uint32_t sum = 0;
    for (const Mesh& mesh : scene.meshes) {
        first.push_back(sum);
        sum += static_cast<uint32_t>(mesh.indices.size());
    }
    return first;
}

Difference compareWithEmbree(const Scene& scene, const std::vector<TestRay>& rays, const std::vector<TestHit>& hits) {
    const RayScene embree(scene);
    const std::vector<uint32_t> first = firstIndices(scene);
    Difference d;
    for (size_t i = 0; i < rays.size(); ++i) {
        const TestHit& h = hits[i];
        const auto truth = embree.intersect({rays[i].origin, rays[i].direction}, RayKind::light);
        d.any += h.any != h.found;
        d.hits += truth.has_value();
        if (truth.has_value() != (h.found != 0)) {
            ++d.found;
        } else if (truth) {
            const double apart = std::abs(h.distance - truth->distance);
            const double limit = 1e-5 * (1.0 + truth->distance);
            d.far += apart > limit;
            if (h.instance != truth->instance ||
                h.firstIndex != first[scene.instances[h.instance].mesh] + 3 * truth->triangle) {
                ++d.triangles;
            } else {
                d.distance = std::max(d.distance, apart / (1.0 + truth->distance));
                d.barycentrics = std::max<double>(d.barycentrics, glm::length(h.barycentrics - truth->barycentric));
            }
        }
    }
    return d;
}

class SceneRaysOfScene : public SceneRaysTest, public ::testing::WithParamInterface<BuiltinScene> {};

TEST_P(SceneRaysOfScene, HitTheTrianglesThatEmbreeHits) {
    const Scene scene = withoutCutOuts(GetParam().make());
    const auto t0 = std::chrono::steady_clock::now();
    const SceneRays device(SceneRaysTest::device(), scene);
    const auto t1 = std::chrono::steady_clock::now();
    const auto rays = randomRays(scene, 1000000);
    double closestMs = 0, anyMs = 0;
    trace(device, rays, &closestMs, 1);
    trace(device, rays, &anyMs, 2);
    const Difference d = compareWithEmbree(scene, rays, trace(device, rays));
    fmt::print("{}: {} triangles, build {:.3f} s, closest {:.0f} ms, any {:.0f} ms; {} hit; {} other triangles, {} one only, {} any, {} far, dist {:.1e} bary {:.1e}\n",
               GetParam().name, device.triangleCount(), std::chrono::duration<double>(t1 - t0).count(), closestMs,
               anyMs, d.hits, d.triangles, d.found, d.any, d.far, d.distance, d.barycentrics);
    EXPECT_LE(d.triangles + d.found, rays.size() / 10000);
    EXPECT_LE(d.far, 0U);
    EXPECT_LE(d.any, 0U);
}

std::string sceneName(const ::testing::TestParamInfo<BuiltinScene>& scene) {
    std::string name(scene.param.name);
    std::erase(name, '-');
    return name;
}

INSTANTIATE_TEST_SUITE_P(Builtin, SceneRaysOfScene, ::testing::ValuesIn(builtinScenes().begin(), builtinScenes().end()), sceneName);

}  // namespace
}  // namespace reflet::test
