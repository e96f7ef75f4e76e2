// Live images: the view of one of the scene's cameras, shown on a surface.
#include "compare/compare.h"
#include "pass/harness.h"
#include "support/device_fixture.h"

#include <cmath>

namespace reflet::test::live_test {
namespace {

constexpr uvec2 size(160, 90);

Material glowing(const vec3& radiance) {
    Material m = lambertMaterial(vec3(0.0F));
    m.metallic = 1.0F;
    m.emissive = radiance;
    return m;
}

// Two glowing boxes that the camera "door" sees, and elsewhere a monitor, 3.2 m by 1.8 m, that shows them.
Scene sceneWithMonitor(const std::string& camera) {
    Scene scene = sceneOf(glowing({1.0F, 0.25F, 0.5F}), builtin::box({0.6F, 0.4F, 0.3F}));
    builtin::place(scene, "other", builtin::addMaterial(scene, glowing({0.25F, 2.0F, 0.0F})), builtin::box(vec3(0.3F)),
                   builtin::at({1.2F, 0.5F, -0.5F}));
    Material monitor = glowing(vec3(0.0F));
    monitor.camera = camera;
    builtin::place(scene, "monitor", builtin::addMaterial(scene, monitor),
                   builtin::patch({{20, 0, 0}, {1.6F, 0, 0}, {0, 0.9F, 0}, {1, 1}, {1, 1}}));
    scene.cameras.push_back(builtin::camera("door", {0.4F, 0.8F, 3}, {0.2F, 0.1F, 0}, 50));
    return scene;
}

View viewOf(const Camera& camera) {
    View view;
    view.camera = camera;
    return view;
}

// Only the monitor, edge to edge.
View viewOfMonitor() {
    Camera camera = builtin::camera("", {20, 0, 2}, {20, 0, 0}, 50);
    camera.orthographicHeight = 1.8F;
    return viewOf(camera);
}

TEST(Live, AMonitorShowsWhatItsCameraSees) {
    const Scene scene = sceneWithMonitor("door");
    const Settings settings = settingsOf({"live.height=90"});
    const Pictures seen = render(scene, viewOf(scene.cameras[0]), size, settings, {"direct"});
    const Pictures monitor = render(scene, viewOfMonitor(), size, settings, {"direct"});
    const Difference d = compareImages(monitor.images.at("direct"), seen.images.at("direct"), {}).difference;
    EXPECT_GT(rangeOf(seen.images.at("direct")).max, 1.9F);
    EXPECT_LT(std::abs(d.bias), 0.005);
    EXPECT_GT(d.psnr, 30.0);  // at edges, a texture's filter mixes in some of the next pixel
    expectSilentValidation("a monitor");
}

TEST(Live, AMonitorThatSeesItselfIsOneFrameLate) {
    Scene scene = sceneWithMonitor("self");
    scene.cameras.push_back(viewOfMonitor().camera);
    scene.cameras.back().name = "self";
    scene.cameras.back().position.x = 20.8F;  // its left half is the monitor's right one, its right half the background
    scene.cameras.back().target.x = 20.8F;
    View view = viewOfMonitor();
    view.environment.radiance = vec3(0.5F);
    const auto brightColumns = [&](uint32_t frames) {
        const Pictures p = render(scene, view, size, settingsOf({}), {"direct"}, frames);
        unsigned count = 0;
        for (unsigned x = 0; x < size.x; ++x) {
            count += p.value("direct", x, size.y / 2) > 0.4F ? 1 : 0;
        }
        return count;
    };
    EXPECT_NEAR(brightColumns(1), 40, 1);
    EXPECT_NEAR(brightColumns(2), 80, 1);  // what it showed before, once more, a quarter to the left
    expectSilentValidation("a monitor that sees itself");
}

class LiveWarnings : public DeviceTest {};

TEST_F(LiveWarnings, NameTheCamerasThatThereAre) {
    std::vector<std::string> heard;
    const Scene scene = sceneWithMonitor("dor");
    const Renderer renderer(device(), scene, [&](const std::string& text) { heard.push_back(text); });
    ASSERT_EQ(heard.size(), 1U);
    EXPECT_NE(heard[0].find("'dor'"), std::string::npos) << heard[0];
    EXPECT_NE(heard[0].find("'door'"), std::string::npos) << heard[0];
}

}  // namespace
}  // namespace reflet::test::live_test
