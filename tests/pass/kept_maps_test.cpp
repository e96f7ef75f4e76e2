// Cached shadow maps: they are drawn again when their contents have changed, and only then.
#include "pass/harness.h"
#include "scene/builtin.h"
#include "support/device_fixture.h"

#include <algorithm>
#include <string_view>

namespace reflet::test::kept_maps_test {
namespace {

class KeptMaps : public DeviceTest {
protected:
    static constexpr uvec2 size{60, 34};

    /// Whether a frame of the view records the pass.
    bool draws(const View& view, std::string_view pass = "shadow_map") {
        renderer_.render(view, size, 0, settings_);
        const auto& times = renderer_.frame().passTimes();
        return std::ranges::find(times, pass, &gpu::PassTime::name) != times.end();
    }

    Scene scene_ = *makeBuiltinScene("moving");
    Settings settings_ = settingsOf({"diffuse.rays=0", "specular.rays=0", "shadow.resolution=256"});
    Renderer renderer_{device(), scene_, [](const std::string&) {}};
    View view_ = defaultView(scene_);
};

TEST_F(KeptMaps, TheSunsIsDrawnOnceWhileNothingMoves) {
    EXPECT_TRUE(draws(view_));
    EXPECT_FALSE(draws(view_));
    EXPECT_FALSE(draws(view_));
}

TEST_F(KeptMaps, TheSunsIsDrawnOnceWhileOnlyTheJitterChanges) {
    for (const std::string cascades : {"1", "3"}) {
        settings_ = settingsOf({"diffuse.rays=0", "specular.rays=0", "shadow.resolution=256", "temporal.enabled=true",
                                "shadow.cascades=" + cascades});
        EXPECT_TRUE(draws(view_)) << cascades;
        EXPECT_FALSE(draws(view_)) << cascades;
        EXPECT_FALSE(draws(view_)) << cascades;
    }
}

TEST_F(KeptMaps, TheSunsIsDrawnAgainWhenTheSunOrAThingOrItsSizeChanges) {
    draws(view_);
    view_.sun.direction = glm::normalize(view_.sun.direction + vec3(0.1F, 0.0F, 0.0F));
    EXPECT_TRUE(draws(view_));
    view_.time = 0.5;
    EXPECT_TRUE(draws(view_));
    EXPECT_FALSE(draws(view_));
    view_.time = 0.25;
    EXPECT_TRUE(draws(view_));
    settings_.shadow.resolution = 128;
    EXPECT_TRUE(draws(view_));
    EXPECT_FALSE(draws(view_));
}

TEST_F(KeptMaps, AfterACutAllAreDrawn) {
    draws(view_);
    renderer_.restart(0);
    EXPECT_TRUE(draws(view_));
}

TEST_F(KeptMaps, AShadowThatMovedIsWhereItIsInAFrameOfItsOwn) {
    view_.time = 0.2;
    View later = view_;
    later.time = 0.6;
    const Pictures moved = renderPath(scene_, {view_, view_, later}, size, settings_, {"final"}).back();
    const Pictures alone = render(scene_, later, size, settings_, {"final"});
    EXPECT_EQ(moved.images.at("final").data, alone.images.at("final").data);
}

TEST_F(KeptMaps, ThoseOfLampsAreDrawnOnceWhileNothingMoves) {
    const Scene lit = *makeBuiltinScene("lamps");
    Renderer renderer(device(), lit, [](const std::string&) {});
    const auto drawsLamps = [&](const View& view) {
        renderer.render(view, size, 0, settings_);
        const auto& times = renderer.frame().passTimes();
        return std::ranges::find(times, "lamp_shadow_map", &gpu::PassTime::name) != times.end();
    };
    const View view = defaultView(lit);
    EXPECT_TRUE(drawsLamps(view));
    EXPECT_FALSE(drawsLamps(view));
    settings_.shadow.lampResolution = 128;
    EXPECT_TRUE(drawsLamps(view));
}

TEST_F(KeptMaps, ThoseOfADirectionalLampAreDrawnAgainOnlyAfterSomeWayOfTheCamera) {
    Scene lit = *makeBuiltinScene("lamps");
    Lamp lamp;
    lamp.type = Lamp::Type::directional;
    lamp.direction = glm::normalize(vec3(0.3F, -1.0F, 0.2F));
    lit.lamps = {lamp};
    Renderer renderer(device(), lit, [](const std::string&) {});
    View view = defaultView(lit);
    unsigned drawn = 0;
    const float step = 0.002F * glm::distance(view.camera.position, view.camera.target);
    for (int i = 0; i < 40; ++i) {
        view.camera.position.x += step;
        view.camera.target.x += step;
        renderer.render(view, size, 0, settings_);
        const auto& times = renderer.frame().passTimes();
        drawn += std::ranges::find(times, "lamp_shadow_map", &gpu::PassTime::name) != times.end() ? 1U : 0U;
    }
    EXPECT_GT(drawn, 1U);
    EXPECT_LT(drawn, 12U);
}

}  // namespace
}  // namespace reflet::test::kept_maps_test
