// The denoiser on synthetic light with known results.
#include "pass/denoise_harness.h"
#include "support/device_fixture.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>
#include <string>

namespace reflet::test::denoise_test {

namespace {

constexpr uvec2 size{96, 64};

class Denoise : public DeviceTest, public ::testing::WithParamInterface<uint32_t> {};

DenoiseSettings enabled() {
    DenoiseSettings settings;
    settings.enabled = 1;
    return settings;
}

// Temporal accumulation alone, whose result is known exactly.
DenoiseSettings pastAlone() {
    DenoiseSettings settings = enabled();
    settings.passes = 0;
    settings.clip = 0.0F;
    settings.fireflies = 0.0F;
    return settings;
}

// One in eight pixels is lit, as by a small bright light that few rays hit: mean 1.
LitWall fewRays(std::mt19937& random) {
    return [&random](uvec2) {
        const bool lit = std::uniform_real_distribution<float>(0.0F, 1.0F)(random) < 0.125F;
        return LitPixel{vec3(lit ? 8.0F : 0.0F), 100.0F};
    };
}

float pattern(uvec2 pixel) {
    return static_cast<float>((pixel.x * 7919U + pixel.y * 104729U) % 251U) / 16.0F;
}

std::string lobeName(const ::testing::TestParamInfo<uint32_t>& info) {
    return info.param == lobeDiffuse ? "Diffuse" : "Specular";
}

INSTANTIATE_TEST_SUITE_P(Lobes, Denoise, ::testing::Values(lobeDiffuse, lobeSpecular), lobeName);

TEST_P(Denoise, AConstantStaysConstant) {
    DenoiseRun run(device(), size, GetParam(), enabled());
    for (int frame = 0; frame < 6; ++frame) {
        for (const vec4& texel : run.add([](uvec2) { return LitPixel{vec3(0.25F, 1.0F, 3.0F)}; })) {
            ASSERT_NEAR(texel.x, 0.25F, 0.25F / 1024);
            ASSERT_NEAR(texel.y, 1.0F, 1.0F / 1024);
            ASSERT_NEAR(texel.z, 3.0F, 3.0F / 1024);
        }
    }
}

TEST_P(Denoise, TheMeanOfNoiseIsKept) {
    constexpr uvec2 large{256, 256};
    std::mt19937 random(1);
    const LitWall light = fewRays(random);
    DenoiseRun run(device(), large, GetParam(), enabled());
    double in = 0.0;
    double out = 0.0;
    for (int frame = 0; frame < 16; ++frame) {
        double shown = 0.0;
        const std::vector<vec4> clean = run.add([&](uvec2 pixel) {
            const LitPixel p = light(pixel);
            shown += p.radiance.x;
            return p;
        });
        in += shown / (large.x * large.y);
        out = meanOf(clean).x;
        EXPECT_NEAR(out / (in / (frame + 1)), 1.0, 0.005) << "frame " << frame;
    }
}

TEST_P(Denoise, NoiseIsLessInTheFirstFrameAndLessStillInLaterOnes) {
    std::mt19937 random(2);
    const LitWall light = fewRays(random);
    DenoiseRun run(device(), size, GetParam(), enabled());
    const auto variance = [](const std::vector<vec4>& texels) {
        double sum = 0.0;
        for (const vec4& t : texels) {
            sum += (t.x - 1.0) * (t.x - 1.0);
        }
        return sum / static_cast<double>(texels.size());
    };
    const double first = variance(run.add(light));
    EXPECT_LT(first, 0.25);  // of 7 in what comes in
    double last = first;
    for (int frame = 1; frame < 32; ++frame) {
        last = variance(run.add(light));
    }
    EXPECT_LT(last, 0.02);  // the mean of 32 frames alone has 0.22
}

TEST_P(Denoise, FirefliesAreSpreadOverTheirNeighbours) {
    DenoiseSettings settings = pastAlone();
    settings.fireflies = 4.0F;
    DenoiseRun run(device(), size, GetParam(), settings);
    const std::vector<vec4> clean =
        run.add([](uvec2 p) { return LitPixel{vec3(p == uvec2(40, 30) ? 1000.0F : 1.0F)}; });
    EXPECT_LT(clean[30 * size.x + 40].x, 200.0F);
    EXPECT_GT(clean[29 * size.x + 39].x, 50.0F);
    const double given = 1.0 + 999.0 / (size.x * size.y);
    EXPECT_NEAR(meanOf(clean).x / given, 1.0, 0.002);
}

TEST_P(Denoise, NaNsComeOutFinite) {
    constexpr float infinity = std::numeric_limits<float>::infinity();
    const float bad[] = {infinity, -infinity, std::numeric_limits<float>::quiet_NaN(), 65504.0F, -1.0F};
    DenoiseRun run(device(), size, GetParam(), enabled());
    for (int frame = 0; frame < 3; ++frame) {
        const std::vector<vec4> clean = run.add([&](uvec2 p) {
            const size_t i = (p.x + p.y * size.x) % 97;
            return i < std::size(bad) ? LitPixel{vec3(bad[i]), bad[i]} : LitPixel{vec3(1.0F)};
        });
        for (const vec4& texel : clean) {
            for (int c = 0; c < 4; ++c) {
                ASSERT_TRUE(std::isfinite(texel[c]));
                ASSERT_GE(texel[c], 0.0F);
            }
        }
    }
}

TEST_P(Denoise, AWallThatMovesByWholePixelsKeepsItsTexels) {
    DenoiseRun run(device(), size, GetParam(), pastAlone());
    run.add([](uvec2 p) { return LitPixel{vec3(pattern(p))}; }, {.roughness = 1.0F});
    const std::vector<vec4> second =
        run.add([](uvec2) { return LitPixel{}; }, {.wallMotion = {5, -3}, .roughness = 1.0F});
    for (uint32_t y = 0; y < size.y - 3; ++y) {
        for (uint32_t x = 5; x < size.x; ++x) {
            ASSERT_EQ(second[y * size.x + x].x, 0.5F * pattern({x - 5, y + 3})) << x << ' ' << y;
        }
    }
    EXPECT_EQ(second[10 * size.x + 2].x, 0.0F);  // came into view: there is no past
}

TEST_P(Denoise, DisoccludedPixelsStartAnew) {
    DenoiseRun run(device(), size, GetParam(), pastAlone());
    const auto left = [](uvec2 p) { return p.x < 40; };
    run.add([&](uvec2 p) { return LitPixel{vec3(8.0F), 100.0F, left(p)}; });
    const std::vector<vec4> second = run.add([](uvec2) { return LitPixel{vec3(2.0F)}; });
    EXPECT_EQ(second[10 * size.x + 20].x, 2.0F);
    EXPECT_EQ(second[10 * size.x + 60].x, 5.0F);
}

// With jitter, a traced pixel at an edge shows another surface in some frames; its neighbours know both.
TEST_P(Denoise, APixelThatShowedAnotherSurfaceTakesTheHistoryOfItsNeighbours) {
    DenoiseRun run(device(), size, GetParam(), pastAlone());
    const WallFrame rough{.roughness = 1.0F};
    run.add([](uvec2 p) { return LitPixel{vec3(8.0F), 100.0F, p == uvec2(20, 10)}; }, rough);
    const std::vector<vec4> second = run.add([](uvec2) { return LitPixel{vec3(2.0F)}; }, rough);
    EXPECT_EQ(second[10 * size.x + 20].x, 5.0F);
}

// Known light of three frames, in place of a history; then the history alone.
TEST_P(Denoise, StartsFromWhatIsRemembered) {
    DenoiseRun run(device(), size, GetParam(), pastAlone());
    const WallFrame known{.roughness = 1.0F, .remembered = vec4(2.0F, 2.0F, 2.0F, 3.0F)};
    const LitWall light = [](uvec2) { return LitPixel{vec3(8.0F)}; };
    EXPECT_EQ(run.add(light, known)[10 * size.x + 20].x, (3 * 2.0F + 8.0F) / 4);
    EXPECT_NEAR(run.add(light, known)[10 * size.x + 20].x, (3 * 2.0F + 2 * 8.0F) / 5, 0.01F);
    // Nothing known: the frame alone.
    DenoiseRun other(device(), size, GetParam(), pastAlone());
    EXPECT_EQ(other.add(light, {.roughness = 1.0F, .remembered = vec4(0.0F)})[10 * size.x + 20].x, 8.0F);
}

TEST_P(Denoise, PixelsWeighByTheirHistoryInTheBlur) {
    DenoiseSettings settings = pastAlone();
    settings.passes = 1;
    DenoiseRun run(device(), size, GetParam(), settings);
    const WallFrame rough{.roughness = 1.0F};
    const auto late = [](uvec2 p) { return p.x >= 18 && p.x <= 22 && p.y >= 8 && p.y <= 12; };
    for (int frame = 0; frame < 8; ++frame) {
        run.add([&](uvec2 p) { return LitPixel{vec3(1.0F), 100.0F, late(p)}; }, rough);
    }
    const std::vector<vec4> now = run.add([&](uvec2 p) { return LitPixel{vec3(late(p) ? 0.0F : 1.0F)}; }, rough);
    // Its eight taps weigh about half by distance: with equal weights the pixel itself has a fifth.
    EXPECT_GT(now[10 * size.x + 20].x, 0.85F);
}

using DenoisePlain = DeviceTest;

TEST_F(DenoisePlain, AMirrorImageMovesAsWhatItShowsAndNotAsTheMirror) {
    constexpr float behind = 12.0F;  // metres from the mirror to what it shows
    DenoiseRun run(device(), size, lobeSpecular, pastAlone());
    const float step = 4.0F / run.pixelsPerMetre(wallDistance + behind);  // 4 pixels of the image, 16 of the mirror
    const auto away = [&](uvec2 p) {  // along the ray, to a wall that faces the camera
        const vec2 slope = (vec2(p) + 0.5F - 0.5F * vec2(size)) / run.pixelsPerMetre(1.0F);
        return behind * glm::length(vec3(slope, 1.0F));
    };
    const auto show = [&](float share) {
        return [&away, share](uvec2 p) { return LitPixel{vec3(share * pattern(p)), away(p)}; };
    };
    run.add(show(1.0F), {.roughness = 0.0F});
    const std::vector<vec4> second = run.add(show(0.0F), {.cameraX = step, .roughness = 0.0F});
    for (uint32_t y = 1; y + 1 < size.y; ++y) {
        for (uint32_t x = 1; x + 5 < size.x; ++x) {
            ASSERT_NEAR(second[y * size.x + x].x, 0.5F * pattern({x + 4, y}), 0.02F) << x << ' ' << y;
        }
    }
}

TEST_F(DenoisePlain, AMirrorImageMovesAsWhatItShowsDoesByItself) {
    DenoiseRun run(device(), size, lobeSpecular, pastAlone());
    run.add([](uvec2 p) { return LitPixel{vec3(pattern(p))}; }, {.roughness = 0.0F});
    const std::vector<vec4> second =
        run.add([](uvec2) { return LitPixel{}; }, {.roughness = 0.0F, .imageMotion = {6, 2}});
    for (uint32_t y = 2; y < size.y; ++y) {
        for (uint32_t x = 6; x < size.x; ++x) {
            ASSERT_EQ(second[y * size.x + x].x, 0.5F * pattern({x - 6, y - 2})) << x << ' ' << y;
        }
    }
}

TEST_F(DenoisePlain, LightThatChangesIsShownSoon) {
    DenoiseRun run(device(), size, lobeDiffuse, enabled());
    for (int frame = 0; frame < 20; ++frame) {
        run.add([](uvec2) { return LitPixel{vec3(1.0F)}; });
    }
    std::vector<vec4> after;
    for (int frame = 0; frame < 8; ++frame) {
        after = run.add([](uvec2) { return LitPixel{vec3(0.2F)}; });
    }
    EXPECT_NEAR(meanOf(after).x, 0.2F, 0.01F);
}

TEST_F(DenoisePlain, TwoRunsAreTheSame) {
    const auto last = [&] {
        std::mt19937 random(3);
        const LitWall light = fewRays(random);
        DenoiseRun run(device(), size, lobeDiffuse, enabled());
        std::vector<vec4> clean;
        for (int frame = 0; frame < 4; ++frame) {
            clean = run.add(light, {.cameraX = 0.01F * static_cast<float>(frame)});
        }
        return clean;
    };
    EXPECT_EQ(last(), last());
}

}  // namespace
}  // namespace reflet::test::denoise_test
