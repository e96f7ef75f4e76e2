// Measures of hard motion on synthetic sequences with known ghosts, lags and flicker; the cases of `bench --motions`.
#include "measure/motions/measures.h"

#include "base/error.h"
#include "base/math.h"
#include "measure/motions/cases.h"
#include "measure/motions/output.h"
#include "scene/builtin.h"
#include "scene/pose.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <set>

namespace reflet::test::motions_test {
namespace {

constexpr int width = 64;
constexpr int height = 24;

// The radiance that is compressed to this value.
float expanded(float value) {
    return value / (1.0F - value);
}

FloatImage image(std::vector<std::string> channels, const std::function<std::vector<float>(int x, int y)>& at) {
    FloatImage made{width, height, std::move(channels), {}};
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            const std::vector<float> values = at(x, y);
            made.data.insert(made.data.end(), values.begin(), values.end());
        }
    }
    return made;
}

// Grey, by its compressed value.
FloatImage grey(const std::function<float(int x, int y)>& at) {
    return image({"R", "G", "B"}, [&](int x, int y) { return std::vector<float>(3, expanded(at(x, y))); });
}

FloatImage motionOf(const std::function<float(int x, int y)>& pixels) {
    return image({"X", "Y"}, [&](int x, int y) { return std::vector<float>{pixels(x, y) / width, 0.0F}; });
}

FloatImage still() {
    return motionOf([](int, int) { return 0.0F; });
}

constexpr int speed = 6;  // pixels per frame; ghosts within two pixels of the thing itself do not count

bool inSquare(int x, int y, int frame) {
    const int left = 1 + speed * frame;
    return x >= left && x < left + 8 && y >= 6 && y < 18;
}

// A square of 0.7 slides over 0.2. left(k): the share of the square's light that is left k frames after it has gone.
std::vector<MotionFrame> slidingSquare(int frames, const std::function<float(int age)>& left) {
    std::vector<MotionFrame> sequence;
    for (int t = 0; t < frames; ++t) {
        const auto moving = [&](int x, int y) {
            for (int age = 0; age <= t; ++age) {
                if (inSquare(x, y, t - age)) {
                    return 0.2F + 0.5F * (age == 0 ? 1.0F : left(age));
                }
            }
            return 0.2F;
        };
        const auto settled = [&](int x, int y) { return inSquare(x, y, t) ? 0.7F : 0.2F; };
        sequence.push_back({grey(moving), grey(settled), motionOf([&](int x, int y) {
                                return inSquare(x, y, t) ? static_cast<float>(speed) : 0.0F;
                            })});
    }
    return sequence;
}

TEST(Motions, AGhostIsFoundAtItsAgeWithItsShare) {
    const std::vector<MotionFrame> sequence = slidingSquare(10, [](int age) {
        return age == 1 ? 0.4F : age == 3 ? 0.1F : 0.0F;
    });
    const Ghosts ghosts = ghostsOf(sequence, 4);
    ASSERT_EQ(ghosts.left.size(), 4U);
    EXPECT_NEAR(ghosts.left[0], 0.4, 1e-4);
    EXPECT_NEAR(ghosts.left[1], 0.0, 1e-4);
    EXPECT_NEAR(ghosts.left[2], 0.1, 1e-4);
    EXPECT_NEAR(ghosts.left[3], 0.0, 1e-4);
    EXPECT_GE(ghosts.pixels[0], 9U * 4U * 12U);  // nine frames uncover four columns beyond two pixels of the square
}

TEST(Motions, AGhostThatStaysIsWhole) {
    const Ghosts ghosts = ghostsOf(slidingSquare(10, [](int) { return 1.0F; }), 8);
    for (const double left : ghosts.left) {
        EXPECT_NEAR(left, 1.0, 1e-4);
    }
}

TEST(Motions, NoiseIsNoGhost) {
    std::vector<MotionFrame> sequence = slidingSquare(10, [](int) { return 0.0F; });
    uint32_t state = 1;
    for (MotionFrame& frame : sequence) {
        for (float& value : frame.picture.data) {
            state = state * 1664525U + 1013904223U;
            value *= 0.9F + 0.2F * static_cast<float>(state >> 8U) / 16777216.0F;
        }
    }
    for (const double left : ghostsOf(sequence, 3).left) {
        EXPECT_NEAR(left, 0.0, 0.01);
    }
}

// All that the camera shows has been elsewhere before, with the same light.
TEST(Motions, LightThatMovesWithItsSurfaceIsNoFormerLight) {
    std::vector<MotionFrame> sequence;
    for (int t = 0; t < 6; ++t) {
        const FloatImage shown =
            grey([&](int x, int y) { return 0.4F + 0.3F * std::sin(0.9F * static_cast<float>(x - speed * t + y)); });
        sequence.push_back({shown, shown, motionOf([](int, int) { return static_cast<float>(speed); })});
    }
    const Ghosts ghosts = ghostsOf(sequence, 3);
    for (size_t age = 0; age < 3; ++age) {
        EXPECT_EQ(ghosts.pixels[age], 0U);
        EXPECT_TRUE(std::isnan(ghosts.left[age]));
    }
}

TEST(Motions, TheRestOfAStepIsItsShareOverThePixelsThatItChanges) {
    const auto step = [](float share) {
        return grey([=](int x, int) { return x < width / 2 ? 0.2F + 0.4F * share : 0.5F; });
    };
    EXPECT_NEAR(stepLeft(step(1.0F), step(1.0F), step(0.0F)), 1.0, 1e-5);
    EXPECT_NEAR(stepLeft(step(0.25F), step(1.0F), step(0.0F)), 0.25, 1e-5);
    EXPECT_NEAR(stepLeft(step(0.75F), step(0.0F), step(1.0F)), 0.25, 1e-5);
    EXPECT_NEAR(stepLeft(step(-0.1F), step(1.0F), step(0.0F)), -0.1, 1e-5);
    EXPECT_TRUE(std::isnan(stepLeft(step(0.0F), step(0.0F), step(0.0F))));
}

TEST(Motions, ALagLastsUntilAllLaterFramesAreWithinTheLimit) {
    EXPECT_EQ(framesUntil(std::vector<double>{0.05, 0.01}, 0.1), 0U);
    EXPECT_EQ(framesUntil(std::vector<double>{0.8, 0.3, 0.1, 0.05}, 0.1), 2U);
    EXPECT_EQ(framesUntil(std::vector<double>{0.05, 0.3, 0.05}, 0.1), 2U);
    EXPECT_EQ(framesUntil(std::vector<double>{0.8, 0.3}, 0.1), std::nullopt);
    MotionsRun run;
    run.motion.lag = MotionCase::Lag::light;
    EXPECT_EQ(lagOf(run, {0.5, -0.3, -0.05}), 2U);  // an overshoot is a lag
    run.motion.lag = MotionCase::Lag::rest;
    EXPECT_EQ(lagOf(run, {1.5, 1.05, 0.7}), 1U);
}

TEST(Motions, FlickerIsTheMeanChangeBeyondMotion) {
    std::vector<MotionFrame> sequence;
    for (int t = 0; t < 5; ++t) {
        const float light = 0.5F + (t % 2 == 0 ? 0.02F : -0.02F);
        sequence.push_back({grey([&](int, int) { return light; }), grey([](int, int) { return 0.5F; }), still()});
    }
    const Flicker flicker = flickerOf(sequence);
    EXPECT_NEAR(flicker.frames, 0.04, 1e-5);
    EXPECT_EQ(flicker.settled, 0.0);
    MotionsRun run;
    run.flicker = flicker;
    run.restFlicker = 0.02;
    EXPECT_NEAR(flickerRatio(run), 2.0, 1e-3);
}

TEST(Motions, EveryCaseHasASceneAndStaysWithinItsAnimation) {
    std::set<std::string_view> names;
    for (const MotionCase& which : motionCases()) {
        SCOPED_TRACE(which.name);
        EXPECT_TRUE(names.insert(which.name).second);
        EXPECT_FALSE(which.description.empty());
        EXPECT_GE(which.frames, oldestGhost);
        EXPECT_GE(which.frames, which.event + stripFrames.back());
        const std::optional<Scene> scene = makeBuiltinScene(which.scene);
        ASSERT_TRUE(scene);
        const View first = defaultView(*scene);
        const double duration = animationDuration(*scene);
        EXPECT_TRUE(duration == 0.0 || which.view(first, which.frames).time < duration);
        EXPECT_NE(which.view(first, which.event), which.view(first, which.event == 1 ? 0 : 1));
        if (which.lag != MotionCase::Lag::none) {
            EXPECT_EQ(which.view(first, which.event), which.view(first, which.frames));
        }
    }
}

TEST(Motions, CasesAreFoundByNameAndOnlyOnce) {
    EXPECT_EQ(findMotionCases({"all"}).size(), motionCases().size());
    const std::vector<MotionCase> found = findMotionCases({"rods", "pan-5", "rods"});
    ASSERT_EQ(found.size(), 2U);
    EXPECT_EQ(found[0].name, "rods");
    EXPECT_THROW(findMotionCases({"rod"}), UsageError);
}

TEST(Motions, AStripHasARowForTheReferenceAndForEachVariant) {
    MotionsPlan plan;
    plan.size = {4, 2};
    plan.cases.resize(1);
    plan.variants.resize(2);
    const auto shade = [](uint8_t value) { return Bitmap{4, 2, 3, std::vector<uint8_t>(size_t(4) * 2 * 3, value)}; };
    MotionsResult result;
    result.truths = {std::vector<Bitmap>(stripFrames.size(), shade(12))};
    result.runs.resize(2);
    result.runs[0].pictures.assign(stripFrames.size(), shade(21));
    result.runs[1].pictures = {shade(32), shade(36)};
    const Bitmap strip = motionsStrip(plan, result, 0);
    EXPECT_EQ(strip.width, 8U);
    EXPECT_EQ(strip.height, 6U);
    const auto at = [&](size_t x, size_t y) { return strip.data[(y * strip.width + x) * 3]; };
    EXPECT_EQ(at(0, 0), 12);
    EXPECT_EQ(at(7, 3), 20);  // 6 bits
    EXPECT_EQ(at(0, 4), 32);
    EXPECT_EQ(at(7, 5), 36);
}

}  // namespace
}  // namespace reflet::test::motions_test
