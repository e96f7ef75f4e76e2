// Scenes for tests that together have every property that the loader reads.
#pragma once

#include "gltf_builder.h"

#include <string>
#include <utility>
#include <vector>

namespace reflet::test {

/// Squares side by side, each with a material of its own: all properties of materials, textures and samplers.
GltfBuilder layered();

/// Cameras with lenses, lamps of all types, variants, a hidden node, weights of a mesh and of a node, interpolations
/// and animation pointers.
GltfBuilder staged();

/// By name: everything(), slider(), bent(), morphing(), compressed() by both extensions, layered() and staged().
std::vector<std::pair<std::string, GltfBuilder>> showcase();

}  // namespace reflet::test
