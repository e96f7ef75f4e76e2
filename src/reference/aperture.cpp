// Maps the unit square to an aperture, so that points that are well spread in one are so in the other.
#include "reference/aperture.h"

#include <algorithm>
#include <cmath>

namespace reflet {

namespace {

// P. Shirley and K. Chiu, "A Low Distortion Map Between Disk and Square", 1997.
vec2 onDisk(const vec2& u) {
    const vec2 at = 2.0F * u - 1.0F;
    if (at == vec2(0.0F)) {
        return at;
    }
    const bool wide = std::abs(at.x) > std::abs(at.y);
    const float radius = wide ? at.x : at.y;
    const float angle = wide ? 0.25F * pi * at.y / at.x : 0.5F * pi - 0.25F * pi * at.x / at.y;
    return radius * vec2(std::cos(angle), std::sin(angle));
}

vec2 corner(uint32_t index, uint32_t blades, float rotation) {
    const float angle = rotation + 2.0F * pi * static_cast<float>(index) / static_cast<float>(blades);
    return {std::cos(angle), std::sin(angle)};
}

// One of the triangles between the centre and an edge, then a point in it.
vec2 onPolygon(const vec2& u, uint32_t blades, float rotation) {
    const float place = u.x * static_cast<float>(blades);
    const uint32_t edge = std::min(static_cast<uint32_t>(place), blades - 1);
    const float out = std::sqrt(u.y);
    const float along = place - static_cast<float>(edge);
    return out * glm::mix(corner(edge, blades, rotation), corner(edge + 1, blades, rotation), along);
}

}  // namespace

vec2 onAperture(const vec2& u, uint32_t blades, float rotation) {
    return blades == 0 ? onDisk(u) : onPolygon(u, blades, rotation);
}

}  // namespace reflet
