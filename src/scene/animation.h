// What moves in a scene: nodes, their key frames, and skins. scene/pose.h says where that puts everything at a time.
// After: Khronos, glTF 2.0 Specification, 2021, sections 3.5, 3.7.3 and 3.11.
#pragma once

#include "base/math.h"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace reflet {

/// A place that others hang from: scaled, then turned, then moved, and then as its parent is.
struct Node {
    int32_t parent = -1;  ///< index into Scene::nodes, less than the node's own; < 0: the world
    glm::dvec3 translation{0.0};
    glm::dquat rotation{1.0, 0.0, 0.0, 0.0};  ///< unit length
    glm::dvec3 scale{1.0};
    std::optional<glm::dmat4> matrix;  ///< in the place of the three; such a node has no channels
};

enum class Interpolation : uint8_t { step, linear, cubicSpline };

/// Key frames of one property of one node. Before the first key and after the last one the property stands still.
struct Channel {
    enum class Target : uint8_t { translation, rotation, scale };

    uint32_t node = 0;
    Target target = Target::translation;
    Interpolation interpolation = Interpolation::linear;
    std::vector<float> times;  ///< seconds, not negative, ascending; at least one
    /// One for each time; cubicSpline: three, tangent before it, value, tangent behind it. Rotations: unit quaternions
    /// x, y, z, w.
    std::vector<vec4> values;
};

struct Animation {
    std::string name;
    std::vector<Channel> channels;
};

/// What bends meshes: nodes, and for each the matrix from the mesh to it as the mesh was when it was bound.
struct Skin {
    std::vector<uint32_t> joints;   ///< indices into Scene::nodes; not empty
    std::vector<mat4> inverseBind;  ///< as many
};

/// What moves a vertex. Weights sum to 1, a joint of weight 0 is 0.
struct VertexSkin {
    glm::u16vec4 joints{0};  ///< of the skin
    vec4 weights{1, 0, 0, 0};
};

}  // namespace reflet
