// Chooses one of many emissive triangles for a point.
#pragma once

#include "base/math.h"

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace reflet {

/// Where light is received.
struct LightReceiver {
    vec3 position{0.0F};
    vec3 normal{0.0F};  ///< unit: light comes from its side alone; 0: from everywhere
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

/// A tree over triangles. A choice descends from the root, at each node in proportion to estimates of what both halves
/// give to the receiver: power, cosines bounded by the half's sphere and cone of normals, inverse square of the
/// distance. Where no light can arrive from, the probability is 0. A. Conty Estevez and C. Kulla: Importance Sampling
/// of Many Lights with Adaptive Tree Splitting (HPG 2018).
class LightTree {
public:
    LightTree() = default;
    explicit LightTree(std::span<const TriangleLight> lights);

    [[nodiscard]] bool empty() const { return nodes_.empty(); }
    struct Choice {
        uint32_t light = 0;  ///< in the constructor's list
        float probability = 0.0F;
    };
    /// u: in [0, 1). None: no light arrives.
    [[nodiscard]] std::optional<Choice> draw(const LightReceiver& at, float u) const;
    /// Probability that draw() returns the light.
    [[nodiscard]] float probability(const LightReceiver& at, uint32_t light) const;

private:
    struct Node {
        vec3 center{0.0F};
        float radius = 0.0F;     ///< of a sphere around all triangles
        vec3 axis{0.0F};         ///< of a cone around all normals
        float cosSpread = 1.0F;  ///< of the angle between its axis and its side; -1: any direction
        float power = 0.0F;
        bool bothSides = false;  ///< of any triangle
        uint32_t first = 0;      ///< child, after which the second follows; 0: a leaf
        uint32_t light = 0;      ///< of a leaf
        uint32_t parent = 0;
    };

    class Builder;
    struct Cone;

    static constexpr uint32_t noLeaf = ~0U;  ///< of a light that is never chosen

    // The smallest cone around both.
    [[nodiscard]] static Cone around(Cone a, Cone b);
    [[nodiscard]] static float estimate(const Node& node, const LightReceiver& at);

    std::vector<Node> nodes_;     ///< the root is the first
    std::vector<uint32_t> leaf_;  ///< by light
};

}  // namespace reflet
