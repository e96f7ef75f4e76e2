// Interactive camera movement.
#include "scene/camera_control.h"

#include <gtest/gtest.h>

namespace reflet::camera_control_test {
namespace {

Camera cameraAt(const vec3& position, const vec3& target = vec3(0.0F)) {
    Camera camera;
    camera.position = position;
    camera.target = target;
    return camera;
}

void expectNear(const vec3& a, const vec3& b, float most = 1e-4F) {
    EXPECT_LE(glm::length(a - b), most) << a.x << ' ' << a.y << ' ' << a.z;
}

// Image position of a point relative to the centre, right and down, in fractions of the image height.
vec2 seen(const Camera& camera, const vec3& point) {
    const vec4 clip = viewToClip(camera, 1.0F) * worldToView(camera) * vec4(point, 1.0F);
    return 0.5F * vec2(clip) / clip.w;
}

TEST(CameraControl, OrbitKeepsTheTargetAndTheDistance) {
    Camera camera = cameraAt({0, 1, 5}, {0, 1, 0});
    orbit(camera, {glm::half_pi<float>(), 0.0F});
    expectNear(camera.position, {-5, 1, 0});  // the view follows the pointer to the right
    expectNear(camera.target, {0, 1, 0});
    orbit(camera, {0.3F, 0.4F});
    EXPECT_NEAR(glm::distance(camera.position, camera.target), 5.0F, 1e-4F);
    EXPECT_GT(camera.position.y, 1.5F) << "dragging down looks from above";
    orbit(camera, {0.0F, 10.0F});
    EXPECT_GT(glm::length(glm::cross(camera.target - camera.position, camera.up)), 0.01F) << "never flips over";
}

TEST(CameraControl, TurningStaysInPlace) {
    Camera camera = cameraAt({0, 0, 5});
    turn(camera, {0.2F, 0.1F});
    expectNear(camera.position, {0, 0, 5});
    EXPECT_GT(camera.target.x, 0.5F) << "to the right";
    EXPECT_LT(camera.target.y, -0.3F) << "down";
}

TEST(CameraControl, PanningKeepsThePointUnderThePointer) {
    for (const float height : {0.0F, 6.0F}) {
        Camera camera = cameraAt({2, 3, 5}, {1, 1, 0});
        camera.orthographicHeight = height;
        const vec3 held = camera.target;
        pan(camera, {0.2F, -0.1F});
        const vec2 now = seen(camera, held);
        EXPECT_NEAR(now.x, 0.2F, 1e-4F);
        EXPECT_NEAR(now.y, -0.1F, 1e-4F);
    }
}

TEST(CameraControl, DollyApproachesTheTargetAndNeverPassesIt) {
    Camera camera = cameraAt({0, 0, 4});
    dolly(camera, 0.5F);
    expectNear(camera.position, {0, 0, 2});
    for (int i = 0; i < 100; ++i) {
        dolly(camera, 0.1F);
    }
    EXPECT_GT(camera.position.z, 0.0F);
    camera.orthographicHeight = 3.0F;
    dolly(camera, 2.0F);
    EXPECT_FLOAT_EQ(camera.orthographicHeight, 6.0F);
}

TEST(CameraControl, FlyingIsAlongTheCamerasOwnAxes) {
    Camera camera = cameraAt({0, 0, 5});
    fly(camera, {1, 2, 3});
    expectNear(camera.position, {1, 2, 2});
    expectNear(camera.target, {1, 2, -3});
}

TEST(CameraControl, DetachesACameraFromItsNode) {
    Camera camera = cameraAt({0, 0, 5});
    camera.node = 3;
    camera.aims = false;
    orbit(camera, {0.1F, 0.0F});
    EXPECT_EQ(camera.node, -1);
    EXPECT_TRUE(camera.aims);
}

}  // namespace
}  // namespace reflet::camera_control_test
