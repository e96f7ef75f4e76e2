// Unit vectors in two 16-bit numbers, as shaders/octahedral.glsl packs them.
#pragma once

#include "base/math.h"

#include <cstdint>

namespace reflet {

inline vec2 octahedralFold(const vec2& p) {
    return (1.0F - glm::abs(vec2(p.y, p.x))) * vec2(p.x >= 0.0F ? 1.0F : -1.0F, p.y >= 0.0F ? 1.0F : -1.0F);
}

/// n: unit.
inline uint32_t packUnitVector(const vec3& n) {
    const vec2 p = vec2(n) / (std::abs(n.x) + std::abs(n.y) + std::abs(n.z));
    return glm::packSnorm2x16(n.z >= 0.0F ? p : octahedralFold(p));
}

inline vec3 unpackUnitVector(uint32_t bits) {
    const vec2 p = glm::unpackSnorm2x16(bits);
    const float z = 1.0F - std::abs(p.x) - std::abs(p.y);
    return glm::normalize(vec3(z >= 0.0F ? p : octahedralFold(p), z));
}

}  // namespace reflet
