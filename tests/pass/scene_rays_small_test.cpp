// Rays through small scenes with known results: closed, empty, degenerate, alpha cutouts; and invalid rays.
#include "pass/harness.h"
#include "pass/scene_rays_harness.h"
#include "scene/builtin/assemble.h"

#include <algorithm>

namespace reflet::test::scene_rays_small_test {
namespace {

constexpr float infinity = std::numeric_limits<float>::infinity();
constexpr float nan = std::numeric_limits<float>::quiet_NaN();

class SmallSceneRays : public SceneRaysTest, public ::testing::WithParamInterface<RayMethod> {
protected:
    void SetUp() override {
        SceneRaysTest::SetUp();
        if (GetParam() == RayMethod::query && !hasRayQuery()) {
            GTEST_SKIP() << "this device has no ray query";
        }
    }
    static std::vector<TestHit> traceScene(const Scene& scene, const std::vector<TestRay>& rays) {
        return trace(SceneRays(device(), scene, GetParam()), rays);
    }
    // Both ways agree that it hits (or not).
    static void expectFound(const TestHit& hit, bool found) {
        EXPECT_EQ(hit.found, found ? 1U : 0U);
        EXPECT_EQ(hit.any, found ? 1U : 0U);
    }
};

// A triangle in the plane z = 0 whose second corner lies along x, the third along y; size in metres.
Mesh triangleMesh(float size) {
    Mesh mesh;
    for (const vec3& p : {vec3(0), vec3(size, 0, 0), vec3(0, size, 0)}) {
        builtin::addVertex(mesh, p, vec3(0, 0, 1), vec2(0));
    }
    mesh.indices = {0, 1, 2};
    builtin::finish(mesh);
    return mesh;
}

Scene sceneOfMesh(Mesh mesh) {
    return sceneOf({}, std::move(mesh));
}

TEST_P(SmallSceneRays, MeetASingleTriangleWhereItIs) {
    const auto hits = traceScene(sceneOfMesh(triangleMesh(4)), {{{1, 2, 3}, 0, {0, 0, -1}, infinity},
                                                                {{1, 2, -3}, 0, {0, 0, 2}, infinity},
                                                                {{3, 2, 3}, 0, {0, 0, -1}, infinity},
                                                                {{1, 2, 3}, 0, {0, 0, 1}, infinity}});
    expectFound(hits[0], true);
    EXPECT_FLOAT_EQ(hits[0].distance, 3.0F);
    EXPECT_FLOAT_EQ(hits[0].barycentrics.x, 0.25F);
    EXPECT_FLOAT_EQ(hits[0].barycentrics.y, 0.5F);
    expectFound(hits[1], true);  // from behind; distances count in lengths of the direction
    EXPECT_FLOAT_EQ(hits[1].distance, 1.5F);
    expectFound(hits[2], false);  // beside it
    expectFound(hits[3], false);  // away from it
}

TEST_P(SmallSceneRays, KeepBetweenTheirTwoDistances) {
    const vec3 from{1, 2, 3};
    const vec3 down{0, 0, -1};
    const auto hits =
        traceScene(sceneOfMesh(triangleMesh(4)),
                   {{from, 0, down, 2.999F}, {from, 2.999F, down, 3.001F}, {from, 3.001F, down, infinity}});
    expectFound(hits[0], false);
    expectFound(hits[1], true);
    expectFound(hits[2], false);
}

TEST_P(SmallSceneRays, MeetNothingInAnEmptyScene) {
    Scene scene;
    expectFound(traceScene(scene, {{{0, 0, 0}, 0, {0, 0, -1}, infinity}})[0], false);
    scene = sceneOfMesh({});
    expectFound(traceScene(scene, {{{0, 0, 0}, 0, {0, 0, -1}, infinity}})[0], false);
}

// Every ray from inside, at corners, edges and between.
TEST_P(SmallSceneRays, DoNotLeaveAClosedMesh) {
    // Watertightness depends on the driver: llvmpipe 25 misses 2 in 10,000 of these, most of them at corners and edges.
    const double mayLeave = GetParam() == RayMethod::query ? 1e-3 : 0.0;
    Mesh mesh = builtin::sphere(1.0F, 48);
    for (vec3& p : mesh.positions) {  // no neat numbers
        p = p * vec3(1.37F, 0.71F, 2.03F) + 0.05F * glm::sin(7.3F * vec3(p.z, p.x, p.y));
    }
    builtin::finish(mesh);
    const Scene scene = sceneOfMesh(mesh);
    std::vector<TestRay> rays;
    for (const vec3& origin : {vec3(0), vec3(0.31F, -0.17F, 0.23F), vec3(-0.5F, 0.1F, 1.1F)}) {
        for (size_t i = 0; i < mesh.indices.size(); i += 3) {
            const vec3 a = mesh.positions[mesh.indices[i]];
            const vec3 b = mesh.positions[mesh.indices[i + 1]];
            for (const float part : {0.0F, 0.5F, 0.123F, 0.9999F}) {
                rays.push_back({origin, 0, glm::mix(a, b, part) - origin, infinity});
            }
        }
    }
    for (TestRay ray : randomRays(scene, 300000)) {
        ray.origin *= 0.01F;
        rays.push_back(ray);
    }
    const auto hits = traceScene(scene, rays);
    const auto out = std::ranges::count(hits, 0U, &TestHit::found) + std::ranges::count(hits, 0U, &TestHit::any);
    EXPECT_LE(static_cast<double>(out), mayLeave * static_cast<double>(hits.size()));
}

// Axes, whose other components are 0, of either sign, and origins in the planes of boxes and triangles.
TEST_P(SmallSceneRays, AlongAnAxisMeetABox) {
    if (GetParam() == RayMethod::query) {
        GTEST_SKIP() << "what runs along a side is up to the driver; llvmpipe 25 loses it";
    }
    const Scene scene = sceneOfMesh(builtin::box(vec3(1)));
    std::vector<TestRay> rays;
    for (int axis = 0; axis < 3; ++axis) {
        for (const float sign : {-1.0F, 1.0F}) {
            for (const float zero : {-0.0F, 0.0F}) {
                for (const float aside : {-1.0F, -0.5F, 0.0F, 0.25F, 1.0F}) {
                    TestRay ray{vec3(aside), 0, vec3(zero), infinity};
                    ray.origin[axis] = -3 * sign;
                    ray.direction[axis] = sign;
                    rays.push_back(ray);
                }
            }
        }
    }
    for (const TestHit& hit : traceScene(scene, rays)) {
        expectFound(hit, true);
        EXPECT_FLOAT_EQ(hit.distance, 2.0F);
    }
}

TEST_P(SmallSceneRays, LookThroughTrianglesWithoutArea) {
    Mesh mesh = triangleMesh(4);
    mesh.indices = {0, 0, 0, 0, 1, 1, 2, 1, 2, 0, 3, 1, 0, 1, 2};  // points, edges, and the triangle itself
    builtin::addVertex(mesh, {2, 0, 0}, vec3(0, 0, 1), vec2(0));
    const auto hits =
        traceScene(sceneOfMesh(mesh), {{{1, 2, 3}, 0, {0, 0, -1}, infinity}, {{1, 0, 3}, 0, {0, 0, -1}, infinity}});
    for (const TestHit& hit : hits) {
        expectFound(hit, true);
        EXPECT_EQ(hit.firstIndex, 12U);
    }
}

// acceptHit of the test refuses the half that is nearer to the first corner than to the second.
TEST_P(SmallSceneRays, GoOnWhereAcceptHitRefuses) {
    Scene scene = sceneOfMesh(triangleMesh(4));
    Material leaf;
    leaf.alphaCutoff = 0.5F;
    builtin::place(scene, "leaf", builtin::addMaterial(scene, leaf), triangleMesh(4), builtin::at({0, 0, 1}));
    const vec3 down{0, 0, -1};
    const auto hits = traceScene(
        scene, {{{1, 0.5F, 3}, 0, down, infinity}, {{3, 0.5F, 3}, 0, down, infinity}, {{1, 0.5F, 3}, 0, down, 2.5F}});
    expectFound(hits[0], true);
    EXPECT_FLOAT_EQ(hits[0].distance, 3.0F);  // through the leaf
    EXPECT_EQ(hits[0].instance, 0U);
    expectFound(hits[1], true);
    EXPECT_FLOAT_EQ(hits[1].distance, 2.0F);
    EXPECT_EQ(hits[1].instance, 1U);
    expectFound(hits[2], false);
}

TEST_P(SmallSceneRays, EndEvenIfTheyAreInvalid) {
    if (GetParam() == RayMethod::query) {
        GTEST_SKIP() << "Vulkan forbids rays that are not finite";
    }
    const Scene scene = sceneOfMesh(builtin::sphere(1.0F, 32));
    std::vector<TestRay> rays;
    for (const float odd : {nan, infinity, -infinity, 0.0F}) {
        rays.push_back({{odd, 0, 3}, 0, {0, 0, odd}, infinity});
        rays.push_back({{0, 0, 3}, 0, {odd, odd, odd}, infinity});
        rays.push_back({{0, 0, 3}, 0, {odd, 0, 0}, infinity});
        rays.push_back({{odd, odd, odd}, 0, {odd, 1, 0}, odd});
        rays.push_back({{odd, odd, odd}, odd, {odd, odd, odd}, odd});
    }
    for (const TestHit& hit : traceScene(scene, rays)) {
        expectFound(hit, false);
    }
}

std::string methodName(const ::testing::TestParamInfo<RayMethod>& method) {
    return method.param == RayMethod::query ? "query" : "traversal";
}

INSTANTIATE_TEST_SUITE_P(By, SmallSceneRays, ::testing::Values(RayMethod::traversal, RayMethod::query), methodName);

}  // namespace
}  // namespace reflet::test::scene_rays_small_test
