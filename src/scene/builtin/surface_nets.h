// Turns a field into the mesh of its zero surface: where a solid's shape is easier said as a function than as faces.
// Method: naive surface nets (S. Gibson, Constrained Elastic Surface Nets, 1998) without the relaxation.
#pragma once

#include "scene/scene.h"

#include <functional>

namespace reflet::builtin {

struct Lattice {
    vec3 origin{0.0F};
    float cell = 0.25F;  ///< metres
    glm::uvec3 cells{1U};
};

/// Negative inside the solid. The solid must not touch the lattice's border; then the mesh is closed. Normals point
/// out of the solid and come from the field's slope; no uv yet (see boxMapped).
Mesh surfaceNets(const Lattice& lattice, const std::function<float(const vec3&)>& field);

}  // namespace reflet::builtin
