// Camera rays, and rays from points back to the camera.
#include "reference/camera_rays.h"

#include "base/error.h"
#include "reference/aperture.h"

#include <cmath>

namespace reflet {

CameraRays::CameraRays(const Camera& camera, uvec2 size)
    : position_(camera.position),
      size_(size),
      near_(camera.near),
      far_(camera.orthographicHeight > 0.0F ? camera.far : std::numeric_limits<float>::infinity()),
      orthographic_(camera.orthographicHeight > 0.0F),
      apertureRadius_(camera.apertureRadius),
      focusDistance_(camera.focusDistance),
      blades_(camera.blades),
      bladeRotation_(camera.bladeRotation) {
    REFLET_CHECK(apertureRadius_ <= 0.0F || focusDistance_ > 0.0F, "focus distance {}", focusDistance_);
    const mat3 viewToWorld = glm::transpose(mat3(worldToView(camera)));
    right_ = viewToWorld[0];
    up_ = viewToWorld[1];
    forward_ = -viewToWorld[2];
    const float halfHeight = orthographic_ ? 0.5F * camera.orthographicHeight : std::tan(0.5F * camera.fovY);
    halfExtent_ = {halfHeight * size_.x / size_.y, halfHeight};
}

// On the image plane at distance 1 (orthographic: at any).
vec2 CameraRays::onImagePlane(const vec2& pixel) const {
    return vec2(2.0F, -2.0F) * (pixel / size_ - 0.5F) * halfExtent_;
}

Ray CameraRays::through(const vec2& pixel) const {
    const vec2 at = onImagePlane(pixel);
    const vec3 across = at.x * right_ + at.y * up_;
    if (orthographic_) {
        return {position_ + across, forward_, near_, far_};
    }
    const float length = std::sqrt(1.0F + glm::dot(at, at));
    return {position_, (forward_ + across) / length, near_ * length, far_};
}

Ray CameraRays::throughLens(const vec2& pixel, const vec2& u) const {
    const vec2 at = onImagePlane(pixel);
    const vec2 onLens = apertureRadius_ * onAperture(u, blades_, bladeRotation_);
    const vec2 origin = orthographic_ ? at + onLens : onLens;
    // Per metre along the view axis.
    const vec2 slope = (orthographic_ ? vec2(0.0F) : at) - onLens / focusDistance_;
    const float length = std::sqrt(1.0F + glm::dot(slope, slope));
    const vec3 direction = (forward_ + (slope.x * right_ + slope.y * up_)) / length;
    return {position_ + (origin.x * right_ + origin.y * up_), direction, near_ * length, far_ * length};
}

std::optional<Ray> CameraRays::backFrom(const vec3& point) const {
    const vec3 offset = point - position_;
    const float distance = glm::dot(offset, forward_);
    if (distance < near_ || distance > far_) {
        return std::nullopt;
    }
    const float scale = orthographic_ ? 1.0F : distance;
    const vec2 at(glm::dot(offset, right_), glm::dot(offset, up_));
    if (std::abs(at.x) > halfExtent_.x * scale || std::abs(at.y) > halfExtent_.y * scale) {
        return std::nullopt;
    }
    // Ends at the near plane; the camera does not see anything closer.
    const vec3 back = orthographic_ ? -forward_ * (distance - near_) : -offset * (1.0F - near_ / distance);
    return Ray{point, back, 0.0F, 1.0F};
}

}  // namespace reflet
