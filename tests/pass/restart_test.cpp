// A restarted renderer gives the same frames as a new one, whatever it rendered before.
#include "capture/show.h"
#include "pass/harness.h"
#include "scene/builtin.h"
#include "support/device_fixture.h"
#include "support/swept_scenes.h"

namespace reflet::test::restart_test {
namespace {

constexpr uvec2 size(36, 20);

class Restart : public DeviceTest {
protected:
    static FloatImage last(Renderer& renderer, const View& view, const Settings& settings, int frames) {
        ShowReadback readback;
        for (int i = 0; i < frames; ++i) {
            renderer.render(view, size, 0, settings, [&](gpu::Frame& f, const FrameImages& images) {
                readback = requestShow(f, images, findShow("final"));
            });
        }
        return fetchValues(renderer.frame(), readback, makeViewParams(view.camera, size, 0, 0));
    }
};

TEST_F(Restart, SettingsAndViewsFromBeforeLeaveNothing) {
    const Scene scene = findBuiltinScene("cubes")->make();
    const View view = defaultView(scene);
    View other = view;
    other.camera.position += vec3(0.5F, 0.2F, 0.0F);
    const Settings plain = smallPreset("balanced");
    Settings adaptive = plain;
    adaptive.diffuse.adaptive = 1;
    adaptive.tonemap.exposure = -2.0F;
    for (const auto& [before, after] : {std::pair(plain, adaptive), std::pair(adaptive, plain)}) {
        Renderer used(device(), scene, [](const std::string&) {});
        last(used, view, before, 7);
        last(used, other, after, 5);
        used.restart(0);
        Renderer fresh(device(), scene, [](const std::string&) {});
        EXPECT_EQ(last(used, view, after, 6).data, last(fresh, view, after, 6).data);
    }
}

}  // namespace
}  // namespace reflet::test::restart_test
