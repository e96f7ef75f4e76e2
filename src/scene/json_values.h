// Reads and checks vectors and directions in view files and camera paths.
#pragma once

#include "base/json.h"
#include "base/math.h"

#include <cmath>
#include <string_view>
#include <vector>

namespace reflet {

/// Far beyond any scene, but safe from overflow in float arithmetic.
constexpr double largestInView = 1e12;
constexpr double radiansPerDegree = glm::pi<double>() / 180.0;

inline vec3 readVec3(const JsonNode& node, double min, double max, std::string_view unit = "") {
    const std::vector<double> values = node.numbers(3, min, max, unit);
    return {static_cast<float>(values[0]), static_cast<float>(values[1]), static_cast<float>(values[2])};
}

inline vec3 readPosition(const JsonNode& node) {
    return readVec3(node, -largestInView, largestInView, "metres");
}

/// A unit vector from three numbers that are not all zero. One that is a unit vector already, within the rounding of
/// floats, keeps its bits, so that a view that is written and read is the same view.
inline vec3 readDirection(const JsonNode& node) {
    const std::vector<double> values = node.numbers(3, -largestInView, largestInView);
    const glm::dvec3 direction(values[0], values[1], values[2]);
    const double length = glm::length(direction);
    if (!(length > 0.0)) {
        node.complainMustBe("a direction of non-zero length");
    }
    constexpr double rounding = 2e-7;
    return std::abs(length - 1.0) < rounding ? direction : direction / length;
}

/// The value of a required key.
inline JsonNode required(const JsonNode& node, const std::string& key) {
    const auto value = node.find(key);
    if (!value) {
        node.complain(fmt::format("'{}' is missing", key));
    }
    return *value;
}

}  // namespace reflet
