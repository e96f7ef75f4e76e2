// Traces rays through a scene on the device.
#pragma once

#include "pass/scene_rays_test.h"
#include "render/trace_scene/scene_rays.h"
#include "support/device_fixture.h"

#include <vector>

namespace reflet::test {

class SceneRaysTest : public DeviceTest {
protected:
    static void SetUpTestSuite();
    /// What each ray hits; `passMs`: device time.
    static std::vector<TestHit> trace(const SceneRays& scene, const std::vector<TestRay>& rays,
                                      double* passMs = nullptr, uint32_t which = 3);
    /// Origins in the scene's bounds grown by a tenth, directions over the sphere.
    static std::vector<TestRay> randomRays(const Scene& scene, size_t count);
};

/// The scene with all materials whole.
Scene withoutCutOuts(Scene scene);

}  // namespace reflet::test
