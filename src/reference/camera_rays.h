// Rays through pixels, and the way back: whether the camera sees a point.
#pragma once

#include "reference/ray_scene.h"

namespace reflet {

class CameraRays {
public:
    CameraRays(const Camera& camera, uvec2 size);

    /// Through a place in the picture in pixels, (0, 0) being its upper left corner. Unit direction.
    [[nodiscard]] Ray through(const vec2& pixel) const;
    /// Metres in front of the camera, along its axis.
    [[nodiscard]] float depth(const vec3& point) const { return glm::dot(forward_, point - position_); }
    /// Whether the point is in the picture, and the ray from just off it, toward the camera. Nothing hidden is tested.
    [[nodiscard]] std::optional<Ray> backFrom(const vec3& point) const;

private:
    vec3 position_;
    vec3 right_;
    vec3 up_;
    vec3 forward_;
    vec2 size_;
    vec2 halfExtent_;  ///< of the picture at distance 1 (orthographic: at any)
    float near_;
    float far_;
    bool orthographic_;
};

}  // namespace reflet
