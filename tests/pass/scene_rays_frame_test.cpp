// Whole frames with ray query against those with the BVH traversal in shaders.
#include "compare/compare.h"
#include "pass/harness.h"
#include "scene/builtin.h"
#include "support/device_fixture.h"

#include <cstdio>

namespace reflet::test::scene_rays_frame_test {
namespace {

constexpr uvec2 size(40, 22);

class SceneRaysInAFrame : public DeviceTest, public testing::WithParamInterface<const char*> {};

// Over 5 s: two tracers are compiled for every material feature of a scene. Colonnade: alpha cutouts. Lamps: shadow
// rays to many lamps. Mirror hall: multiple bounces between mirrors.
TEST_P(SceneRaysInAFrame, GiveTheSamePictureByQueryAndByTraversal) {
    if (!device().hasRayQuery()) {
        GTEST_SKIP() << "this device has no ray query";
    }
    const Scene scene = findBuiltinScene(GetParam())->make();
    const std::vector<std::string> layers{"direct", "indirect_diffuse"};
    const auto pictures = [&](const std::string& rayQuery) {
        return render(scene, defaultView(scene), size,
                      settingsOf({"trace_screen.enabled=off", "trace_scene.enabled=on", "trace_scene.light=path",
                                  "trace_scene.bounces=2", "shadow.filter=traced", "diffuse.rays=2", "specular.rays=0",
                                  "trace_scene.ray_query=" + rayQuery}),
                      layers);
    };
    const Pictures query = pictures("on");
    const Pictures traversal = pictures("off");
    for (const std::string& layer : layers) {
        const Difference d = compareImages(query.images.at(layer), traversal.images.at(layer), {}).difference;
        std::printf("%s %s: relative MSE %.2e, largest difference %.3g\n", GetParam(), layer.c_str(), d.relativeMse,
                    d.max);
        EXPECT_LT(d.relativeMse, 1e-3) << layer;
        EXPECT_NEAR(d.bias, 0.0, 1e-3) << layer;
        EXPECT_GT(rangeOf(traversal.images.at(layer)).max, 0.1F) << layer;
    }
    expectSilentValidation(GetParam());
}

INSTANTIATE_TEST_SUITE_P(Scenes, SceneRaysInAFrame, testing::Values("colonnade", "lamps", "mirror-hall"),
                         [](const auto& scene) {
                             std::string name = scene.param;
                             std::erase(name, '-');
                             return name;
                         });

}  // namespace
}  // namespace reflet::test::scene_rays_frame_test
