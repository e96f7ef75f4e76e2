// Refinement after a hit of march*.glsl: bisection of the last step, and interpolation between the last two samples.
#include "shader/march_scene.h"

#include <algorithm>
#include <cmath>

namespace reflet::test::march_refine_test {
namespace {

class Refinement : public March {
protected:
    static constexpr float thickness = 3.0F;  // no sample behind the wall is beyond it

    /// Error of the hit distance of each ray [m]; positive: too far. All must hit.
    static std::vector<double> errors(const std::vector<MarchInput>& rays, uint32_t method) {
        const auto answers = march(sceneOf({wallAt(10.0F)}), rays, method);
        std::vector<double> result;
        for (size_t i = 0; i < rays.size(); ++i) {
            EXPECT_EQ(answers[i].outcome, marchHit) << method << ": " << i;
            result.push_back(answers[i].distance - toWall(rays[i], 10.0));
        }
        return result;
    }

    static std::vector<MarchInput> raysWith(float jitter, float step, uint32_t halvings, bool interpolate) {
        auto rays = raysIntoDepth(jitter, step);
        for (MarchInput& ray : rays) {
            ray.thickness = thickness;
            ray.smallest = 0.08F;
            ray.binarySteps = halvings;
            ray.interpolate = interpolate ? 1 : 0;
        }
        return rays;
    }
};

INSTANTIATE_TEST_SUITE_P(Cameras, Refinement, ::testing::Bool(), [](const auto& camera) {
    return camera.param ? std::string("orthographic") : std::string("perspective");
});

TEST_P(Refinement, leavesTheLastStepDividedByAPowerOfTwo) {
    constexpr float step = 0.31F;
    for (const uint32_t halvings : {0U, 1U, 3U, 6U}) {
        const auto found = errors(raysWith(0.37F, step, halvings, false), marchMethodLinear);
        const double left = step / std::pow(2.0, halvings);
        const auto [least, most] = std::ranges::minmax(found);
        EXPECT_GT(least, -2e-5) << halvings;
        EXPECT_LT(most, left + 2e-5) << halvings;
        EXPECT_GT(most, 0.9 * left) << halvings;  // and no better: it takes as many as it is told
    }
}

TEST_P(Refinement, leavesTheLastStepOfHalvingDividedByAPowerOfTwo) {
    for (const uint32_t halvings : {0U, 2U, 5U}) {
        const auto found = errors(raysWith(1.0F, 0.4F, halvings, false), marchMethodHalving);
        const auto [least, most] = std::ranges::minmax(found);
        EXPECT_GT(least, -2e-5) << halvings;
        EXPECT_LT(most, 0.08 / std::pow(2.0, halvings) + 2e-5) << halvings;
    }
}

TEST_P(Refinement, countsItsSteps) {
    const MarchScene scene = sceneOf({wallAt(10.0F)});
    for (const uint32_t method : {marchMethodLinear, marchMethodHalving}) {
        const auto plain = march(scene, raysWith(1.0F, 0.31F, 0, false), method);
        const auto refined = march(scene, raysWith(1.0F, 0.31F, 5, true), method);
        for (size_t i = 0; i < plain.size(); ++i) {
            ASSERT_EQ(refined[i].steps, plain[i].steps + 6);
        }
    }
}

// Between the last two samples, the depths of the ray and of the wall are both linear.
TEST_P(Refinement, byInterpolationFindsAPlaneExactly) {
    for (const float jitter : {1.0F, 0.37F, 0.001F}) {
        for (const uint32_t method : {marchMethodLinear, marchMethodHalving}) {
            if (method == marchMethodHalving && jitter < 0.1F) {
                continue;  // a first step of 0.3 mm would take it nowhere
            }
            for (const uint32_t halvings : {0U, 2U}) {
                for (const double error : errors(raysWith(jitter, 0.31F, halvings, true), method)) {
                    ASSERT_NEAR(error, 0.0, 1e-4) << method << ", jitter " << jitter;
                }
            }
        }
    }
}

TEST_P(Refinement, byInterpolationEndsInThePixelOfTheHit) {
    const auto rays = raysWith(0.37F, 0.31F, 0, true);
    const auto answers = march(sceneOf({wallAt(10.0F)}), rays, marchMethodLinear);
    for (size_t i = 0; i < rays.size(); ++i) {
        const glm::dvec3 hit = glm::dvec3(rays[i].origin) + glm::dvec3(rays[i].direction) * toWall(rays[i], 10.0);
        const glm::dvec2 within = project(hit) - glm::dvec2(answers[i].pixelX, answers[i].pixelY);
        ASSERT_TRUE(glm::all(glm::greaterThanEqual(within, glm::dvec2(-0.01)))) << within.x << ' ' << within.y;
        ASSERT_TRUE(glm::all(glm::lessThanEqual(within, glm::dvec2(1.01)))) << within.x << ' ' << within.y;
    }
}

class StrideRefinement : public Refinement {
protected:
    static constexpr float stride = 8.0F;

    /// Mean distance between hits and the plane along the rays [m].
    static double meanError(const MarchWall& wall, uint32_t halvings, bool interpolate) {
        const auto rays = raysWith(0.37F, stride, halvings, interpolate);
        const auto answers = march(sceneOf({wall}), rays, marchMethodDda);
        double sum = 0.0;
        double hits = 0.0;
        for (size_t i = 0; i < rays.size(); ++i) {
            if (answers[i].outcome == marchHit) {  // a ray that is shorter than a stride on the screen has no sample
                const double facing = glm::dot(vec3(wall.plane), rays[i].direction);
                sum += std::abs(answers[i].distance + glm::dot(wall.plane, vec4(rays[i].origin, 1.0F)) / facing);
                hits += 1.0;
            }
        }
        EXPECT_GT(hits, 480.0);
        return sum / hits;
    }

    static MarchWall tilted() { return {vec4(glm::normalize(vec3(0.5F, 0.2F, 1.0F)), 7.0F), vec2(-1.0F), vec2(2.0F)}; }
};

INSTANTIATE_TEST_SUITE_P(Cameras, StrideRefinement, ::testing::Bool(), [](const auto& camera) {
    return camera.param ? std::string("orthographic") : std::string("perspective");
});

TEST_P(StrideRefinement, keepsAFacingPlaneExact) {
    for (const uint32_t halvings : {0U, 1U, 3U, 6U}) {
        EXPECT_LT(meanError(wallAt(10.0F), halvings, false), 1e-4) << halvings;
    }
    EXPECT_LT(meanError(wallAt(10.0F), 0, true), 1e-4);
}

// 12 pixels lie between the samples around a hit. Three bisections reduce them to less than two; the remaining error is
// that one depth stands for a whole pixel.
TEST_P(StrideRefinement, bringsATiltedPlaneFromAStrideToAPixel) {
    const double plain = meanError(tilted(), 0, false);
    EXPECT_GT(plain, 0.035);
    EXPECT_LT(meanError(tilted(), 1, false), 0.8 * plain);
    EXPECT_LT(meanError(tilted(), 3, false), 0.35 * plain);
    EXPECT_LT(meanError(tilted(), 6, false), 0.25 * plain);
    EXPECT_LT(meanError(tilted(), 0, true), 0.25 * plain);
}

}  // namespace
}  // namespace reflet::test::march_refine_test
