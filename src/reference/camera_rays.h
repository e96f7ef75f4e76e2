// Camera rays through pixels, by a pinhole or a thin lens, and rays from points back to the camera for visibility
// tests.
#pragma once

#include "reference/ray_scene.h"

#include <cstdint>
#include <optional>

namespace reflet {

class CameraRays {
public:
    CameraRays(const Camera& camera, uvec2 size);

    /// The pinhole ray through a position in the image, in pixels; (0, 0) is its upper left corner. Unit direction.
    [[nodiscard]] Ray through(const vec2& pixel) const;
    [[nodiscard]] bool hasLens() const { return apertureRadius_ > 0.0F; }
    /// The thin-lens ray from a point of the aperture, uniform for u in [0, 1)², through the point where the pinhole
    /// ray meets the plane of focus. It starts at the near plane.
    [[nodiscard]] Ray throughLens(const vec2& pixel, const vec2& u) const;
    /// Metres in front of the camera, along the view axis.
    [[nodiscard]] float depth(const vec3& point) const { return glm::dot(forward_, point - position_); }
    /// If the point is in the view frustum, the ray from just off it toward the camera. Occlusion is not tested.
    [[nodiscard]] std::optional<Ray> backFrom(const vec3& point) const;

private:
    [[nodiscard]] vec2 onImagePlane(const vec2& pixel) const;

    vec3 position_;
    vec3 right_;
    vec3 up_;
    vec3 forward_;
    vec2 size_;
    vec2 halfExtent_;  ///< half size of the image plane at distance 1 (orthographic: at any distance)
    float near_;
    float far_;
    bool orthographic_;
    float apertureRadius_;
    float focusDistance_;
    uint32_t blades_;
    float bladeRotation_;
};

}  // namespace reflet
