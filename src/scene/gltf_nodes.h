// Places the nodes of a glTF scene: instances, cameras, lamps, the sun.
#pragma once

#include "scene/gltf_mesh.h"

#include <vector>

namespace reflet {

/// Walks the trees below `roots`, parents first and children in their order. Throws Error.
void placeGltfNodes(const GltfDocument& document, const std::vector<int>& roots, GltfMeshes& meshes, Scene& scene,
                    GltfReport& report);

}  // namespace reflet
