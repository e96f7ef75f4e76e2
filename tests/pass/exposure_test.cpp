// Automatic exposure of frames.
#include "effects/exposure/exposure.h"

#include "capture/show.h"
#include "pass/harness.h"
#include "renderer/history.h"
#include "renderer/scene_exposure/scene_exposure.h"
#include "scene/builtin.h"
#include "scene/builtin/shapes.h"
#include "support/device_fixture.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <optional>

namespace reflet::test::exposure_test {
namespace {

constexpr uvec2 size(48, 30);

// A card of 18 % reflectance, lit from the front, before nothing.
Scene greyCard() {
    Scene scene = sceneOf(lambertMaterial(vec3(0.18F)), builtin::box({0.6F, 0.4F, 0.02F}));
    scene.fromFile = true;
    return scene;
}

View cardView(float lux) {
    View view;
    view.camera = builtin::camera("front", {0, 0, 4}, {0, 0, 0}, 20);
    view.sun = builtin::sun({0, 0, -1}, vec3(lux));
    return view;
}

class FrameExposure : public DeviceTest {
protected:
    struct Shown {
        Bitmap picture;
        std::optional<float> exposure;
        FloatImage radiance;
        FloatImage depth;
    };

    static Shown last(const Scene& scene, const std::vector<View>& views, const Settings& settings) {
        Renderer renderer(device(), scene, [](const std::string&) {});
        ShowReadback radiance;
        ShowReadback depth;
        gpu::Readback display;
        std::optional<gpu::Readback> exposure;
        for (const View& view : views) {
            renderer.render(view, size, 0, settings, [&](gpu::Frame& f, const FrameImages& images) {
                radiance = requestShow(f, images, findShow("final"));
                depth = requestShow(f, images, findShow("depth"));
                display = f.readback(images.display);
                exposure = images.exposure ? std::optional(f.readback(images.exposure)) : std::nullopt;
            });
        }
        const ViewParams params = makeViewParams(views.back().camera, size, 0, 0);
        const gpu::Frame& f = renderer.frame();
        return {fetchDisplay(f, display, size), exposure ? std::optional(exposureOf(f, *exposure)) : std::nullopt,
                fetchValues(f, radiance, params), fetchValues(f, depth, params)};
    }
    static Shown card(float lux, const std::vector<std::string>& more = {}) {
        std::vector<std::string> assignments{"shadow.filter=none"};
        assignments.insert(assignments.end(), more.begin(), more.end());
        return last(greyCard(), {cardView(lux)}, settingsOf(assignments));
    }
};

int largestDifference(const Bitmap& a, const Bitmap& b) {
    int largest = 0;
    for (size_t i = 0; i < a.data.size(); ++i) {
        largest = std::max(largest, std::abs(int{a.data[i]} - int{b.data[i]}));
    }
    return largest;
}

uint8_t middle(const Bitmap& picture) {
    return picture.data[3 * (size_t(picture.height / 2) * picture.width + picture.width / 2)];
}

TEST_F(FrameExposure, OfAGreyCardIsTheSamePictureInEveryLight) {
    const Bitmap bright = card(1.0F).picture;
    EXPECT_GT(middle(bright), 100);
    EXPECT_LT(middle(bright), 140);
    for (const float lux : {1000.0F, 0.001F, 100000.0F}) {
        EXPECT_LE(largestDifference(card(lux).picture, bright), 1) << lux << " lux";
    }
    EXPECT_EQ(middle(card(0.001F, {"tonemap.auto_exposure=off"}).picture), 0);
    EXPECT_EQ(card(0.0F).exposure, 0.0F);
}

TEST_F(FrameExposure, IsCorrectedByTheSetting) {
    const Shown metered = card(1.0F);
    const Shown brighter = card(1.0F, {"tonemap.exposure=1"});
    EXPECT_EQ(metered.exposure, brighter.exposure);
    EXPECT_EQ(metered.radiance.data, brighter.radiance.data);
    const std::string sum = fmt::format("tonemap.exposure={}", *metered.exposure + 1.0F);
    EXPECT_EQ(brighter.picture.data, card(1.0F, {"tonemap.auto_exposure=off", sum}).picture.data);
}

TEST_F(FrameExposure, IsAutomaticForFilesUnlessTheSettingSaysElse) {
    Scene scene = greyCard();
    const auto shown = [&](bool fromFile, const std::string& value) {
        scene.fromFile = fromFile;
        return last(scene, {cardView(1.0F)}, settingsOf({"tonemap.auto_exposure=" + value}));
    };
    const Shown off = shown(true, "off");
    EXPECT_FALSE(off.exposure.has_value());
    EXPECT_EQ(off.picture.data, shown(false, "files").picture.data);
    EXPECT_EQ(off.picture.data, shown(false, "off").picture.data);
    EXPECT_NE(off.picture.data, shown(true, "files").picture.data);
    EXPECT_EQ(shown(true, "files").picture.data, shown(false, "on").picture.data);
    EXPECT_EQ(off.radiance.data, shown(false, "on").radiance.data);
}

TEST_F(FrameExposure, IsThatOfTheHostForTheSamePicture) {
    for (const char* name : {"cubes", "cave", "mirror-hall"}) {
        const Scene scene = findBuiltinScene(name)->make();
        const Shown shown = last(scene, {defaultView(scene)}, settingsOf({"tonemap.auto_exposure=on"}));
        EXPECT_NEAR(*shown.exposure, meteredExposure(shown.radiance, shown.depth), 0.002F) << name;
        const TonemapSettings exposed =
            exposedAs(settingsOf({"tonemap.auto_exposure=on", "tonemap.exposure=0.5"}).tonemap, scene, shown.radiance,
                      shown.depth);
        EXPECT_NEAR(exposed.exposure, *shown.exposure + 0.5F, 0.002F) << name;
        EXPECT_EQ(exposed.autoExposure, AutoExposure::off);
    }
}

TEST_F(FrameExposure, OfAMovingViewIsSmoothedByTheTimeOfTheScene) {
    const Scene scene = greyCard();
    View later = cardView(16.0F);
    later.time = 0.25;
    const float before = *last(scene, {cardView(1.0F)}, {}).exposure;
    const auto after = [&](const std::string& adaptation) {
        return before -
               *last(scene, {cardView(1.0F), later}, settingsOf({"tonemap.adaptation=" + adaptation})).exposure;
    };
    EXPECT_NEAR(after("0"), 4.0F, 0.01F);
    const float weight = std::exp(-0.25F / 0.5F);
    EXPECT_NEAR(after("0.5"), 4.0F / (1.0F + weight), 0.01F);
    EXPECT_NEAR(after("10"), 2.0F, 0.05F);
}

TEST_F(FrameExposure, IsAHistoryOfSequencesThatASinglePictureNeedNotFill) {
    Scene scene = greyCard();
    EXPECT_TRUE(historyUse({}, scene).exposure);
    EXPECT_FALSE(historyUse(settingsOf({"tonemap.adaptation=0"}), scene).any());
    EXPECT_FALSE(historyUse(settingsOf({"tonemap.auto_exposure=off"}), scene).any());
    EXPECT_EQ(framesToSettle(historyUse({}, scene), {}), 1U);
    scene.fromFile = false;
    EXPECT_FALSE(historyUse({}, scene).any());
}

}  // namespace
}  // namespace reflet::test::exposure_test
