// Motion blur on made-up pictures: what stands still does not change, what moves sweeps over its edges by the streak's
// length with the coverage of a box, and nothing still loses its edge.
#include "effects/motion_blur/motion_blur.h"

#include "capture/texels.h"
#include "device/device.h"
#include "device/frame.h"
#include "pass/test_shaders.h"
#include "renderer/view_params.h"
#include "scene/builtin/assemble.h"
#include "support/device_fixture.h"

#include <cmath>
#include <functional>

namespace reflet::test::motion_blur_test {
namespace {

constexpr uvec2 size(160, 96);

class MotionBlur : public DeviceTest {};

/// Radiance, metres along the view axis (infinity: background), and pixels since the last frame.
struct Point {
    vec3 radiance{0.0F};
    float z = 4.0F;
    vec2 moved{0.0F};
};
using Picture = std::function<Point(const uvec2& pixel)>;

/// The view of a near plane of 1 m.
ViewParams stillView() {
    ViewParams view{};
    view.depthToDistance = vec4(1.0F, 0.0F, 0.0F, 1.0F);
    view.eye = vec4(0.0F, 0.0F, 0.0F, 1.0F);
    view.size = vec2(size);
    return view;
}

class BlurRun {
public:
    explicit BlurRun(gpu::Device& device) : frame_(device) { addPassTestShaders(device); }

    std::vector<vec4> operator()(const Picture& picture, const ViewParams& view = stillView(),
                                 MotionBlurSettings settings = {.enabled = 1, .samples = 32}) {
        std::vector<vec4> radiance;
        std::vector<vec4> depth;
        std::vector<vec4> motion;
        for (uint32_t i = 0; i < size.x * size.y; ++i) {
            const Point p = picture(uvec2(i % size.x, i / size.x));
            radiance.emplace_back(p.radiance, 0.5F);
            depth.emplace_back(1.0F / p.z);
            motion.emplace_back(p.moved / vec2(size), 0.0F, 0.0F);
        }
        Filler fill(frame_, size);
        frame_.begin();
        const MotionBlurInputs in{fill.colors("radiance", radiance), fill.colors("depth", depth),
                                  fill.colors("motion", motion), view, settings};
        const gpu::Readback copy = frame_.readback(motionBlur(frame_, in).radiance);
        frame_.submit();
        frame_.wait();
        return decodeTexels(VK_FORMAT_R16G16B16A16_SFLOAT, frame_.bytes(copy));
    }

private:
    gpu::Frame frame_;
};

float at(const std::vector<vec4>& picture, uint32_t x, uint32_t y) {
    return picture.at(size_t(y) * size.x + x).x;
}

/// Mean of a column, without the rows at the picture's edges.
float column(const std::vector<vec4>& picture, uint32_t x) {
    float sum = 0.0F;
    for (uint32_t y = 8; y < size.y - 8; ++y) {
        sum += at(picture, x, y);
    }
    return sum / static_cast<float>(size.y - 16);
}

/// Share of a shutter's time in which a bar from `left` to `right` covers the middle of a pixel. half: of its streak.
float covered(float x, float left, float right, float half) {
    return std::max(std::min(x + half, right) - std::max(x - half, left), 0.0F) / (2.0F * half);
}

/// Upright, 40 pixels wide.
bool isBar(const uvec2& p) {
    return p.x >= 60 && p.x < 100;
}

TEST_F(MotionBlur, WhatStandsStillIsUntouchedToTheBit) {
    BlurRun run(device());
    const Picture still = [](const uvec2& p) { return Point{vec3(float((p.x * 37 + p.y * 101) % 64) / 32.0F)}; };
    const std::vector<vec4> blurred = run(still);
    for (uint32_t i = 0; i < size.x * size.y; ++i) {
        ASSERT_EQ(blurred[i], vec4(still(uvec2(i % size.x, i / size.x)).radiance, 0.5F)) << i;
    }
}

TEST_F(MotionBlur, AMovingThingSweepsOverItsEdgesByTheShuttersShare) {
    BlurRun run(device());
    for (const float moved : {8.0F, 24.0F, -16.0F}) {
        const std::vector<vec4> blurred = run(
            [&](const uvec2& p) {
                return isBar(p) ? Point{vec3(1.0F), 2.0F, vec2(moved, 0.0F)} : Point{vec3(0.0F), 4.0F};
            },
            stillView(), {.enabled = 1, .shutter = 0.5F, .samples = 32, .maxLength = 0.25F});
        const float half = 0.25F * std::abs(moved);
        for (uint32_t x = 40; x < 120; ++x) {
            EXPECT_NEAR(column(blurred, x), covered(float(x) + 0.5F, 60.0F, 100.0F, half), 0.08F) << moved << " " << x;
        }
    }
}

// 4 pixels wide, with a streak of 8: it covers no pixel for all of the time, and keeps its light.
TEST_F(MotionBlur, AThinThingKeepsItsLight) {
    BlurRun run(device());
    const std::vector<vec4> blurred = run(
        [&](const uvec2& p) {
            const bool thin = p.x >= 78 && p.x < 82;
            return thin ? Point{vec3(8.0F), 2.0F, vec2(16.0F, 0.0F)} : Point{vec3(0.0F), 4.0F};
        },
        stillView(), {.enabled = 1, .samples = 64, .maxLength = 0.25F});
    float sum = 0.0F;
    for (uint32_t x = 60; x < 100; ++x) {
        sum += column(blurred, x);
        EXPECT_NEAR(column(blurred, x), 8.0F * covered(float(x) + 0.5F, 78.0F, 82.0F, 4.0F), 0.8F) << x;
    }
    EXPECT_NEAR(sum, 4.0F * 8.0F, 3.2F);
}

TEST_F(MotionBlur, AStillThingBeforeAMovingBackgroundStaysSharp) {
    BlurRun run(device());
    const auto stripe = [](uint32_t x) { return x / 4 % 2 == 0 ? 1.0F : 0.0F; };
    const std::vector<vec4> blurred = run([&](const uvec2& p) {
        return isBar(p) ? Point{vec3(20.0F + stripe(p.y)), 2.0F} : Point{vec3(stripe(p.x)), 4.0F, vec2(16.0F, 0.0F)};
    });
    for (uint32_t y = 0; y < size.y; ++y) {
        for (uint32_t x = 20; x < size.x - 20; ++x) {
            if (isBar({x, y})) {
                ASSERT_EQ(at(blurred, x, y), 20.0F + stripe(y)) << x;
            } else {
                // Interpolation between pixels brings a part of the pixel at its edge, over half a streak.
                const bool beside = x >= 60 - 5 && x < 100 + 5;
                ASSERT_LE(at(blurred, x, y), beside ? 3.0F : 1.0F) << "the thing's light at " << x;
            }
        }
    }
    // A streak of 8 pixels covers each pair of stripes once.
    EXPECT_NEAR(column(blurred, 30), 0.5F, 0.05F);
    EXPECT_NEAR(column(blurred, 32), 0.5F, 0.05F);
}

// A camera that turns moves all of the background, which has no motion in the G-buffer.
TEST_F(MotionBlur, TheBackgroundFollowsTheCamera) {
    BlurRun run(device());
    Camera camera = builtin::camera("turning", vec3(0.0F), {0.0F, 0.0F, -1.0F}, 50);
    const ViewParams before = makeViewParams(camera, size, 0, 0);
    camera.target.x += 0.1F;
    ViewParams now = makeViewParams(camera, size, 1, 0);
    const auto stripes = [](const uvec2& p) {
        return Point{vec3(p.x / 8 % 2 == 0 ? 1.0F : 0.0F), std::numeric_limits<float>::infinity()};
    };
    now.previousWorldToClip = now.worldToClip;
    EXPECT_EQ(at(run(stripes, now), 83, 48), 1.0F) << "the camera stands still";
    now.previousWorldToClip = before.worldToClip;
    const float pixels = 0.1F * now.size.y / (2.0F * std::tan(glm::radians(25.0F)));  // since the last frame
    const std::vector<vec4> blurred = run(stripes, now);
    EXPECT_NEAR(column(blurred, 79),
                covered(79.5F, 80.0F, 88.0F, 0.25F * pixels) + covered(79.5F, 64.0F, 72.0F, 0.25F * pixels), 0.1F);
}

TEST_F(MotionBlur, StaysFinite) {
    BlurRun run(device());
    constexpr float nan = std::numeric_limits<float>::quiet_NaN();
    const std::vector<vec4> blurred = run([&](const uvec2& p) {
        const uint32_t i = p.x + size.x * p.y;
        const vec2 moved = i % 7 == 0 ? vec2(nan, 1.0F) : i % 5 == 0 ? vec2(1e9F, -1e9F) : vec2(9.0F, -5.0F);
        return Point{vec3(60000.0F), i % 11 == 0 ? nan : i % 3 == 0 ? -1.0F : 1e-6F + float(i), moved};
    });
    for (const vec4& texel : blurred) {
        ASSERT_TRUE(std::isfinite(texel.x) && texel.x >= 0.0F && texel.x <= 65504.0F);
    }
}

}  // namespace
}  // namespace reflet::test::motion_blur_test
