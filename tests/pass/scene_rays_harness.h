// Traces rays through a scene on the device and by Embree, and compares what they hit.
#pragma once

#include "pass/scene_rays_test.h"
#include "renderer/trace_scene/scene_rays.h"
#include "support/device_fixture.h"

#include <iosfwd>
#include <vector>

namespace reflet::test {

class SceneRaysTest : public DeviceTest {
protected:
    static void SetUpTestSuite();
    /// What each ray hits.
    static std::vector<TestHit> trace(const SceneRays& scene, const std::vector<TestRay>& rays);
    static bool hasRayQuery();
};

/// Origins in the scene's bounds grown by a tenth on each side, directions over the sphere.
std::vector<TestRay> randomRays(const Scene& scene, size_t count);

std::vector<TestHit> traceWithEmbree(const Scene& scene, const std::vector<TestRay>& rays);

/// Differences between two ways to trace the same rays.
struct HitDifference {
    size_t rays = 0;
    size_t hits = 0;  ///< of the first way
    /// Not the same triangle, or only one way hits. Not counted: two triangles on top of each other, of which either
    /// is right.
    size_t other = 0;
    size_t oneOnly = 0;        ///< of those: only one way hits
    size_t elsewhere = 0;      ///< of those: both hit, but not at the same distance, either
    size_t coincident = 0;     ///< triangles on top of each other
    size_t any = 0;            ///< anyHit and closestHit do not agree, one way or the other
    double distance = 0.0;     ///< largest difference where they are the same, in what rounding may come to
    double barycentric = 0.0;  ///< largest, where the triangle is the same
};
std::ostream& operator<<(std::ostream& out, const HitDifference& difference);

HitDifference difference(const Scene& scene, const std::vector<TestRay>& rays, const std::vector<TestHit>& one,
                         const std::vector<TestHit>& another);

/// The scene with all materials whole and opaque.
Scene withoutCutOuts(Scene scene);

}  // namespace reflet::test
