// Test directions for functions of unit vectors.
#pragma once

#include "base/math.h"

#include <cmath>
#include <vector>

namespace reflet::test {

/// `count` directions spread evenly over the sphere (a Fibonacci spiral).
inline std::vector<vec3> spreadDirections(size_t count) {
    std::vector<vec3> directions;
    const double turn = glm::pi<double>() * (3.0 - std::sqrt(5.0));
    for (size_t i = 0; i < count; ++i) {
        const double z = 1.0 - (2.0 * static_cast<double>(i) + 1.0) / static_cast<double>(count);
        const double r = std::sqrt(1.0 - z * z);
        const double phi = turn * static_cast<double>(i);
        directions.emplace_back(r * std::cos(phi), r * std::sin(phi), z);
    }
    return directions;
}

/// The axes; then circles around each axis plane: on it and, by each of a few tiny offsets, a little off it.
inline std::vector<vec3> axesAndSeams() {
    std::vector<vec3> directions;
    for (int axis = 0; axis < 3; ++axis) {
        for (const float sign : {1.0F, -1.0F}) {
            vec3 n(0.0F);
            n[axis] = sign;
            directions.push_back(n);
        }
    }
    for (int axis = 0; axis < 3; ++axis) {
        for (const float off : {0.0F, -0.0F, 1e-38F, -1e-38F, 1e-20F, -1e-20F, 1e-7F, -1e-7F, 1e-4F, -1e-4F}) {
            for (int step = 0; step < 360; ++step) {
                const float angle = glm::radians(static_cast<float>(step));
                vec3 n(0.0F);
                n[axis] = off;
                n[(axis + 1) % 3] = std::cos(angle);
                n[(axis + 2) % 3] = std::sin(angle);
                directions.push_back(std::abs(off) < 1e-6F ? n : glm::normalize(n));
            }
        }
    }
    return directions;
}

/// Angle between two directions of any length, exact also for tiny angles [radians].
inline double angleBetween(const vec3& a, const vec3& b) {
    const glm::dvec3 p(a);
    const glm::dvec3 q(b);
    return std::atan2(glm::length(glm::cross(p, q)), glm::dot(p, q));
}

}  // namespace reflet::test
