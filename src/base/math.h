// Math: GLM under the names of GLSL, with Vulkan's depth range, and bounding boxes.
#pragma once

#define GLM_FORCE_DEPTH_ZERO_TO_ONE
#define GLM_FORCE_RADIANS
#include <glm/glm.hpp>
#include <glm/gtc/constants.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/quaternion.hpp>

#include <cmath>
#include <limits>

namespace reflet {

using glm::mat3;
using glm::mat4;
using glm::quat;
using glm::uvec2;
using glm::vec2;
using glm::vec3;
using glm::vec4;

constexpr auto pi = glm::pi<float>();
constexpr float largestHalf = 65504.0F;  ///< largest finite 16-bit float

inline bool isFinite(const vec4& v) {
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z) && std::isfinite(v.w);
}

inline bool isFinite(const mat4& m) {
    return isFinite(m[0]) && isFinite(m[1]) && isFinite(m[2]) && isFinite(m[3]);
}

/// An axis-aligned box. Empty until a point is added.
struct Aabb {
    vec3 min{std::numeric_limits<float>::max()};
    vec3 max{std::numeric_limits<float>::lowest()};

    bool operator==(const Aabb&) const = default;
    [[nodiscard]] bool empty() const { return min.x > max.x; }
    [[nodiscard]] vec3 center() const { return 0.5F * (min + max); }
    [[nodiscard]] vec3 size() const { return max - min; }
    [[nodiscard]] vec3 corner(unsigned i) const {
        return {(i & 1U) != 0 ? max.x : min.x, (i & 2U) != 0 ? max.y : min.y, (i & 4U) != 0 ? max.z : min.z};
    }

    void add(const vec3& p) {
        min = glm::min(min, p);
        max = glm::max(max, p);
    }
    void add(const Aabb& box) {
        min = glm::min(min, box.min);
        max = glm::max(max, box.max);
    }
};

/// Bounding box of a transformed box.
inline Aabb transformed(const Aabb& box, const mat4& aToB) {
    Aabb result;
    for (unsigned i = 0; i < 8; ++i) {
        result.add(vec3(aToB * vec4(box.corner(i), 1.0F)));
    }
    return result;
}

}  // namespace reflet
