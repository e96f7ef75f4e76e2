// The methods other than fixed steps: hits on walls at known depths, misses, and the DDA against the exhaustive march.
#include "shader/march_scene.h"

#include <algorithm>
#include <cmath>

namespace reflet::test::march_methods_test {
namespace {

constexpr uint32_t methods[] = {marchMethodHalving, marchMethodDda, marchMethodExhaustive, marchMethodHiz};

class Methods : public March {
protected:
    /// Rays of raysIntoDepth, with the options of the method.
    static std::vector<MarchInput> raysFor(uint32_t method, float thickness = 0.5F) {
        auto rays = raysIntoDepth(1.0F, method == marchMethodDda ? 1.0F : 0.4F);
        for (MarchInput& ray : rays) {
            ray.smallest = 0.001F;
            ray.thickness = thickness;
        }
        return rays;
    }
};

INSTANTIATE_TEST_SUITE_P(Cameras, Methods, ::testing::Bool(), [](const auto& camera) {
    return camera.param ? std::string("orthographic") : std::string("perspective");
});

TEST_P(Methods, meetAWallAtItsDepthAndInItsPixel) {
    for (const uint32_t method : methods) {
        const auto rays = raysFor(method);
        const auto answers = march(sceneOf({wallAt(10.0F)}), rays, method);
        for (size_t i = 0; i < rays.size(); ++i) {
            const double expected = toWall(rays[i], 10.0);
            ASSERT_EQ(answers[i].outcome, marchHit) << method << ": " << i;
            // Halving ends within its smallest step; the others solve for the depth itself.
            ASSERT_NEAR(answers[i].distance, expected, method == marchMethodHalving ? 0.0021 : 2e-4) << method;
            const glm::dvec3 at = glm::dvec3(rays[i].origin) + glm::dvec3(rays[i].direction) * expected;
            const glm::dvec2 pixel = project(at) - glm::dvec2(answers[i].pixelX, answers[i].pixelY);
            const double slack = method >= marchMethodExhaustive ? 0.01 : 1.01;
            ASSERT_TRUE(glm::all(glm::greaterThanEqual(pixel, glm::dvec2(-slack)))) << method << ": " << pixel.x;
            ASSERT_TRUE(glm::all(glm::lessThanEqual(pixel, glm::dvec2(1.0 + slack)))) << method << ": " << pixel.x;
        }
    }
}

TEST_P(Methods, fixedPointFindsAWallThatFillsTheScreen) {
    auto rays = raysFor(marchMethodFixedPoint);
    for (MarchInput& ray : rays) {
        ray.stepLength = 3.0F;
        ray.smallest = 0.02F;
        ray.maxSteps = 64;
    }
    const auto answers = march(sceneOf({wallAt(10.0F)}), rays, marchMethodFixedPoint);
    size_t found = 0;
    for (size_t i = 0; i < rays.size(); ++i) {
        if (answers[i].outcome == marchHit) {
            ASSERT_NEAR(answers[i].distance, toWall(rays[i], 10.0), 0.25) << i;
            ++found;
        }
    }
    EXPECT_GT(found, rays.size() * 9 / 10);
}

TEST_P(Methods, neverHitTheSky) {
    for (const uint32_t method :
         {marchMethodHalving, marchMethodFixedPoint, marchMethodDda, marchMethodExhaustive, marchMethodHiz}) {
        auto rays = raysFor(method, 1000.0F);
        for (const MarchAnswer& answer : march(sceneOf({}), rays, method)) {
            ASSERT_NE(answer.outcome, marchHit) << method;
        }
    }
}

// Reaching the step limit is a miss, and the last allowed step still counts.
TEST_P(Methods, hitWithTheLastStepAndMissWithOneLess) {
    const MarchScene scene = sceneOf({wallAt(10.0F)});
    for (const uint32_t method : methods) {
        if (method == marchMethodExhaustive) {
            continue;  // takes all the steps that it needs
        }
        auto rays = raysFor(method);
        const auto free = march(scene, rays, method);
        for (size_t i = 0; i < rays.size(); ++i) {
            rays[i].maxSteps = free[i].steps;
        }
        const auto exact = march(scene, rays, method);
        for (size_t i = 0; i < rays.size(); ++i) {
            ASSERT_EQ(exact[i].outcome, marchHit) << method;
            ASSERT_EQ(exact[i].steps, free[i].steps) << method;
            rays[i].maxSteps = free[i].steps - 1;
        }
        const auto fewer = march(scene, rays, method);
        for (size_t i = 0; i < rays.size(); ++i) {
            ASSERT_EQ(fewer[i].outcome, marchLimitReached) << method;
            ASSERT_EQ(fewer[i].steps, rays[i].maxSteps) << method;
        }
    }
}

TEST_P(Methods, leaveTheScreenOnEachOfItsSidesAndPastTheCamera) {
    const MarchScene scene = sceneOf({wallAt(50.0F)});
    for (const uint32_t method : methods) {
        const float step = method == marchMethodDda ? 1.0F : 0.02F;
        for (const vec3 direction : {vec3(1, 0, 0), vec3(-1, 0, 0), vec3(0, 1, 0), vec3(0, -1, 0), vec3(0, 0, 1)}) {
            const auto answer =
                march(scene, {{vec3(0.01F, 0.01F, -8.0F), direction, step, 4096, 0.3F, 1.0F, {}, 0.001F}}, method)
                    .front();
            EXPECT_EQ(answer.outcome, marchLeftScreen) << method << ": " << direction.x << direction.y << direction.z;
        }
    }
}

// A wall at 5 m covers the right half; rays pass a metre behind it.
TEST_P(Methods, passBehindAWallThatIsThinnerThanTheGap) {
    const MarchScene scene = sceneOf({wallAt(5.0F, vec2(0.5F, 0.0F), vec2(1.0F))});
    for (const uint32_t method : {marchMethodDda, marchMethodExhaustive, marchMethodHiz}) {
        MarchInput ray{vec3(-1.0F, 0.1F, -6.0F), vec3(1, 0, 0), 1.0F, 4096, 0.9F, 1.0F, {}, 0.001F};
        EXPECT_EQ(march(scene, {ray}, method).front().outcome, marchLeftScreen) << method;
        ray.thickness = 1.1F;
        const auto thick = march(scene, {ray}, method).front();
        EXPECT_EQ(thick.outcome, marchHit) << method;
        EXPECT_EQ(thick.pixelX, 160) << method;  // the wall's first column
        EXPECT_NEAR(thick.distance, 1.0F, 0.06F) << method;
    }
}

TEST_P(Methods, halvingIsOccludedByAWallThatIsThinnerThanTheGap) {
    const MarchScene scene = sceneOf({wallAt(5.0F, vec2(0.5F, 0.0F), vec2(1.0F))});
    const MarchInput ray{vec3(-1.0F, 0.1F, -6.0F), vec3(1, 0, 0), 0.4F, 4096, 0.9F, 1.0F, {}, 0.001F};
    EXPECT_EQ(march(scene, {ray}, marchMethodHalving).front().outcome, marchOccluded);
}

// Two walls with edges, seen from everywhere.
class Oracle : public Methods {
protected:
    static MarchScene edges() {
        return sceneOf(
            {wallAt(6.0F, vec2(0.3F, 0.2F), vec2(0.6F, 0.7F)), {vec4(0, 0.6F, 0.8F, 9.0F), vec2(-1.0F), vec2(2.0F)}});
    }

    static std::vector<MarchInput> raysEverywhere() {
        std::mt19937 random(3);
        std::uniform_real_distribution<float> unit(-1.0F, 1.0F);
        std::vector<MarchInput> rays;
        for (int i = 0; i < 10000; ++i) {
            const vec3 direction = glm::normalize(vec3(unit(random), unit(random), unit(random)));
            const vec3 origin(unit(random), unit(random), -4.0F + unit(random));
            rays.push_back({origin, direction, 1.0F, 4096, 0.4F, 1.0F, {}, 0.0F});
        }
        return rays;
    }

    /// Number of rays whose outcome, and whose pixel to within one, equals that of the exhaustive method.
    static size_t agreeing(const std::vector<MarchAnswer>& every, const std::vector<MarchAnswer>& answers) {
        size_t same = 0;
        for (size_t i = 0; i < every.size(); ++i) {
            const bool hit = every[i].outcome == marchHit;
            const bool near = std::abs(every[i].pixelX - answers[i].pixelX) <= 1 &&
                              std::abs(every[i].pixelY - answers[i].pixelY) <= 1;
            same += hit == (answers[i].outcome == marchHit) && (!hit || near) ? 1 : 0;
        }
        return same;
    }
};

INSTANTIATE_TEST_SUITE_P(Cameras, Oracle, ::testing::Bool(), [](const auto& camera) {
    return camera.param ? std::string("orthographic") : std::string("perspective");
});

TEST_P(Oracle, hitsBetweenAFifthAndFourFifthsOfTheRays) {
    const auto every = march(edges(), raysEverywhere(), marchMethodExhaustive);
    const auto hits = std::ranges::count(every, marchHit, &MarchAnswer::outcome);
    EXPECT_GT(hits, 2000);
    EXPECT_LT(hits, 8000);
}

// One step per column or row misses only corners of pixels.
TEST_P(Oracle, isFollowedByDdaOfStrideOneInNinetyNineOfAHundred) {
    const auto rays = raysEverywhere();
    EXPECT_GT(agreeing(march(edges(), rays, marchMethodExhaustive), march(edges(), rays, marchMethodDda)), 9900U);
}

TEST_P(Oracle, isFollowedByHierarchicalDepthInFarFewerSteps) {
    const auto rays = raysEverywhere();
    const auto every = march(edges(), rays, marchMethodExhaustive);
    const auto hiz = march(edges(), rays, marchMethodHiz);
    EXPECT_GT(agreeing(every, hiz), 9990U);
    const auto steps = [](const std::vector<MarchAnswer>& answers) {
        uint64_t sum = 0;
        for (const MarchAnswer& answer : answers) {
            sum += answer.steps;
        }
        return sum;
    };
    EXPECT_LT(steps(hiz), steps(every) / 3);
}

}  // namespace
}  // namespace reflet::test::march_methods_test
