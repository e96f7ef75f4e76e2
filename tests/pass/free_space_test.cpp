// Random cameras of data sets: in free space, and looking at something.
#include "dataset/free_space.h"

#include "pass/harness.h"
#include "scene/builtin.h"

namespace reflet::test::free_space_test {
namespace {

TEST(FreeSpace, CamerasOfARoomAreInsideItAndOutsideOfWhatStandsThere) {
    const Scene scene = findBuiltinScene("cornell")->make();
    const RayScene rays(scene);
    const Camera start = defaultView(scene).camera;
    const Distribution fov = parseDistribution("--fov", "40..65", fovDistributions(), 1, 170);
    uint32_t tries = 0;
    for (uint64_t burst = 0; burst < 40; ++burst) {
        Draws draws(1, burst);
        const auto found = findCamera(rays, start, 16.0F / 9.0F, {}, fov, draws);
        ASSERT_TRUE(found) << burst;
        tries += found->tries;
        EXPECT_GE(found->camera.fovY, glm::radians(40.0F));
        EXPECT_LE(found->camera.fovY, glm::radians(65.0F));
        // Nothing is at arm's length, and no back face is seen from inside of an object.
        for (const vec3 way : {vec3(1, 0, 0), vec3(-1, 0, 0), vec3(0, 1, 0), vec3(0, -1, 0), vec3(0, 0, 1)}) {
            const auto hit = rays.intersect({found->camera.position, way}, RayKind::light);
            if (hit) {
                EXPECT_GT(hit->distance, 4.0F * start.near) << burst;
            }
        }
        Draws again(1, burst);
        EXPECT_EQ(findCamera(rays, start, 16.0F / 9.0F, {}, fov, again)->camera, found->camera);
    }
    EXPECT_LT(tries, 40U * 60U);
}

TEST(FreeSpace, HeightsAreAboveTheFloor) {
    const Scene scene = findBuiltinScene("cubes")->make();
    const RayScene rays(scene);
    const Camera start = defaultView(scene).camera;
    const Distribution height = parseDistribution("--height", "0.5..1", heightDistributions(), 0.001, 1e6);
    const Distribution fov = parseDistribution("--fov", "normal", fovDistributions(), 1, 170);
    for (uint64_t burst = 0; burst < 10; ++burst) {
        Draws draws(2, burst);
        const auto found = findCamera(rays, start, 16.0F / 9.0F, height, fov, draws);
        ASSERT_TRUE(found) << burst;
        const auto floor = rays.intersect({found->camera.position, vec3(0, -1, 0)}, RayKind::light);
        ASSERT_TRUE(floor) << burst;
        EXPECT_GE(floor->distance, 0.499F) << burst;
        EXPECT_LE(floor->distance, 1.001F) << burst;
    }
}

TEST(FreeSpace, AWallInTheFaceIsRefused) {
    const Scene scene = findBuiltinScene("cornell")->make();
    const RayScene rays(scene);
    Draws draws(3, 0);
    CameraLimits limits;
    limits.near = 1e6F;  // everything is in the way
    EXPECT_FALSE(
        findCamera(rays, defaultView(scene).camera, 1.0F, {}, fovDistributions()[0].distribution, draws, limits));
}

}  // namespace
}  // namespace reflet::test::free_space_test
