// Animation data of a scene: nodes, keyframes, skins and morph targets. scene/pose.h evaluates them at a time.
// After: Khronos, glTF 2.0 Specification, 2021, sections 3.5, 3.7.2.2, 3.7.3 and 3.11.
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
    enum class Target : uint8_t { translation, rotation, scale, weights, property };

    uint32_t node = 0;
    Target target = Target::translation;
    Interpolation interpolation = Interpolation::linear;
    std::vector<float> times;  ///< seconds, not negative, ascending; at least one
    /// One for each time; cubicSpline: three (in-tangent, value, out-tangent). Rotations: unit quaternions x, y, z, w.
    std::vector<vec4> values;
    /// Target::weights, instead of `values`: in place of each of them, one number per morph target of the node's mesh.
    std::vector<float> weights;
};

/// What a PropertyChannel changes: a factor of materials, up to `uvScale`, or what is at nodes. scene/property.h
/// applies them.
enum class Property : uint8_t {
    baseColor,
    metallic,
    roughness,
    normalScale,
    occlusionStrength,
    alphaCutoff,
    emissiveFactor,    ///< Material::emissive is the product
    emissiveStrength,  ///< of both
    ior,
    specular,
    specularColor,
    transmission,
    thickness,
    attenuationColor,
    attenuationDistance,
    dispersion,
    clearcoat,
    clearcoatRoughness,
    clearcoatNormalScale,
    sheenColor,
    sheenRoughness,
    anisotropy,
    anisotropyRotation,
    iridescence,
    iridescenceIor,
    iridescenceThinnest,
    iridescenceThickest,
    diffuseTransmission,
    diffuseTransmissionColor,
    uvOffset,  ///< TextureSlot::uvTransform follows from all three
    uvRotation,
    uvScale,
    lightColor,      ///< Lamp::intensity is the product
    lightIntensity,  ///< of both
    lightRange,
    innerCone,
    outerCone,
    fovY,
    near,
    far,
    orthographicHeight,
    visible,  ///< of the node and all below it; 0: not
};

/// Keyframes of a property (KHR_animation_pointer).
struct PropertyChannel {
    Property property = Property::baseColor;
    uint32_t texture = 0;           ///< of uv…: index into materialTextures
    std::vector<uint32_t> targets;  ///< indices into Scene::materials, or of nodes that have the lamp or camera
    Channel keys;                   ///< without a node
};

struct Animation {
    std::string name;
    std::vector<Channel> channels;
    std::vector<PropertyChannel> properties;
};

/// Joints that deform meshes, with the inverse bind matrix of each (mesh to joint in the bind pose).
struct Skin {
    std::vector<uint32_t> joints;   ///< indices into Scene::nodes; not empty
    std::vector<mat4> inverseBind;  ///< one per joint
    int32_t shownBy = -1;           ///< node whose visibility the skin's meshes have; < 0: always visible
};

/// A joint that moves a vertex.
struct JointWeight {
    uint32_t joint = 0;   ///< of the skin
    float weight = 1.0F;  ///< > 0
};

/// The joints of a vertex: a range of Mesh::jointWeights, whose weights sum to 1. Vertices may share it.
struct VertexSkin {
    uint32_t first = 0;
    uint32_t count = 0;
};

/// What one morph target adds to a vertex at weight 1, in object space.
struct MorphDelta {
    uint32_t target = 0;
    vec3 position{0.0F};
    vec3 normal{0.0F};
    vec3 tangent{0.0F};
};

/// The morph targets of a mesh: a vertex is where it is plus the weighted sum of its deltas. Targets that leave a
/// vertex alone have no delta there, and vertices may share deltas.
struct Morph {
    struct Range {
        uint32_t first = 0;  ///< index into `deltas`
        uint32_t count = 0;
    };

    std::vector<Range> vertices;  ///< one per position; empty: the mesh has no morph targets
    std::vector<MorphDelta> deltas;
    std::vector<Aabb> targets;  ///< per target: a box that holds its position deltas and 0
};

}  // namespace reflet
