// Many-light sampling: chooses one of many emissive triangles for a point.
#pragma once

#include "base/math.h"

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace reflet {

/// A point that receives light.
struct LightReceiver {
    vec3 position{0.0F};
    vec3 normal{0.0F};  ///< unit: light arrives only from its side; 0: from everywhere
};

/// A triangle with uniform emission. Degenerate ones are never chosen.
struct TriangleLight {
    vec3 a{0.0F};
    vec3 b{0.0F};
    vec3 c{0.0F};
    vec3 normal{0.0F};       ///< unit, of the side that emits
    bool bothSides = false;  ///< the other side emits, too
    float power = 0.0F;      ///< in any unit; 0: never chosen
};

/// A tree over triangles. Sampling descends from the root, and picks each child in proportion to an estimate of its
/// light at the receiver: power, cosines bounded by the child's sphere and cone of normals, inverse square of the
/// distance. Lights that cannot reach the receiver have probability 0. A. Conty Estevez and C. Kulla: Importance
/// Sampling of Many Lights with Adaptive Tree Splitting (HPG 2018).
class LightTree {
public:
    LightTree() = default;
    explicit LightTree(std::span<const TriangleLight> lights);

    [[nodiscard]] bool empty() const { return nodes_.empty(); }
    struct Choice {
        uint32_t light = 0;  ///< index into the constructor's list
        float probability = 0.0F;
    };
    /// Samples a light; u in [0, 1). nullopt: no light arrives.
    [[nodiscard]] std::optional<Choice> draw(const LightReceiver& at, float u) const;
    /// Probability that draw() returns the light.
    [[nodiscard]] float probability(const LightReceiver& at, uint32_t light) const;

private:
    struct Node {
        vec3 center{0.0F};
        float radius = 0.0F;     ///< radius of a sphere around all triangles
        vec3 axis{0.0F};         ///< axis of a cone around all normals
        float cosSpread = 1.0F;  ///< cosine of the cone's half angle; -1: any direction
        float power = 0.0F;
        bool bothSides = false;  ///< any triangle emits on both sides
        uint32_t first = 0;      ///< index of the first child, followed by the second; 0: a leaf
        uint32_t light = 0;      ///< index of a leaf's light
        uint32_t parent = 0;
    };

    class Builder;
    struct Cone;

    static constexpr uint32_t noLeaf = ~0U;  ///< marks a light that is never chosen

    // The smallest cone around both.
    [[nodiscard]] static Cone around(Cone a, Cone b);
    [[nodiscard]] static float estimate(const Node& node, const LightReceiver& at);

    std::vector<Node> nodes_;     ///< the root is the first
    std::vector<uint32_t> leaf_;  ///< leaf node of each light
};

}  // namespace reflet
