// Meshes the zero isosurface of a scalar field by naive surface nets (S. Gibson, Constrained Elastic Surface Nets,
// 1998) without the relaxation.
#pragma once

#include "scene/scene.h"

#include <functional>

namespace reflet::builtin {

struct Lattice {
    vec3 origin{0.0F};
    float cell = 0.25F;  ///< metres
    glm::uvec3 cells{1U};
};

/// field: negative inside the solid. If the solid does not touch the lattice's border, the mesh is closed. Normals
/// point outwards, along the field's gradient; uvs are not set (see boxMapped).
Mesh surfaceNets(const Lattice& lattice, const std::function<float(const vec3&)>& field);

}  // namespace reflet::builtin
