// Temporal antialiasing and upscaling of synthetic images: what is preserved exactly, convergence at rest, and ghosting
// in motion.
#include "pass/temporal_harness.h"

#include "effects/jitter.h"
#include "support/device_fixture.h"

#include <glm/gtc/packing.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

namespace reflet::test::temporal_test {
namespace {

constexpr uvec2 size(96, 54);

class Temporal : public DeviceTest {};

float asHalf(float v) {
    return glm::unpackHalf1x16(glm::packHalf1x16(v));
}

// A test pattern with edges in all directions, thin bars, a bright spot and a smooth part. at: pixels.
vec3 patternAt(vec2 at) {
    const vec2 middle = 0.5F * vec2(size);
    const vec2 p = at - middle;
    if (p.x * p.x + p.y * p.y < 9.0F) {
        return {20.0F, 15.0F, 10.0F};
    }
    if (at.y < 12.0F) {
        return std::fmod(at.x + 0.21F * at.y + 100.0F, 7.0F) < 0.4F ? vec3(1.0F) : vec3(0.1F);  // thin bars
    }
    if (at.y > 42.0F) {
        return {0.5F + 0.4F * std::sin(0.3F * at.x), 0.5F, 0.5F};
    }
    const float turn = std::atan2(p.y, p.x) / glm::two_pi<float>() * 16.0F;
    return turn - std::floor(turn) < 0.5F ? vec3(0.8F, 0.3F, 0.1F) : vec3(0.05F, 0.1F, 0.4F);
}

// The pattern's mean over a pixel's area, moved by so many pixels.
vec3 truthAt(uvec2 pixel, vec2 moved) {
    constexpr int side = 11;
    vec3 sum(0.0F);
    for (int i = 0; i < side * side; ++i) {
        const vec2 in = (vec2(i % side, i / side) + 0.5F) / float(side);
        sum += patternAt(vec2(pixel) + in - moved);
    }
    return sum / float(side * side);
}

double relativeError(const vec3& v, const vec3& truth) {
    const vec3 off = v - truth;
    return double(glm::dot(off, off)) / (double(glm::dot(truth, truth)) + 0.01);
}

// Relative MSE over pixels at least `border` from the picture's edges.
double errorOf(const std::vector<vec4>& picture, vec2 moved, uint32_t border = 0) {
    double sum = 0.0;
    double count = 0.0;
    for (uint32_t y = border; y < size.y - border; ++y) {
        for (uint32_t x = border; x < size.x - border; ++x) {
            sum += relativeError(vec3(picture[y * size.x + x]), truthAt({x, y}, moved));
            count += 1.0;
        }
    }
    return sum / count;
}

TEST_F(Temporal, AConstantStaysExactlyWhatItIsAtRestAndInMotion) {
    for (const float value : {1e-3F, 0.1F, 1.0F, 3.14159F, 777.0F, 65504.0F}) {
        for (const vec2 motion : {vec2(0.0F), vec2(0.37F, -1.6F)}) {
            const vec3 c = value * vec3(1.0F, 0.5F, 0.3F);
            TemporalRun run(device(), size);
            const auto shown = [&](uvec2) { return MadeUpPixel{c, motion, 0.5F}; };
            const vec4 first = run.add(shown).front();
            for (int channel = 0; channel < 3; ++channel) {  // the device may cut off what it stores
                ASSERT_NEAR(first[channel], asHalf(c[channel]), c[channel] / 1000.0F) << value;
            }
            std::vector<vec4> last;
            for (int i = 0; i < 40; ++i) {
                last = run.add(shown);
            }
            for (const vec4& v : last) {
                ASSERT_EQ(vec3(v), vec3(first)) << value;
            }
        }
    }
}

TEST_F(Temporal, WhateverComesInFiniteRadianceOfAtLeastZeroComesOut) {
    constexpr float inf = std::numeric_limits<float>::infinity();
    constexpr float nan = std::numeric_limits<float>::quiet_NaN();
    const std::vector<float> values{0.0F, 0.5F, -1.0F, 65504.0F, inf, -inf, nan, 1e-7F};
    std::mt19937 random(5);
    const auto any = [&] { return values[random() % values.size()]; };
    TemporalRun run(device(), size);
    for (int i = 0; i < 12; ++i) {
        const std::vector<vec4> now = run.add([&](uvec2) {
            const vec2 motion = i < 6 ? vec2(0.3F * float(i)) : vec2(any(), any());
            return MadeUpPixel{{any(), any(), any()}, motion, any()};
        });
        for (const vec4& v : now) {
            for (int channel = 0; channel < 4; ++channel) {
                ASSERT_TRUE(std::isfinite(v[channel]) && v[channel] >= 0.0F) << i;
            }
        }
    }
    for (int i = 0; i < 100; ++i) {  // and none of it stays
        const std::vector<vec4> now = run.add([](uvec2) { return MadeUpPixel{vec3(0.5F)}; });
        if (i == 99) {
            for (const vec4& v : now) {
                ASSERT_NEAR(v.x, 0.5F, 0.01F);
            }
        }
    }
}

TEST_F(Temporal, AtRestItConvergesToTheMeanOverThePixelsArea) {
    TemporalRun run(device(), size);
    double first = 0.0;
    std::vector<vec4> last;
    for (uint32_t i = 0; i < 32; ++i) {
        last = run.add([&](uvec2 p) { return MadeUpPixel{patternAt(vec2(p) + 0.5F + subpixelJitter(i))}; });
        first = i == 0 ? errorOf(last, vec2(0.0F)) : first;
    }
    const double rested = errorOf(last, vec2(0.0F));
    RecordProperty("first", std::to_string(first));
    RecordProperty("rested", std::to_string(rested));
    EXPECT_LT(rested, 0.07 * first) << rested << " of " << first;  // the mean of 32 samples: 0.04
    for (uint32_t i = 32; i < 128; ++i) {                          // and it stays there
        last = run.add([&](uvec2 p) { return MadeUpPixel{patternAt(vec2(p) + 0.5F + subpixelJitter(i))}; });
    }
    EXPECT_LT(errorOf(last, vec2(0.0F)), 1.2 * rested);
}

TEST_F(Temporal, APictureThatMovesByWholePixelsIsTheSameTexelsAgain) {
    TemporalRun run(device(), size);
    const vec2 motion(2.0F, -1.0F);
    std::vector<vec4> last;
    constexpr uint32_t frames = 12;
    for (uint32_t i = 0; i < frames; ++i) {
        last = run.add([&](uvec2 p) {
            return MadeUpPixel{patternAt(vec2(p) + 0.5F - float(i) * motion), motion, 0.5F};
        });
    }
    const vec2 moved = float(frames - 1) * motion;
    const auto enteredX = static_cast<uint32_t>(moved.x);
    const auto enteredY = static_cast<uint32_t>(-moved.y);
    ASSERT_TRUE(enteredX < size.x && enteredY < size.y);
    for (uint32_t y = 0; y < size.y - enteredY; ++y) {  // what has been there from the first frame on
        for (uint32_t x = enteredX; x < size.x; ++x) {
            const vec2 at = vec2(x, y) + 0.5F - moved;
            const vec3 expected = patternAt(at);
            vec3 differs(0.0F);
            for (int i = 0; i < 9; ++i) {
                differs = glm::max(differs, glm::abs(patternAt(at + vec2(i % 3 - 1, i / 3 - 1)) - expected));
            }
            for (int channel = 0; channel < 3; ++channel) {
                // In the first frame, at least a twelfth of the mean, 0.3 are of the pixels around.
                const float smoothed = 0.3F / 10.0F * differs[channel];
                ASSERT_NEAR(last[y * size.x + x][channel], expected[channel], smoothed + 0.002F * expected[channel])
                    << x << ", " << y;
            }
        }
    }
}

TEST_F(Temporal, APictureThatGlidesIsNearerToTheTruthThanItsFramesAre) {
    struct Case {
        vec2 motion;
        double limit;
    };
    // Four pixels a frame are too many for thin bars: disocclusions cover more than half of them. At half a pixel a
    // frame samples meet the same half of what moves, as successive jitter alternates between halves.
    for (const auto& [motion, limit] : {Case{{0.3F, 0.1F}, 0.35}, Case{{1.5F, 0.5F}, 0.6}, Case{{-3.7F, 2.2F}, 0.5}}) {
        TemporalRun run(device(), size);
        std::vector<vec4> last;
        std::vector<vec4> plain;
        constexpr uint32_t frames = 52;
        vec2 moved(0.0F);
        double with = 0.0;  // of the last frames: the error of one depends on its jitter
        double without = 0.0;
        for (uint32_t i = 0; i < frames; ++i) {
            moved = float(i) * motion;
            plain.clear();
            last = run.add([&](uvec2 p) {
                const MadeUpPixel pixel{patternAt(vec2(p) + 0.5F + subpixelJitter(i) - moved), motion, 0.5F};
                plain.emplace_back(pixel.radiance, 1.0F);
                return pixel;
            });
            with += i + 32 >= frames ? errorOf(last, moved, 4) : 0.0;
            without += i + 32 >= frames ? errorOf(plain, moved, 4) : 0.0;
        }
        RecordProperty("with", std::to_string(with));
        EXPECT_LT(with, limit * without) << motion.x << ": " << with << " of " << without;
    }
}

// A square before the pattern, which stands still.
struct Square {
    vec2 low;
    float side = 16.0F;
    [[nodiscard]] bool holds(vec2 at) const {
        return at.x >= low.x && at.y >= low.y && at.x < low.x + side && at.y < low.y + side;
    }
};

TEST_F(Temporal, WhatAMovingThingUncoversIsFreeOfIt) {
    constexpr vec3 color(3.0F, 0.2F, 0.2F);
    for (const float speed : {2.0F, 5.0F}) {
        TemporalRun run(device(), size);
        std::vector<vec4> last;
        Square square{{4.0F, 32.0F}};  // below the bright spot
        Square before = square;
        Square twoBefore = square;
        for (uint32_t i = 0; i < 12; ++i) {
            twoBefore = before;
            before = square;
            square.low.x = 4.0F + speed * float(i);
            last = run.add([&](uvec2 p) {
                const vec2 at = vec2(p) + 0.5F + subpixelJitter(i);
                return square.holds(at) ? MadeUpPixel{color, {speed, 0.0F}, 0.7F}
                                        : MadeUpPixel{patternAt(at), vec2(0.0F), 0.2F};
            });
        }
        double worst[] = {0.0, 0.0};
        double sum[] = {0.0, 0.0};
        double count[] = {0.0, 0.0};
        for (uint32_t y = 0; y < size.y; ++y) {
            for (uint32_t x = 0; x < size.x; ++x) {
                const vec2 at = vec2(x, y) + 0.5F;
                const Square wide{square.low - 0.5F, square.side + 1.0F};  // of which no jittered frame shows it
                if (wide.holds(at) || !twoBefore.holds(at)) {
                    continue;
                }
                const int age = before.holds(at) ? 0 : 1;
                // How red it is beyond the pattern's brightest red here.
                const double trail = double(last[y * size.x + x].r) - 0.9;
                worst[age] = std::max(worst[age], trail / double(color.r));
                sum[age] += std::max(trail, 0.0) / double(color.r);
                count[age] += 1.0;
            }
        }
        RecordProperty("worst_first", std::to_string(worst[0]));
        RecordProperty("worst_second", std::to_string(worst[1]));
        EXPECT_GT(count[1], 10.0);
        EXPECT_LT(worst[0], 0.02) << speed;
        EXPECT_LT(worst[1], 0.01) << speed;
    }
}

TEST_F(Temporal, LightThatChangesAtRestIsTakenOverInAFewFrames) {
    TemporalRun run(device(), size);
    std::vector<vec4> last;
    const auto show = [&](float light) {
        const vec2 place = subpixelJitter(run.count());
        last = run.add([&](uvec2 p) { return MadeUpPixel{light * patternAt(vec2(p) + 0.5F + place)}; });
    };
    for (int i = 0; i < 40; ++i) {
        show(1.0F);
    }
    for (int i = 0; i < 8; ++i) {
        show(0.25F);
    }
    double sum = 0.0;
    double expected = 0.0;
    for (uint32_t y = 0; y < size.y; ++y) {
        for (uint32_t x = 0; x < size.x; ++x) {
            sum += last[y * size.x + x].g;
            expected += 0.25F * truthAt({x, y}, vec2(0.0F)).g;
        }
    }
    EXPECT_NEAR(sum, expected, 0.05 * expected);
}

// Frames at a share of the picture's size.
class Upscaling : public DeviceTest {
protected:
    static uvec2 sizeOf(float scale) { return uvec2(glm::round(vec2(size) * scale)); }
    // What frame i shows at a pixel of the frame: the picture's place of its sample.
    static vec2 placeOf(uvec2 p, uint32_t i, float scale) { return (vec2(p) + 0.5F + subpixelJitter(i)) / scale; }
};

constexpr float scales[] = {0.5F, 2.0F / 3.0F};

TEST_F(Upscaling, AConstantStaysExactlyWhatItIsAtRestAndInMotion) {
    for (const float scale : scales) {
        for (const vec2 motion : {vec2(0.0F), vec2(0.37F, -1.6F)}) {
            const vec3 c(777.0F, 0.3F, 1e-3F);
            TemporalRun run(device(), sizeOf(scale), size);
            std::vector<vec4> last;
            for (int i = 0; i < 40; ++i) {
                last = run.add([&](uvec2) { return MadeUpPixel{c, motion, 0.5F}; });
            }
            for (const vec4& v : last) {
                for (int channel = 0; channel < 3; ++channel) {
                    ASSERT_NEAR(v[channel], asHalf(c[channel]), c[channel] / 500.0F);
                }
            }
        }
    }
}

TEST_F(Upscaling, WhateverComesInFiniteRadianceOfAtLeastZeroComesOut) {
    constexpr float inf = std::numeric_limits<float>::infinity();
    constexpr float nan = std::numeric_limits<float>::quiet_NaN();
    const std::vector<float> values{0.0F, 0.5F, -1.0F, 65504.0F, inf, -inf, nan, 1e-7F};
    std::mt19937 random(5);
    const auto any = [&] { return values[random() % values.size()]; };
    TemporalRun run(device(), sizeOf(0.5F), size);
    for (int i = 0; i < 412; ++i) {  // a hundred samples for each of the picture's pixels
        const std::vector<vec4> now = run.add([&](uvec2) {
            if (i >= 12) {
                return MadeUpPixel{vec3(0.5F)};
            }
            const vec2 motion = i < 6 ? vec2(0.3F * float(i)) : vec2(any(), any());
            return MadeUpPixel{{any(), any(), any()}, motion, any()};
        });
        for (const vec4& v : now) {
            for (int channel = 0; channel < 4; ++channel) {
                ASSERT_TRUE(std::isfinite(v[channel]) && v[channel] >= 0.0F) << i;
            }
            ASSERT_TRUE(i < 411 || std::abs(v.x - 0.5F) < 0.02F) << v.x;  // and none of it stays
        }
    }
}

// As near to the mean over pixels' areas as frames of full size come, bars thinner than a pixel included.
TEST_F(Upscaling, AtRestItConvergesToTheMeanOverThePicturesPixels) {
    for (const float scale : scales) {
        TemporalRun run(device(), sizeOf(scale), size);
        const auto samples = static_cast<uint32_t>(32.0F / (scale * scale));
        double first = 0.0;
        std::vector<vec4> last;
        for (uint32_t i = 0; i < samples; ++i) {
            last = run.add([&](uvec2 p) { return MadeUpPixel{patternAt(placeOf(p, i, scale))}; });
            first = i == 0 ? errorOf(last, vec2(0.0F)) : first;
        }
        const double rested = errorOf(last, vec2(0.0F));
        RecordProperty("rested_" + std::to_string(scale), std::to_string(rested / first));
        EXPECT_LT(rested, 0.07 * first) << scale << ": " << rested << " of " << first;
    }
}

TEST_F(Upscaling, APictureThatGlidesIsNearerToTheTruthThanTheFirstFrame) {
    for (const float scale : scales) {
        for (const vec2 motion : {vec2(0.3F, 0.1F), vec2(1.5F, 0.5F)}) {  // pixels of the picture
            TemporalRun run(device(), sizeOf(scale), size);
            double first = 0.0;
            std::vector<vec4> last;
            vec2 moved(0.0F);
            double with = 0.0;  // mean of the last frames
            for (uint32_t i = 0; i < 64; ++i) {
                moved = float(i) * motion;
                last = run.add([&](uvec2 p) {
                    return MadeUpPixel{patternAt(placeOf(p, i, scale) - moved), motion * scale, 0.5F};
                });
                first = i == 0 ? errorOf(last, moved, 4) : first;
                with += i >= 16 ? errorOf(last, moved, 4) / 48.0 : 0.0;
            }
            RecordProperty("glides_" + std::to_string(scale) + "_" + std::to_string(motion.x),
                           std::to_string(with / first));
            EXPECT_LT(with, (scale > 0.5F ? 0.8 : 0.6) * first)
                << scale << ", " << motion.x << ": " << with << " of " << first;
        }
    }
}

TEST_F(Upscaling, LightThatChangesAtRestIsTakenOverInAFewSamplesOfEachPixel) {
    for (const float scale : scales) {
        TemporalRun run(device(), sizeOf(scale), size);
        std::vector<vec4> last;
        const auto samples = static_cast<uint32_t>(10.0F / (scale * scale));
        for (uint32_t i = 0; i < 60 + samples; ++i) {
            const float light = i < 60 ? 1.0F : 0.25F;
            last = run.add([&](uvec2 p) { return MadeUpPixel{light * patternAt(placeOf(p, i, scale))}; });
        }
        double sum = 0.0;
        double expected = 0.0;
        for (uint32_t y = 0; y < size.y; ++y) {
            for (uint32_t x = 0; x < size.x; ++x) {
                sum += last[y * size.x + x].g;
                expected += 0.25F * truthAt({x, y}, vec2(0.0F)).g;
            }
        }
        EXPECT_NEAR(sum, expected, 0.05 * expected) << scale;
    }
}

}  // namespace
}  // namespace reflet::test::temporal_test
