// Animation data of a scene: nodes, keyframes and skins. scene/pose.h evaluates them at a time.
// After: Khronos, glTF 2.0 Specification, 2021, sections 3.5, 3.7.3 and 3.11.
#pragma once

#include "base/math.h"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace reflet {

/// A node of the transform hierarchy. Scale, rotation and translation are applied in this order, then the parent's.
struct Node {
    int32_t parent = -1;  ///< index into Scene::nodes, less than the node's own; < 0: the world
    glm::dvec3 translation{0.0};
    glm::dquat rotation{1.0, 0.0, 0.0, 0.0};  ///< unit length
    glm::dvec3 scale{1.0};
    std::optional<glm::dmat4> matrix;  ///< replaces the three above; such a node has no channels
};

enum class Interpolation : uint8_t { step, linear, cubicSpline };

/// Keyframes of one property of one node. The value is constant before the first and after the last key.
struct Channel {
    enum class Target : uint8_t { translation, rotation, scale };

    uint32_t node = 0;
    Target target = Target::translation;
    Interpolation interpolation = Interpolation::linear;
    std::vector<float> times;  ///< seconds, not negative, ascending; at least one
    /// One for each time; cubicSpline: three (in-tangent, value, out-tangent). Rotations: unit quaternions x, y, z, w.
    std::vector<vec4> values;
};

struct Animation {
    std::string name;
    std::vector<Channel> channels;
};

/// Joints that deform meshes, with the inverse bind matrix of each (mesh to joint in the bind pose).
struct Skin {
    std::vector<uint32_t> joints;   ///< indices into Scene::nodes; not empty
    std::vector<mat4> inverseBind;  ///< one per joint
};

/// Joints and weights of a vertex. Weights sum to 1; where the weight is 0, the joint is 0.
struct VertexSkin {
    glm::u16vec4 joints{0};  ///< of the skin
    vec4 weights{1, 0, 0, 0};
};

}  // namespace reflet
