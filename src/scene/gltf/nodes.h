// Places instances, cameras, lamps and the sun by the nodes of a glTF scene.
#pragma once

#include "scene/gltf/mesh.h"
#include "scene/gltf/properties.h"

#include <vector>

namespace reflet {

/// Traverses the trees below `roots`, parents first and children in order. Throws Error.
GltfPlacement placeGltfNodes(const GltfDocument& document, const std::vector<int>& roots, GltfMeshes& meshes,
                             Scene& scene, GltfReport& report);

}  // namespace reflet
