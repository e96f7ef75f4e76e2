// Exact properties of the default view and the camera matrices.
#include "scene/scene.h"

#include <gtest/gtest.h>

#include <cmath>

namespace reflet::scene_test {
namespace {

constexpr float aspect = 16.0F / 9.0F;

Camera obliqueCamera() {
    Camera camera;
    camera.position = {3, 4, -2};
    camera.target = {-1, 0.5F, 6};
    camera.near = 0.25F;
    camera.fovY = glm::radians(50.0F);
    return camera;
}

struct Projected {
    vec2 uv{0.0F};
    float depth = 0.0F;
    float w = 0.0F;
};

Projected projectFromView(const Camera& camera, const vec4& pointV) {
    const vec4 clip = viewToClip(camera, aspect) * pointV;
    return {0.5F + 0.5F * vec2(clip) / clip.w, clip.z / clip.w, clip.w};
}

Projected project(const Camera& camera, const vec3& pointW) {
    return projectFromView(camera, worldToView(camera) * vec4(pointW, 1.0F));
}

/// A scene of one mesh without triangles whose bounds are `box`.
Scene sceneOf(const Aabb& box) {
    Scene scene;
    scene.meshes.emplace_back();
    scene.meshes.back().bounds = box;
    scene.instances.emplace_back();
    return scene;
}

Aabb boxOf(const vec3& min, const vec3& max) {
    Aabb box;
    box.add(min);
    box.add(max);
    return box;
}

void expectNear(const vec3& a, const vec3& b, float tolerance) {
    EXPECT_LE(glm::length(a - b), tolerance)
        << a.x << ' ' << a.y << ' ' << a.z << " is not " << b.x << ' ' << b.y << ' ' << b.z;
}

TEST(Camera, ThePositionIsTheOriginOfViewSpaceAndTheTargetIsStraightAheadAtItsDistance) {
    const Camera camera = obliqueCamera();
    const mat4 matrix = worldToView(camera);
    expectNear(vec3(matrix * vec4(camera.position, 1)), vec3(0), 1e-5F);
    expectNear(vec3(matrix * vec4(camera.target, 1)), {0, 0, -glm::distance(camera.target, camera.position)}, 1e-5F);
}

TEST(Camera, WorldToViewIsARotationAndATranslation) {
    const mat3 rotation(worldToView(obliqueCamera()));
    EXPECT_NEAR(glm::determinant(rotation), 1.0F, 1e-5F);
    const mat3 product = rotation * glm::transpose(rotation);
    for (int column = 0; column < 3; ++column) {
        expectNear(product[column], mat3(1.0F)[column], 1e-5F);
    }
}

TEST(Camera, TheDefaultCameraLooksAlongMinusZWithXToTheRight) {
    Camera camera;
    camera.position = vec3(0);
    camera.target = {0, 0, -1};
    EXPECT_EQ(worldToView(camera), mat4(1.0F));
}

TEST(Camera, UpParallelToTheViewStillGivesARotation) {
    for (const vec3& direction : {vec3(0, 1, 0), vec3(0, -1, 0), vec3(1, 0, 0), vec3(0, 0, 1), vec3(1, 2, 3)}) {
        for (const float sign : {1.0F, -1.0F, 0.0F}) {
            Camera camera;
            camera.position = vec3(0);
            camera.target = direction;
            camera.up = sign * direction;
            EXPECT_NEAR(glm::determinant(mat3(worldToView(camera))), 1.0F, 1e-5F);
            expectNear(vec3(worldToView(camera) * vec4(direction, 1)), {0, 0, -glm::length(direction)}, 1e-5F);
        }
    }
}

TEST(Perspective, DepthIsOneAtTheNearPlaneAndZeroAtInfinity) {
    const Camera camera = obliqueCamera();
    EXPECT_EQ(projectFromView(camera, {0.3F, -0.2F, -camera.near, 1}).depth, 1.0F);
    EXPECT_EQ(projectFromView(camera, {0.3F, -0.2F, -1, 0}).depth, 0.0F);
}

TEST(Perspective, DepthIsNearOverDistanceAlongTheView) {
    const Camera camera = obliqueCamera();
    EXPECT_FLOAT_EQ(projectFromView(camera, {1, 2, -5, 1}).depth, camera.near / 5.0F);
    EXPECT_FLOAT_EQ(projectFromView(camera, {1, 2, -5, 1}).w, 5.0F);
}

TEST(Perspective, TheTargetIsInTheMiddleUpIsUpAndRightIsRight) {
    const Camera camera = obliqueCamera();
    const vec2 middle = project(camera, camera.target).uv;
    EXPECT_NEAR(middle.x, 0.5F, 1e-5F);
    EXPECT_NEAR(middle.y, 0.5F, 1e-5F);
    const vec3 right = glm::cross(camera.target - camera.position, camera.up);
    EXPECT_LT(project(camera, camera.target + vec3(0, 0.1F, 0)).uv.y, 0.5F);
    EXPECT_GT(project(camera, camera.target + 0.01F * right).uv.x, 0.5F);
}

TEST(Perspective, TheVerticalFieldOfViewReachesFromEdgeToEdge) {
    const Camera camera = obliqueCamera();
    const float half = std::tan(0.5F * camera.fovY);
    EXPECT_NEAR(projectFromView(camera, {0, 7 * half, -7, 1}).uv.y, 0.0F, 1e-6F);
    EXPECT_NEAR(projectFromView(camera, {0, -7 * half, -7, 1}).uv.y, 1.0F, 1e-6F);
    EXPECT_NEAR(projectFromView(camera, {7 * half * aspect, 0, -7, 1}).uv.x, 1.0F, 1e-6F);
}

TEST(Perspective, ClipSpaceGoesBackToTheWorldPointItCameFrom) {
    const Camera camera = obliqueCamera();
    const mat4 worldToClip = viewToClip(camera, aspect) * worldToView(camera);
    const mat4 clipToWorld = glm::inverse(worldToClip);
    for (const vec3& point : {vec3(0, 0, 3), vec3(-2, 1, 9), vec3(1, 3, 0.5F)}) {
        vec4 clip = worldToClip * vec4(point, 1);
        clip /= clip.w;
        const vec4 back = clipToWorld * clip;
        expectNear(vec3(back) / back.w, point, 1e-3F);
    }
}

TEST(Orthographic, DepthIsOneAtTheNearAndZeroAtTheFarPlaneAndLinearBetween) {
    Camera camera = obliqueCamera();
    camera.orthographicHeight = 4.0F;
    camera.far = 20.25F;
    EXPECT_NEAR(projectFromView(camera, {1, 1, -camera.near, 1}).depth, 1.0F, 1e-6F);
    EXPECT_NEAR(projectFromView(camera, {1, 1, -10.25F, 1}).depth, 0.5F, 1e-6F);
    EXPECT_NEAR(projectFromView(camera, {1, 1, -camera.far, 1}).depth, 0.0F, 1e-6F);
}

TEST(Orthographic, TheHeightReachesFromEdgeToEdgeAtEveryDistance) {
    Camera camera = obliqueCamera();
    camera.orthographicHeight = 4.0F;
    for (const float distance : {1.0F, 100.0F}) {
        const Projected corner = projectFromView(camera, {2 * aspect, 2, -distance, 1});
        EXPECT_NEAR(corner.uv.x, 1.0F, 1e-6F);
        EXPECT_NEAR(corner.uv.y, 0.0F, 1e-6F);
        EXPECT_EQ(corner.w, 1.0F);
    }
}

TEST(SceneBounds, AreEmptyWithoutInstances) {
    EXPECT_TRUE(Scene{}.bounds().empty());
    EXPECT_TRUE(sceneOf(Aabb{}).bounds().empty());
}

TEST(SceneBounds, ReachAroundEveryInstanceWhereItStands) {
    Scene scene = sceneOf(boxOf({-1, -1, -1}, {1, 1, 1}));
    scene.instances.emplace_back();
    scene.instances.back().objectToWorld = glm::translate(mat4(1.0F), vec3(10, 0, 0));
    EXPECT_EQ(scene.bounds().min, vec3(-1));
    EXPECT_EQ(scene.bounds().max, vec3(11, 1, 1));
}

TEST(DefaultView, TakesTheFirstCameraTheSunAndTheEnvironmentOfTheScene) {
    Scene scene = sceneOf(boxOf({-1, -1, -1}, {1, 1, 1}));
    scene.cameras.resize(2);
    scene.cameras[0].name = "first";
    scene.sun = Sun{.direction = {1, 0, 0}, .irradiance = vec3(2)};
    scene.environment.radiance = {1, 2, 3};
    const View view = defaultView(scene);
    EXPECT_EQ(view.camera.name, "first");
    EXPECT_EQ(view.sun.direction, vec3(1, 0, 0));
    EXPECT_EQ(view.sun.irradiance, vec3(2));
    EXPECT_EQ(view.environment.radiance, vec3(1, 2, 3));
}

TEST(DefaultView, LightsASceneWithoutLightFromAboveAndBehindTheCamera) {
    for (const vec3& position : {vec3(0, 1, 5), vec3(0, 5, 0), vec3(0, -5, 0), vec3(4, 0, 0)}) {
        Scene scene;
        scene.cameras.emplace_back();
        scene.cameras.back().position = position;
        const Sun sun = defaultView(scene).sun;
        EXPECT_GT(sun.irradiance.x, 0.0F);
        EXPECT_NEAR(glm::length(sun.direction), 1.0F, 1e-5F);
        EXPECT_LT(sun.direction.y, -0.5F);
        if (position.x != 0 || position.z != 0) {
            EXPECT_GT(glm::dot(sun.direction, -position), 0.0F);
        }
    }
}

TEST(DefaultView, AddsNoSunIfALampOrTheEnvironmentLightsTheScene) {
    Scene withLamp;
    withLamp.lamps.emplace_back();
    EXPECT_EQ(defaultView(withLamp).sun.irradiance, vec3(0));
    Scene withEnvironment;
    withEnvironment.environment.radiance = vec3(1);
    EXPECT_EQ(defaultView(withEnvironment).sun.irradiance, vec3(0));
    Scene withDarkSun;
    withDarkSun.sun = Sun{};
    EXPECT_EQ(defaultView(withDarkSun).sun.irradiance, vec3(0));
}

}  // namespace
}  // namespace reflet::scene_test
