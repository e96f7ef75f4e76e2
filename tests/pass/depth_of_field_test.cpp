// Depth of field on made-up pictures: what is in focus does not change, disks have the thin lens's size and keep their
// light, sharp things do not leak into what is blurred behind them, and near things cover by their disks.
#include "effects/depth_of_field/depth_of_field.h"

#include "capture/texels.h"
#include "device/device.h"
#include "device/frame.h"
#include "pass/test_shaders.h"
#include "support/device_fixture.h"

#include <cmath>
#include <functional>
#include <limits>

namespace reflet::test::depth_of_field_test {
namespace {

constexpr uvec2 size(160, 120);
constexpr float near = 1.0F;
constexpr float infinitelyFar = std::numeric_limits<float>::infinity();

class DepthOfField : public DeviceTest {};

/// Radiance, and metres along the view axis.
struct Point {
    vec3 radiance{0.0F};
    float z = 4.0F;
};
using Picture = std::function<Point(const uvec2& pixel)>;

/// Focused at 4 m. The radius of the circle of confusion at infinity, in pixels of a height of size.y.
Lens lensOf(float atInfinity, uint32_t blades = 0) {
    return {.apertureRadius = atInfinity * 4.0F / static_cast<float>(size.y), .focusDistance = 4.0F, .blades = blades};
}

/// Signed, by the thin lens: aperture · (z - focus) / z, as seen from the aperture's centre.
float radiusAt(const Lens& lens, float z) {
    const float metres = std::isinf(z) ? lens.apertureRadius : lens.apertureRadius * (1.0F - lens.focusDistance / z);
    return metres / lens.focusDistance * static_cast<float>(size.y);
}

class DofRun {
public:
    explicit DofRun(gpu::Device& device) : frame_(device) { addPassTestShaders(device); }

    std::vector<vec4> operator()(const Picture& picture, const Lens& lens, DofSettings settings = {}) {
        settings.maxRadius = 0.25F;  // of such a small picture
        std::vector<vec4> radiance;
        std::vector<vec4> depth;
        for (uint32_t i = 0; i < size.x * size.y; ++i) {
            const Point p = picture(uvec2(i % size.x, i / size.x));
            radiance.emplace_back(p.radiance, 1.0F);
            depth.emplace_back(near / p.z);
        }
        Filler fill(frame_, size);
        frame_.begin();
        ViewParams view{};
        view.depthToDistance = vec4(near, 0.0F, 0.0F, 1.0F);
        view.eye = vec4(0.0F, 0.0F, 0.0F, 1.0F);
        view.size = vec2(size);
        view.pixelAngle = 1.0F / static_cast<float>(size.y);
        const gpu::Image shown = fill.colors("radiance", radiance);
        const DofInputs in{shown, fill.colors("depth", depth), {}, view, lens, settings};
        const gpu::Readback copy = frame_.readback(depthOfField(frame_, store_, in).radiance);
        frame_.submit();
        frame_.wait();
        return decodeTexels(VK_FORMAT_R16G16B16A16_SFLOAT, frame_.bytes(copy));
    }

private:
    gpu::Frame frame_;
    gpu::HistoryImage store_{"circle_of_confusion"};
};

float at(const std::vector<vec4>& picture, int x, int y) {
    return picture.at(static_cast<size_t>(y) * size.x + static_cast<size_t>(x)).x;
}

/// Of red light: its sum, and the radius of a uniform disk with the same second moment.
struct Spot {
    double energy = 0.0;
    double radius = 0.0;
};

Spot spotOf(const std::vector<vec4>& picture, const vec2& center) {
    Spot spot;
    double moment = 0.0;
    for (uint32_t i = 0; i < size.x * size.y; ++i) {
        const vec2 away = vec2(i % size.x, i / size.x) + 0.5F - center;
        spot.energy += picture[i].x;
        moment += double(picture[i].x) * glm::dot(away, away);
    }
    spot.radius = std::sqrt(2.0 * moment / spot.energy);
    return spot;
}

TEST_F(DepthOfField, WhatIsInFocusIsUntouchedToTheBit) {
    DofRun run(device());
    const Picture noise = [](const uvec2& p) { return Point{vec3(float((p.x * 37 + p.y * 101) % 64) / 32.0F), 4.0F}; };
    const std::vector<vec4> out = run(noise, lensOf(20));
    for (uint32_t i = 0; i < size.x * size.y; ++i) {
        ASSERT_EQ(out[i].x, noise(uvec2(i % size.x, i / size.x)).radiance.x) << i;
    }
}

TEST_F(DepthOfField, APointsDiskHasTheLensesRadiusAndAllOfItsLight) {
    DofRun run(device());
    for (const float z : {infinitelyFar, 16.0F, 8.0F, 2.5F, 2.0F}) {
        const Lens lens = lensOf(24);
        const auto point = [&](float behind) {
            return [=](const uvec2& p) {
                const bool lit = p.x / 2 == 40 && p.y / 2 == 30;
                return lit ? Point{vec3(1000.0F), z} : Point{vec3(0.0F), behind};
            };
        };
        for (const float behind : {infinitelyFar, z}) {
            const Spot spot = spotOf(run(point(behind), lens), {81, 61});
            EXPECT_NEAR(spot.energy, 4000.0, 40.0) << z << " before " << behind;
            const double radius = std::abs(radiusAt(lens, z));
            EXPECT_NEAR(spot.radius, radius, 0.03 * radius) << z << " before " << behind;
        }
    }
}

TEST_F(DepthOfField, AHighlightsDiskIsEvenAndHasASharpEdge) {
    DofRun run(device());
    const std::vector<vec4> out = run(
        [](const uvec2& p) {
            return Point{vec3(p.x / 2 == 40 && p.y / 2 == 30 ? 1000.0F : 0.01F), infinitelyFar};
        },
        lensOf(24));
    const float inside = 4.0F * 1000.0F / (glm::pi<float>() * 24.0F * 24.0F);
    for (int y = 0; y < 120; ++y) {
        for (int x = 0; x < 160; ++x) {
            const float away = glm::length(vec2(x, y) + 0.5F - vec2(81, 61));
            if (away < 22.0F) {
                ASSERT_NEAR(at(out, x, y), inside, 0.05F * inside) << x << ' ' << y;
            }
            if (away > 26.0F) {
                ASSERT_NEAR(at(out, x, y), 0.01F, 0.002F) << x << ' ' << y;
            }
        }
    }
}

/// Share of a disk's light in the pixel `away` from its centre.
double diskInPixel(const vec2& away, double radius) {
    constexpr int n = 16;
    int inside = 0;
    for (int i = 0; i < n * n; ++i) {
        const vec2 at = away + (vec2(i % n, i / n) + 0.5F) / float(n) - 0.5F;
        inside += glm::length(at) < radius ? 1 : 0;
    }
    return inside / (n * n * glm::pi<double>() * radius * radius);
}

TEST_F(DepthOfField, SmallDisksAreRound) {
    DofRun run(device());
    for (const float radius : {-3.3F, -2.5F, -1.5F, 1.0F, 1.5F, 2.0F, 2.5F, 3.0F, 3.2F, 3.4F, 3.6F, 4.5F}) {
        for (const uvec2& lit : {uvec2(80, 60), uvec2(81, 61)}) {
            // At 16 m, disks have three quarters of their radius at infinity; at 2 m, before the plane of focus, all of
            // it.
            const float z = radius > 0.0F ? 16.0F : 2.0F;
            const Lens lens = lensOf(radius > 0.0F ? radius / 0.75F : -radius);
            const std::vector<vec4> out = run(
                [&](const uvec2& p) {
                    return Point{vec3(p == lit ? 100.0F : 0.0F), z};
                },
                lens);
            double misplaced = 0.0;
            for (uint32_t i = 0; i < size.x * size.y; ++i) {
                const vec2 away = vec2(i % size.x, i / size.x) - vec2(lit);
                misplaced += 0.5 * std::abs(out[i].x - 100.0 * diskInPixel(away, std::abs(radius)));
            }
            EXPECT_LT(misplaced, 4.0) << "percent of the light of a disk of radius " << radius;
        }
    }
}

TEST_F(DepthOfField, AHighlightBehindWhatIsInFocusIsHidden) {
    DofRun run(device());
    const std::vector<vec4> out = run(
        [](const uvec2& p) {
            const float lit = p.x / 2 == 43 && p.y / 2 == 30 ? 1000.0F : 0.01F;
            return p.x < 80 ? Point{vec3(1.0F), 4.0F} : Point{vec3(lit), infinitelyFar};
        },
        lensOf(24));
    EXPECT_GT(at(out, 81, 60), 1.0F);
    for (int y = 0; y < 120; ++y) {
        for (int x = 0; x < 80; ++x) {
            ASSERT_EQ(at(out, x, y), 1.0F) << x << ' ' << y;
        }
    }
}

TEST_F(DepthOfField, EvenSurfacesStayEven) {
    DofRun run(device());
    for (const float z : {infinitelyFar, 8.0F, 4.4F, 3.6F, 2.5F, 1.5F}) {
        const std::vector<vec4> out = run([&](const uvec2&) { return Point{vec3(3.0F), z}; }, lensOf(20));
        for (uint32_t i = 0; i < size.x * size.y; ++i) {
            ASSERT_NEAR(out[i].x, 3.0F, 0.03F) << z << " m, pixel " << i;
        }
    }
}

TEST_F(DepthOfField, ASharpEdgeDoesNotLeakIntoWhatIsBlurredBehindIt) {
    DofRun run(device());
    const std::vector<vec4> out = run(
        [](const uvec2& p) {
            return p.x < 80 ? Point{vec3(100.0F), 4.0F} : Point{vec3(1.0F), infinitelyFar};
        },
        lensOf(20));
    for (int y = 4; y < 116; ++y) {
        for (int x = 0; x < 160; ++x) {
            ASSERT_NEAR(at(out, x, y), x < 80 ? 100.0F : 1.0F, x < 80 ? 0.0F : 0.02F) << x << ' ' << y;
        }
    }
}

/// Share of a disk of radius 1 on the side of a line that is x away from its centre.
double diskBeyond(double x) {
    const double c = std::clamp(x, -1.0, 1.0);
    return (std::acos(c) - c * std::sqrt(1.0 - c * c)) / glm::pi<double>();
}

/// Largest difference, across a vertical edge at x = 80 of black at the left, from the share of disks of that radius.
double edgeError(const std::vector<vec4>& picture, double radius) {
    double worst = 0.0;
    for (int x = 50; x < 110; ++x) {
        const double expected = 1.0 - diskBeyond((x + 0.5 - 80.0) / radius);
        worst = std::max(worst, std::abs(at(picture, x, 60) - expected));
    }
    return worst;
}

TEST_F(DepthOfField, AnEdgeInFrontCoversByTheShareOfTheLensThatItHides) {
    DofRun run(device());
    const Lens lens = lensOf(20);
    const double radius = std::abs(radiusAt(lens, 2.0F));
    const std::vector<vec4> out = run(
        [](const uvec2& p) {
            return p.x < 80 ? Point{vec3(0.0F), 2.0F} : Point{vec3(1.0F), 4.0F};
        },
        lens);
    EXPECT_LT(edgeError(out, radius), 0.06);
}

TEST_F(DepthOfField, AnEdgeBehindIsBlurredByItsOwnDisks) {
    DofRun run(device());
    const Lens lens = lensOf(20);
    const double radius = radiusAt(lens, 8.0F);
    const std::vector<vec4> out = run(
        [](const uvec2& p) {
            return p.x < 80 ? Point{vec3(0.0F), 8.0F} : Point{vec3(1.0F), infinitelyFar};
        },
        lens);
    // Wider than in front: the background is composited in two classes of distance only.
    EXPECT_LT(edgeError(out, radius), 0.1);
}

TEST_F(DepthOfField, StaysFinite) {
    DofRun run(device());
    const float bad[] = {NAN, INFINITY, -INFINITY, -5.0F, 65504.0F};
    for (const float z : {infinitelyFar, 4.0F, 2.0F}) {
        const std::vector<vec4> out = run(
            [&](const uvec2& p) {
                return Point{vec3(p.x % 7 == 0 && p.y % 5 == 0 ? bad[(p.x / 7 + p.y) % 5] : 1.0F), z};
            },
            lensOf(20));
        for (const vec4& texel : out) {
            ASSERT_TRUE(texel.x >= 0.0F && texel.x <= 65504.0F) << z;
        }
    }
}

TEST_F(DepthOfField, DisksHaveTheAperturesShape) {
    DofRun run(device());
    const auto area = [&](uint32_t blades, float z, int direction) {
        Lens lens = lensOf(24, blades);
        const std::vector<vec4> out = run(
            [&](const uvec2& p) {
                return Point{vec3(p.x / 2 == 41 && p.y / 2 == 29 ? 1000.0F : 0.0F), z};
            },
            lens);
        // Brightest value: energy over area. Reach to the right, where a corner of far disks is.
        int reach = 0;
        while (reach < 70 && at(out, 82 + direction * reach, 59) > 0.3F * at(out, 82, 59)) {
            ++reach;
        }
        return std::pair(spotOf(out, {83, 59}).energy / at(out, 82, 59), reach);
    };
    const double circle = area(0, infinitelyFar, 1).first;
    EXPECT_NEAR(area(6, infinitelyFar, 1).first / circle, 0.827, 0.04);
    EXPECT_NEAR(area(3, infinitelyFar, 1).first / circle, 0.4135, 0.04);
    EXPECT_NEAR(area(3, infinitelyFar, 1).second, 24, 4);
    EXPECT_NEAR(area(3, infinitelyFar, -1).second, 12, 3);
    // In front of the plane of focus, disks are turned by half a turn.
    EXPECT_NEAR(area(3, 2.0F, 1).second, 12, 3);
    EXPECT_NEAR(area(3, 2.0F, -1).second, 24, 4);
}

}  // namespace
}  // namespace reflet::test::depth_of_field_test
