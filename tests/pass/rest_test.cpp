// What is at rest converges, and what changes falls back: how long histories are (lighting/settings.h), and the share
// of the light that changes (renderer/light_change.h).
#include "lighting/settings.h"
#include "pass/harness.h"
#include "renderer/light_change.h"
#include "renderer/presets.h"
#include "scene/builtin.h"

#include <algorithm>
#include <cmath>

namespace reflet::test::rest_test {
namespace {

LightingSettings fitted(const lighting::Change& change, float scale = 1.0F) {
    LightingSettings settings;
    settings.denoise.history = 64;
    settings.shadow.history = 0;
    lighting::fitHistories(settings, change, scale);
    return settings;
}

TEST(Histories, GrowAtRestAndAreNotClippedAnyMore) {
    EXPECT_EQ(fitted({.rest = 100}).denoise.history, 64U);
    EXPECT_EQ(fitted({.rest = 1000}).denoise.history, 500U);
    EXPECT_EQ(fitted({.rest = 1000}).shadow.history, 0U) << "none stays none";
    EXPECT_EQ(fitted({.rest = 1000}).temporal.frames, 500U);
    EXPECT_EQ(fitted({.rest = 1000}, 0.5F).temporal.frames, 125U) << "a pixel has a sample in a quarter of the frames";
    EXPECT_EQ(fitted({.rest = 100000}).denoise.history, 2048U);
    EXPECT_GT(fitted({.rest = 3}).denoise.clip, 0.0F);
    EXPECT_EQ(fitted({.rest = 100}).denoise.clip, 0.0F);
    EXPECT_EQ(fitted({.rest = 100}).temporal.clip, 0.0F);
}

TEST(Histories, ShrinkWithTheShareOfTheLightThatChanges) {
    EXPECT_EQ(fitted({.light = 1.0F}).denoise.history, 1U);
    EXPECT_EQ(fitted({.light = 0.1F}).denoise.history, 9U);
    EXPECT_EQ(fitted({.light = 0.001F}).denoise.history, 64U);
    EXPECT_EQ(fitted({.light = 1.0F}).temporal.frames, 4U) << "edges stay smooth";
}

LampBlock lampsOf(std::initializer_list<float> intensities) {
    LampBlock lamps{};
    for (const float i : intensities) {
        lamps.lamps[lamps.count].intensity = vec3(i);
        lamps.lamps[lamps.count++].type = lampPoint;
    }
    return lamps;
}

TEST(ChangeOfLight, IsTheShareOfWhatIsSwitchedAndEchoes) {
    LightChange change;
    const View view;
    EXPECT_EQ(change.update(lampsOf({30.0F, 10.0F}), view), 0.0F) << "the first frame";
    EXPECT_EQ(change.update(lampsOf({30.0F, 10.0F}), view), 0.0F);
    EXPECT_FLOAT_EQ(change.update(lampsOf({30.0F, 0.0F}), view), 0.25F);
    EXPECT_FLOAT_EQ(change.update(lampsOf({30.0F, 0.0F}), view), 0.7F * 0.25F);
    for (int i = 0; i < 20; ++i) {
        change.update(lampsOf({30.0F, 0.0F}), view);
    }
    EXPECT_EQ(change.update(lampsOf({30.0F, 0.0F}), view), 0.0F);
    EXPECT_FLOAT_EQ(change.update(lampsOf({30.0F, 10.0F}), view), 0.25F);
}

TEST(ChangeOfLight, CountsMovesAndTurnsInPart) {
    LightChange change;
    View view;
    LampBlock lamps = lampsOf({10.0F});
    change.update(lamps, view);
    lamps.lamps[0].position = vec3(0.2F, 0.0F, 0.0F);
    EXPECT_NEAR(change.update(lamps, view), 0.2F, 1e-4F);
    LightChange ofSun;
    view.sun.irradiance = vec3(3.0F);
    view.sun.direction = vec3(0.0F, -1.0F, 0.0F);
    ofSun.update(lampsOf({}), view);
    const float angle = glm::radians(2.0F);
    view.sun.direction = vec3(std::sin(angle), -std::cos(angle), 0.0F);
    EXPECT_NEAR(ofSun.update(lampsOf({}), view), 0.2F, 1e-3F);
}

double squaredDifference(const FloatImage& a, const FloatImage& b) {
    double sum = 0.0;
    for (size_t i = 0; i < a.data.size(); ++i) {
        const double d = std::min(a.data[i], 4.0F) - std::min(b.data[i], 4.0F);
        sum += d * d;
    }
    return sum / static_cast<double>(a.data.size());
}

class AtRest : public testing::Test {
protected:
    AtRest() {
        applyPreset(settings, "balanced");
        settings.probes.enabled = 0;  // their capture takes most of the time
    }

    /// The pictures of so many frames.
    [[nodiscard]] std::vector<test::Pictures> picturesOf(uint32_t frames, uvec2 size = {36, 20}) const {
        return test::renderPath(scene, std::vector<View>(frames, view), size, settings, {"final"});
    }

    static inline const Scene scene = findBuiltinScene("cornell")->make();
    const View view = defaultView(scene);
    Settings settings;
};

// Pictures of different numbers of frames differ by the noise of the shorter one, or by what it has not seen yet.
// Over 5 s: it renders some hundred frames.
TEST_F(AtRest, PicturesConvergeBeyondTheHistoriesOfMotion) {
    const std::vector<test::Pictures> frames = picturesOf(400);
    const auto errorAfter = [&](size_t count) {
        return squaredDifference(frames[count - 1].images.at("final"), frames.back().images.at("final"));
    };
    const double at32 = errorAfter(32);
    const double at200 = errorAfter(200);
    EXPECT_LT(at200, 0.3 * at32) << at32;
}

// A frame's pixel is two by two of the picture: where light varies little, the steps from row to row are the same
// within them and between them.
TEST_F(AtRest, UpscaledLightHasNoStepsOfAFramesPixels) {
    const FloatImage last = picturesOf(128, {96, 54}).back().images.at("final");
    double within = 0.0;
    double between = 0.0;
    const size_t row = last.width * last.channels.size();
    for (size_t i = 0; i + row < last.data.size(); ++i) {
        const double step = std::abs(last.data[i + row] - last.data[i]);
        if (step < 0.1 * last.data[i]) {  // not an edge
            (i / row % 2 == 0 ? within : between) += step;
        }
    }
    EXPECT_GT(within, 0.8 * between);
    EXPECT_LT(within, 1.25 * between);
}

}  // namespace
}  // namespace reflet::test::rest_test
