// Emissive surfaces cut into pieces, and what they light.
#pragma once

#include "scene/bvh.h"

#include <span>
#include <vector>

namespace reflet {

/// Sums over pieces of emissive surface, each weighted by its area times the luminance of its radiance.
struct EmissiveSum {
    float area = 0.0F;  ///< of both sides, if both emit [m²]
    vec3 power{0.0F};   ///< radiance · area
    float weight = 0.0F;
    vec3 normals{0.0F};
    mat3 spread{0.0F};  ///< of n · nᵗ
    vec3 positions{0.0F};
    mat3 moments{0.0F};  ///< of x · xᵗ, of positions about `origin`
    mat3 extents{0.0F};  ///< of the covariances of the points of single pieces
    vec3 origin{0.0F};
    float reach = 0.0F;  ///< from the centre to its farthest corner [m]

    [[nodiscard]] vec3 centre() const { return positions / weight; }
    /// Mean squared distance of the pieces from the centre.
    [[nodiscard]] float variance() const;
    /// Of all points about the centre [m²].
    [[nodiscard]] mat3 covariance() const;
    /// Mean over all directions of the area that is seen [m²].
    [[nodiscard]] float meanProjectedArea() const { return 0.25F * area; }
};

/// Not of none.
EmissiveSum sumOf(std::span<const EmissiveSum> parts);

/// The pieces of an instance's triangles that are not black. finest: longest side of a piece [m], as far as their
/// number allows. triangles: of that instance.
std::vector<EmissiveSum> emissivePieces(const Scene& scene, std::span<const SceneTriangle> triangles, float finest);

/// A triangle that stands for `weight` of its kind.
struct Sampled {
    SceneTriangle triangle;
    float weight = 1.0F;
};

/// At most about `most` of the triangles: the largest, and some of the others.
std::vector<Sampled> sampled(std::vector<SceneTriangle> triangles, size_t most);

/// Most of the light from a point falls on triangles that are nearer than this [m]; 0: on nothing. Nothing is taken
/// to hide anything nearer. skip: an instance that is left out.
float litDistance(std::span<const Sampled> around, const vec3& from, uint32_t skip);

}  // namespace reflet
