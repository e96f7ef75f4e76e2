// Interactive camera movement.
#include "scene/camera_control.h"

#include <algorithm>
#include <cmath>

namespace reflet {

namespace {

constexpr float steepest = glm::radians(89.0F);  // elevation; at 90 degrees left and right would be undefined
constexpr float nearest = 1e-3F;                 // metres to the target

struct Axes {
    vec3 right;
    vec3 up;
    vec3 ahead;
};

Axes axesOf(const Camera& camera) {
    const vec3 ahead = glm::normalize(camera.target - camera.position);
    const vec3 right = glm::normalize(glm::cross(ahead, camera.up));
    return {right, glm::cross(right, ahead), ahead};
}

// Rotates a direction about the vertical, then towards or away from it.
vec3 turned(const Camera& camera, const vec3& direction, const vec2& radians) {
    const vec3 vertical = glm::normalize(camera.up);
    const float height = std::asin(std::clamp(glm::dot(direction, vertical), -1.0F, 1.0F));
    const vec3 level = direction - vertical * glm::dot(direction, vertical);
    const vec3 along = glm::length(level) > 1e-6F ? glm::normalize(level) : axesOf(camera).up;
    const vec3 across = glm::cross(vertical, along);
    const vec3 way = std::cos(radians.x) * along + std::sin(radians.x) * across;
    const float steep = std::clamp(height + radians.y, -steepest, steepest);
    return std::cos(steep) * way + std::sin(steep) * vertical;
}

float distanceOf(const Camera& camera) {
    return std::max(glm::length(camera.target - camera.position), nearest);
}

// Detaches the camera from its node.
void takeOver(Camera& camera) {
    camera.node = -1;
    camera.aims = true;
}

}  // namespace

void orbit(Camera& camera, const vec2& radians) {
    takeOver(camera);
    const float distance = distanceOf(camera);
    const vec3 back = glm::normalize(camera.position - camera.target);
    camera.position = camera.target + distance * turned(camera, back, {-radians.x, radians.y});
}

void turn(Camera& camera, const vec2& radians) {
    takeOver(camera);
    const float distance = distanceOf(camera);
    const vec3 ahead = glm::normalize(camera.target - camera.position);
    camera.target = camera.position + distance * turned(camera, ahead, {-radians.x, -radians.y});
}

void pan(Camera& camera, const vec2& heights) {
    takeOver(camera);
    const Axes axes = axesOf(camera);
    const float height = camera.orthographicHeight > 0.0F ? camera.orthographicHeight
                                                          : 2.0F * distanceOf(camera) * std::tan(0.5F * camera.fovY);
    const vec3 step = height * (heights.y * axes.up - heights.x * axes.right);
    camera.position += step;
    camera.target += step;
}

void dolly(Camera& camera, float factor) {
    takeOver(camera);
    if (camera.orthographicHeight > 0.0F) {
        camera.orthographicHeight = std::max(camera.orthographicHeight * factor, nearest);
        return;
    }
    const vec3 back = glm::normalize(camera.position - camera.target);
    camera.position = camera.target + back * std::max(distanceOf(camera) * factor, nearest);
}

void fly(Camera& camera, const vec3& metres) {
    takeOver(camera);
    const Axes axes = axesOf(camera);
    const vec3 step = metres.x * axes.right + metres.y * axes.up + metres.z * axes.ahead;
    camera.position += step;
    camera.target += step;
}

float flightSpeed(const Aabb& box) {
    return box.empty() ? 1.0F : 0.25F * std::max(glm::length(box.size()), nearest);
}

}  // namespace reflet
