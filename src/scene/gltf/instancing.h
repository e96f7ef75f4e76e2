// Reads the copies of a mesh that EXT_mesh_gpu_instancing places.
#pragma once

#include "scene/gltf/document.h"
#include "scene/scene.h"

#include <string>
#include <vector>

namespace reflet {

/// Transforms of the copies, from the mesh to the node; one identity without the extension. part: of the node. Throws
/// Error.
std::vector<glm::dmat4> readGltfCopies(const GltfDocument& document, const tinygltf::Node& node,
                                       const std::string& part, GltfReport& report);

}  // namespace reflet
