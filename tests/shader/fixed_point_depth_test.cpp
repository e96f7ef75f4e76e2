// fixed_point_depth.glsl against the textbook formula of standard depth in double precision.
#include "effects/gbuffer/kept_depth.h"
#include "renderer/renderer.h"
#include "shader/harness.h"

#include <algorithm>
#include <cmath>

namespace reflet::test::fixed_point_depth_test {
namespace {

class FixedPointDepth : public ShaderTest {
protected:
    static std::vector<float> keep(const std::vector<float>& depths, const KeptDepthParams& params) {
        return mapOnDevice<float>("fixed_point_depth_test.comp", depths, params);
    }

    static KeptDepthParams paramsOf(const Camera& camera, DepthBuffer buffer) {
        return keptDepthParams(makeViewParams(camera, {64, 36}, 0, 0), buffer);
    }
};

// Standard depth f / (f - n) · (1 - n / d), rounded to whole steps, and the distance that it then stands for.
double distanceKept(double distance, double near, double far, double steps) {
    const double standard = std::clamp(far / (far - near) * (1.0 - near / distance), 0.0, 1.0);
    const double rounded = std::round(standard * steps) / steps;
    return near / (1.0 - rounded * (far - near) / far);
}

TEST_F(FixedPointDepth, ofAPerspectiveViewIsTheNearestWholeNumberOfStandardDepth) {
    for (const double near : {1e-4, 0.05, 1.0}) {
        for (const auto& [buffer, steps] :
             {std::pair(DepthBuffer::standard16, 65535.0), {DepthBuffer::standard24, 16777215.0}}) {
            Camera camera;
            camera.near = static_cast<float>(near);
            std::vector<float> depths;
            depths.reserve(1300);
            for (int i = 0; i < 1300; ++i) {  // to 20 million times the near plane's distance, 2 km for the nearest
                depths.push_back(static_cast<float>(std::pow(1.013, -i)));
            }
            const auto kept = keep(depths, paramsOf(camera, buffer));
            for (size_t i = 0; i < depths.size(); ++i) {
                const double expected = near / distanceKept(near / static_cast<double>(depths[i]), near, 1000.0, steps);
                // A float between two integers may round to either: then it is one step off.
                const double standard = 1000.0 / (1000.0 - near) * (1.0 - static_cast<double>(depths[i])) * steps;
                const double fromTie = std::abs(standard - std::floor(standard) - 0.5);
                const double roundings = 4.0 * 6e-8 * (static_cast<double>(depths[i]) * steps + 1.0);
                const double step = fromTie < roundings ? 1.0 / steps : 0.0;
                ASSERT_NEAR(kept[i], expected, step + 4.0 * 6e-8 * std::max(expected, static_cast<double>(depths[i])))
                    << "near " << near << ", " << steps << " steps, " << near / static_cast<double>(depths[i]) << " m";
            }
        }
    }
}

TEST_F(FixedPointDepth, ofAnOrthographicViewIsEvenlySpacedOverItsRange) {
    Camera camera;
    camera.orthographicHeight = 4.0F;
    std::vector<float> depths;
    for (int i = 1; i < 61; ++i) {  // 65535 / 61 of them: none is near the middle between two whole numbers
        depths.push_back(static_cast<float>(i) / 61.0F);
    }
    const auto kept = keep(depths, paramsOf(camera, DepthBuffer::standard16));
    for (size_t i = 0; i < depths.size(); ++i) {
        EXPECT_NEAR(kept[i], std::round(static_cast<double>(depths[i]) * 65535.0) / 65535.0, 1e-7) << depths[i];
    }
}

TEST_F(FixedPointDepth, keepsSkySkyAndSurfacesSurfaces) {
    for (const float height : {0.0F, 4.0F}) {
        Camera camera;
        camera.orthographicHeight = height;
        for (const float near : {1e-6F, 0.05F, 990.0F}) {
            camera.near = near;
            const auto kept = keep({0.0F, 1e-15F, 1e-9F, 1e-5F, 0.5F, 1.0F}, paramsOf(camera, DepthBuffer::standard16));
            EXPECT_EQ(kept.front(), 0.0F);
            for (size_t i = 1; i < kept.size(); ++i) {
                EXPECT_GT(kept[i], 0.0F) << i << ", near " << near;
                EXPECT_LE(kept[i], 1.0F) << i << ", near " << near;
            }
            EXPECT_EQ(kept.back(), 1.0F);
        }
    }
}

}  // namespace
}  // namespace reflet::test::fixed_point_depth_test
