// Tangents of MikkTSpace, which glTF asks for where a file has none: bakers of normal maps use the same, so that the
// map's details fit. After: Morten S. Mikkelsen, "Simulation of Wrinkled Surfaces Revisited", 2008.
#pragma once

#include "base/math.h"

#include <cstdint>
#include <span>
#include <vector>

namespace reflet {

struct TangentSpaceInput {
    std::span<const vec3> positions;
    std::span<const vec3> normals;  ///< unit length, one per position
    std::span<const vec2> uvs;      ///< the same
    std::span<const uint32_t> indices;
};

/// Per index: the tangent, and in w the sign of the bitangent w · cross(n, t), which is up in the image, as in glTF: v
/// grows downwards. A zero vector where the corner is in no triangle with a texture frame, and shares its vertex with
/// none.
std::vector<vec4> tangentSpaces(const TangentSpaceInput& mesh);

}  // namespace reflet
