// march.glsl: hits on walls at known depths, and every kind of miss. The camera looks along -Z from the origin; walls
// face it.
#include "shader/march_scene.h"

#include <algorithm>

namespace reflet::test::march_test {
namespace {

INSTANTIATE_TEST_SUITE_P(Cameras, March, ::testing::Bool(), [](const auto& camera) {
    return camera.param ? std::string("orthographic") : std::string("perspective");
});

TEST_P(March, meetsAWallWithinAStepOfItsDepthAndInItsPixel) {
    for (const float jitter : {1.0F, 0.001F, 0.37F}) {
        constexpr float stepLength = 0.07F;
        const auto rays = raysIntoDepth(jitter, stepLength);
        const auto answers = march(sceneOf({wallAt(10.0F)}), rays);
        for (size_t i = 0; i < rays.size(); ++i) {
            const glm::dvec3 o(rays[i].origin);
            const glm::dvec3 d(rays[i].direction);
            const double toWall = (o.z + 10.0) / -d.z;
            // The first sample behind the wall; if one lies on the wall within rounding, either of two samples is
            // right.
            const double samples = toWall / stepLength - jitter;
            ASSERT_EQ(answers[i].outcome, marchHit);
            ASSERT_GT(answers[i].distance, toWall - 1e-5);
            ASSERT_LT(answers[i].distance, toWall + stepLength + 1e-5);
            if (std::abs(samples - std::round(samples)) > 1e-3) {
                ASSERT_EQ(answers[i].steps, static_cast<uint32_t>(std::floor(samples)) + 2U);
            }
            ASSERT_NEAR(answers[i].distance, (answers[i].steps - 1 + static_cast<double>(jitter)) * stepLength, 2e-5);
            const glm::dvec2 at = project(o + d * static_cast<double>(answers[i].distance));
            const glm::dvec2 pixel(answers[i].pixelX, answers[i].pixelY);
            // 1e-3 of a pixel: where the rounding of the projection decides.
            ASSERT_TRUE(glm::all(glm::greaterThanEqual(at, pixel - 1e-3))) << at.x << ' ' << at.y;
            ASSERT_TRUE(glm::all(glm::lessThanEqual(at, pixel + 1.001))) << at.x << ' ' << at.y;
        }
    }
}

TEST_P(March, meetsATiltedWallWithinAStepAndAPixel) {
    const MarchWall tilted{vec4(glm::normalize(vec3(0.5F, 0.2F, 1.0F)), 7.0F), vec2(-1.0F), vec2(2.0F)};
    constexpr float stepLength = 0.02F;
    const auto rays = raysIntoDepth(1.0F, stepLength);
    const auto answers = march(sceneOf({tilted}), rays);
    for (size_t i = 0; i < rays.size(); ++i) {
        const double facing = glm::dot(vec3(tilted.plane), rays[i].direction);
        const double toWall = -glm::dot(tilted.plane, vec4(rays[i].origin, 1.0F)) / facing;
        // Half a pixel of the wall beside the ray: up to 0.055 m wide here, and as much in depth, seen this aslant.
        ASSERT_EQ(answers[i].outcome, marchHit);
        ASSERT_NEAR(answers[i].distance, toWall, stepLength + 0.05);
    }
}

TEST_P(March, reachesItsLimitAlongAWallThatItNeverMeets) {
    const MarchScene scene = sceneOf({wallAt(10.0F)});
    for (const vec3 direction : {vec3(1, 0, 0), vec3(0, 1, 0), vec3(-1, 0, 0)}) {
        for (const uint32_t budget : {1U, 7U, 64U}) {
            const auto answer = march(scene, {{vec3(0, 0, -9.99F), direction, 0.02F, budget, 0.5F, 1.0F}}).front();
            EXPECT_EQ(answer.outcome, marchLimitReached);
            EXPECT_EQ(answer.steps, budget);
            EXPECT_NEAR(answer.distance, 0.02F * static_cast<float>(budget), 1e-6F);
        }
    }
}

// Steps of 0.5 from z = -2.25: the wall at -10 lies between the fifteenth (-9.75) and the sixteenth (-10.25).
TEST_P(March, hitsWithItsLastStepAndMissesWithTheStepAfter) {
    MarchInput ray{vec3(0.1F, 0.1F, -2.25F), vec3(0, 0, -1), 0.5F, 16, 0.5F, 1.0F};
    const MarchScene scene = sceneOf({wallAt(10.0F)});
    const auto last = march(scene, {ray}).front();
    EXPECT_EQ(last.outcome, marchHit);
    EXPECT_EQ(last.steps, 16U);
    EXPECT_FLOAT_EQ(last.distance, 8.0F);
    ray.maxSteps = 15;
    const auto after = march(scene, {ray}).front();
    EXPECT_EQ(after.outcome, marchLimitReached);
    EXPECT_EQ(after.steps, 15U);
    ray.maxSteps = 0;
    const auto none = march(scene, {ray}).front();
    EXPECT_EQ(none.outcome, marchLimitReached);
    EXPECT_EQ(none.steps, 0U);
}

TEST_P(March, leavesTheScreenOnEachOfItsSides) {
    const MarchScene scene = sceneOf({wallAt(50.0F)});
    struct Side {
        vec3 direction;
        int column;  ///< of the last pixel; -1: any
        int row;
    };
    for (const Side& side :
         {Side{{1, 0, 0}, 319, -1}, Side{{-1, 0, 0}, 0, -1}, Side{{0, 1, 0}, -1, 0}, Side{{0, -1, 0}, -1, 179}}) {
        // A pixel at this distance is more than 0.03 m wide: no pixel is stepped over.
        const auto answer =
            march(scene, {{vec3(0.01F, 0.01F, -8.0F), side.direction, 0.02F, 4096, 0.3F, 1.0F}}).front();
        EXPECT_EQ(answer.outcome, marchLeftScreen);
        EXPECT_EQ(answer.pixelX, side.column < 0 ? 160 : side.column);
        EXPECT_EQ(answer.pixelY, side.row < 0 ? 89 : side.row);
        EXPECT_LT(answer.steps, 4096U);
    }
}

TEST_P(March, leavesTheScreenPastTheCamera) {
    const MarchScene scene = sceneOf({wallAt(10.0F)});
    const float near = 0.1F;
    for (const float jitter : {1.0F, 0.5F}) {
        // From 5 m in front of the camera back to it, through its near plane and its eye.
        const auto answer = march(scene, {{vec3(0, 0, -5), vec3(0, 0, 1), 0.03F, 4096, 100.0F, jitter}}).front();
        EXPECT_EQ(answer.outcome, marchLeftScreen);
        EXPECT_NEAR(answer.distance, 5.0F - near, 0.031F);
    }
    // One step jumps past the camera, another starts behind it.
    const auto leapt = march(scene, {{vec3(0, 0, -1), vec3(0, 0, 1), 4.0F, 64, 100.0F, 1.0F}}).front();
    EXPECT_EQ(leapt.outcome, marchLeftScreen);
    EXPECT_EQ(leapt.steps, 0U);
    const auto behind = march(scene, {{vec3(0, 0, 3), vec3(0, 0, 1), 0.1F, 64, 100.0F, 1.0F}}).front();
    EXPECT_EQ(behind.outcome, marchLeftScreen);
    EXPECT_EQ(behind.steps, 0U);
}

// A wall at 5 m covers the right half; rays pass a metre behind it.
TEST_P(March, passesBehindAWallThatIsThinnerThanTheGap) {
    const MarchScene scene = sceneOf({wallAt(5.0F, vec2(0.5F, 0.0F), vec2(1.0F))});
    MarchInput ray{vec3(-1.0F, 0.1F, -6.0F), vec3(1, 0, 0), 0.03F, 84, 0.9F, 1.0F};  // no pixel is stepped over
    const auto thin = march(scene, {ray}).front();
    EXPECT_EQ(thin.outcome, marchLimitReached);
    EXPECT_GT(thin.pixelX, 170);  // it was behind the wall
    ray.thickness = 1.1F;
    const auto thick = march(scene, {ray}).front();
    EXPECT_EQ(thick.outcome, marchHit);
    EXPECT_EQ(thick.pixelX, 160);  // the wall's first column
    EXPECT_NEAR(thick.distance, 1.0F, 0.06F);
}

TEST_P(March, passesInFrontOfWhatLiesBehindIt) {
    const MarchScene scene = sceneOf({wallAt(5.0F, vec2(0.7F, 0.0F), vec2(1.0F)), wallAt(20.0F)});
    const auto answer = march(scene, {{vec3(-1.0F, 0.1F, -4.0F), vec3(1, 0, 0), 0.05F, 30, 100.0F, 1.0F}}).front();
    EXPECT_EQ(answer.outcome, marchLimitReached);
}

TEST_P(March, neverHitsTheSky) {
    auto rays = raysIntoDepth(1.0F, 0.5F);
    for (MarchInput& ray : rays) {
        ray.maxSteps = 12;
        ray.thickness = 1000.0F;
    }
    for (const MarchAnswer& answer : march(sceneOf({}), rays)) {
        ASSERT_EQ(answer.outcome, marchLimitReached);
        ASSERT_EQ(answer.steps, 12U);
    }
}

// A floor 1 m below the camera, whose per-pixel depth looks like stairs to rays just above it; it ends at a wall.
class MarchOffTheFloor : public March {
protected:
    static MarchScene floorAndWall() { return sceneOf({{vec4(0, 1, 0, 1), vec2(-1.0F), vec2(2.0F)}, wallAt(20.0F)}); }

    static std::vector<MarchInput> raysAlongTheFloor(const vec3& normal) {
        std::vector<MarchInput> rays;
        for (int i = 0; i < 200; ++i) {
            const float part = static_cast<float>(i) / 200.0F;
            const vec3 origin(-0.5F + part, -1.0F, -8.0F - 3.0F * part);
            rays.push_back({origin, glm::normalize(vec3(0.1F, 0.002F, -1.0F)), 0.01F, 400, 1.0F, 1.0F, normal});
        }
        return rays;
    }
};

INSTANTIATE_TEST_SUITE_P(Cameras, MarchOffTheFloor, ::testing::Values(false));  // an orthographic one sees no floor

TEST_P(MarchOffTheFloor, neverHitsTheFloorThatTheRayLeaves) {
    const auto hits = [](const std::vector<MarchAnswer>& answers) {
        return std::ranges::count(answers, marchHit, &MarchAnswer::outcome);
    };
    EXPECT_GT(hits(march(floorAndWall(), raysAlongTheFloor(vec3(0.0F)))), 0);  // what the plane is there for
    EXPECT_EQ(hits(march(floorAndWall(), raysAlongTheFloor(vec3(0, 1, 0)))), 0);
}

TEST_P(MarchOffTheFloor, stillMeetsTheWallBehindIt) {
    auto rays = raysAlongTheFloor(vec3(0, 1, 0));
    for (MarchInput& ray : rays) {
        ray.direction = glm::normalize(vec3(0.1F, 0.05F, -1.0F));
        ray.maxSteps = 4096;
    }
    const auto answers = march(floorAndWall(), rays);
    for (size_t i = 0; i < rays.size(); ++i) {
        ASSERT_EQ(answers[i].outcome, marchHit);
        ASSERT_NEAR(answers[i].distance, (rays[i].origin.z + 20.0F) / -rays[i].direction.z, 0.0101F);
    }
}

}  // namespace
}  // namespace reflet::test::march_test
