// Thickness of surfaces in march*.glsl (a step, or up to the back face), and the reported clear distance of rays.
#include "shader/march_scene.h"

#include <algorithm>

namespace reflet::test::march_thickness_test {
namespace {

constexpr uint32_t passing[] = {marchMethodLinear, marchMethodDda, marchMethodExhaustive, marchMethodHiz};

/// The method's own step: metres or pixels.
float stepOf(uint32_t method) {
    return method == marchMethodDda ? 1.0F : method == marchMethodHalving ? 0.4F : 0.03F;
}

class Thickness : public March {
protected:
    /// A ray to the right, 1 m left of the middle of the picture.
    static MarchInput sideways(uint32_t method, float z, float thickness) {
        return {vec3(-1.0F, 0.1F, z), vec3(1, 0, 0), stepOf(method), 4096, thickness, 1.0F, {}, 0.001F};
    }

    /// 5 m away, in the right half of the picture; its back, if it has one, half a metre behind.
    static MarchWall slab(bool closed, float lastU = 1.0F) {
        MarchWall wall = wallAt(5.0F, vec2(0.5F, 0.0F), vec2(lastU, 1.0F));
        wall.backPlane = closed ? vec4(0, 0, 1, 5.5F) : vec4(0.0F);
        return wall;
    }
};

INSTANTIATE_TEST_SUITE_P(Cameras, Thickness, ::testing::Bool(), [](const auto& camera) {
    return camera.param ? std::string("orthographic") : std::string("perspective");
});

TEST_P(Thickness, ofAStepFindsThinWallsThatSamplesStepOver) {
    const MarchScene scene = sceneOf({wallAt(10.0F)});
    for (const uint32_t method : {marchMethodLinear, marchMethodHalving}) {
        auto rays = raysIntoDepth(1.0F, 0.5F);
        for (MarchInput& ray : rays) {
            ray.thickness = 0.02F;
            ray.smallest = 0.3F;  // halving ends with steps of 0.25 m
        }
        const auto hits = [&] {
            return std::ranges::count(march(scene, rays, method), marchHit, &MarchAnswer::outcome);
        };
        EXPECT_LT(hits(), 100) << method;
        for (MarchInput& ray : rays) {
            ray.thickAsStep = 1;
        }
        EXPECT_EQ(hits(), 500) << method;
    }
}

TEST_P(Thickness, upToTheBackFaceLetsRaysPassBehindIt) {
    // Beyond the slab's right edge there is a wall that the ray meets.
    const MarchScene scene = sceneOf({slab(true, 0.6F), wallAt(8.0F, vec2(0.6F, 0.0F), vec2(1.0F))});
    for (const uint32_t method : passing) {
        MarchInput ray = sideways(method, -6.0F, 100.0F);
        ray.direction = glm::normalize(vec3(1.0F, 0.0F, -0.3F));
        const auto thick = march(scene, {ray}, method, false).front();
        EXPECT_EQ(thick.outcome, marchHit) << method;
        EXPECT_NEAR(thick.pixelX, 160, 1) << method;
        const auto passed = march(scene, {ray}, method, true).front();
        EXPECT_EQ(passed.outcome, marchHit) << method;
        EXPECT_NEAR(passed.distance, toWall(ray, 8.0), 0.04) << method;
        EXPECT_EQ(passed.lost, 1U) << method;
    }
    const auto halving = march(scene, {sideways(marchMethodHalving, -6.0F, 100.0F)}, marchMethodHalving, true).front();
    EXPECT_EQ(halving.outcome, marchOccluded);
}

TEST_P(Thickness, upToTheBackFaceStopsRaysInside) {
    const MarchScene scene = sceneOf({slab(true)});
    for (const uint32_t method :
         {marchMethodLinear, marchMethodHalving, marchMethodDda, marchMethodExhaustive, marchMethodHiz}) {
        const MarchInput ray = sideways(method, -5.4F, 0.01F);
        EXPECT_NE(march(scene, {ray}, method, false).front().outcome, marchHit) << method;
        const auto inside = march(scene, {ray}, method, true).front();
        EXPECT_EQ(inside.outcome, marchHit) << method;
        EXPECT_NEAR(inside.pixelX, 160, 1) << method;
        EXPECT_NEAR(inside.distance, 1.0, 0.06) << method;
    }
}

TEST_P(Thickness, isTheConstantWhereThereIsNoBackFace) {
    const MarchScene scene = sceneOf({slab(false)});
    for (const uint32_t method : passing) {
        EXPECT_EQ(march(scene, {sideways(method, -6.0F, 0.9F)}, method, true).front().outcome, marchLeftScreen)
            << method;
        EXPECT_EQ(march(scene, {sideways(method, -6.0F, 1.1F)}, method, true).front().outcome, marchHit) << method;
    }
}

constexpr uint32_t stepping[] = {marchMethodLinear, marchMethodHalving, marchMethodDda, marchMethodExhaustive,
                                 marchMethodHiz};

class Clear : public Thickness {
protected:
    /// Metres that a pixel is wide, z metres away.
    static double pixelWidth(double z) { return 1.0 / (project({1.0, 0.0, -z}).x - project({0.0, 0.0, -z}).x); }

    /// Uncertainty of the clear distance [m]: the step of the method, or a pixel.
    static double unknown(uint32_t method, double z) {
        return method == marchMethodLinear ? stepOf(method) : method == marchMethodHalving ? 0.001 : pixelWidth(z);
    }

    /// Rays to the right from several places left of the middle.
    static std::vector<MarchInput> raysBehind(uint32_t method, float thickness) {
        std::vector<MarchInput> rays;
        for (int i = 0; i < 100; ++i) {
            rays.push_back(sideways(method, -6.0F, thickness));
            rays.back().origin.x = -1.0F - 0.0173F * static_cast<float>(i);
        }
        return rays;
    }
};

INSTANTIATE_TEST_SUITE_P(Cameras, Clear, ::testing::Bool(), [](const auto& camera) {
    return camera.param ? std::string("orthographic") : std::string("perspective");
});

TEST_P(Clear, isTheWayToTheEdgeInFrontOfEverything) {
    const MarchScene scene = sceneOf({wallAt(50.0F)});
    for (const uint32_t method : stepping) {
        for (const vec3 direction : {vec3(1, 0, 0), vec3(-1, 0, 0), vec3(0, 1, 0), vec3(0, -1, 0)}) {
            MarchInput ray = sideways(method, -8.0F, 0.3F);
            ray.origin = vec3(0.01F, 0.01F, -8.0F);
            ray.direction = direction;
            ray.stepLength = method == marchMethodHalving ? 0.02F : ray.stepLength;
            const auto answer = march(scene, {ray}, method).front();
            const double half = 0.5 * (direction.x != 0.0F ? pixels.x : pixels.y) * pixelWidth(8.0);
            const double edge = half - 0.01 * (direction.x + direction.y);
            EXPECT_EQ(answer.outcome, marchLeftScreen) << method;
            EXPECT_EQ(answer.lost, 0U) << method;
            EXPECT_LE(answer.clear, edge + 1e-4) << method;
            EXPECT_GE(answer.clear, edge - (method == marchMethodHalving ? 0.0201 : unknown(method, 8.0))) << method;
        }
    }
}

// In front of the sky and in front of a wall: cells of hierarchical depth that hold both must not end it too early.
TEST_P(Clear, endsWhereTheRayGoesBehindSomething) {
    for (const MarchScene& scene : {sceneOf({slab(false)}), sceneOf({slab(false), wallAt(20.0F)})}) {
        for (const uint32_t method : stepping) {
            const auto rays = raysBehind(method, 0.9F);
            const auto answers = march(scene, rays, method);
            for (size_t i = 0; i < rays.size(); ++i) {
                const double behind = -rays[i].origin.x;  // the slab begins in the middle of the picture
                // dda's samples stand for half a pixel more, some of it the next one's.
                const double more = method == marchMethodDda ? 0.5 * pixelWidth(6.0) : 0.0;
                ASSERT_NE(answers[i].outcome, marchHit) << method;
                ASSERT_EQ(answers[i].lost, 1U) << method;
                ASSERT_LE(answers[i].clear, behind + more + 1e-4) << method;
                ASSERT_GE(answers[i].clear, behind - unknown(method, 6.0) - 1e-4) << method;
            }
        }
    }
}

TEST_P(Clear, endsBeforeTheHit) {
    for (const uint32_t method : stepping) {
        auto rays = raysBehind(method, 1.1F);
        const auto answers = march(sceneOf({slab(false)}), rays, method);
        for (size_t i = 0; i < rays.size(); ++i) {
            const double more = method == marchMethodDda ? 0.5 * pixelWidth(6.0) : 0.0;
            ASSERT_EQ(answers[i].outcome, marchHit) << method;
            ASSERT_LE(answers[i].clear, -rays[i].origin.x + more + 1e-4) << method;
            ASSERT_GE(answers[i].clear, -rays[i].origin.x - unknown(method, 6.0) - 1e-4) << method;
        }
    }
}

TEST_P(Clear, isAsFarAsTheStepsWent) {
    const MarchScene scene = sceneOf({wallAt(50.0F)});
    for (const uint32_t method : stepping) {
        if (method == marchMethodExhaustive) {
            continue;  // takes all the steps that it needs
        }
        MarchInput ray = sideways(method, -8.0F, 0.3F);
        ray.maxSteps = 5;
        const auto answer = march(scene, {ray}, method).front();
        EXPECT_EQ(answer.outcome, marchLimitReached) << method;
        EXPECT_EQ(answer.lost, 0U) << method;
        EXPECT_GT(answer.clear, 0.0F) << method;
        EXPECT_EQ(answer.clear, answer.distance) << method;
    }
}

}  // namespace
}  // namespace reflet::test::march_thickness_test
