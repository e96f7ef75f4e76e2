// A checked glTF document as tinygltf's structures.
#pragma once

#include "scene/gltf/report.h"

#include <tiny_gltf.h>
#include <nlohmann/json.hpp>

#include <map>

namespace reflet {

/// Without buffers and images.
struct GltfStructure {
    tinygltf::Model model;                             ///< without materials and animations
    std::map<int, tinygltf::Material> materials;       ///< those that a mesh of the document uses, by their indices
    size_t materialCount = 0;                          ///< of the document
    std::map<size_t, tinygltf::Animation> animations;  ///< those that move something in the scene, by their indices
};

/// Empties the arrays of `document`, which passed the schema check, except for its buffers, buffer views and images: in
/// memory is one form of each element at a time. scene: index of the one that is drawn, < 0: the file's own. Throws
/// Error.
GltfStructure takeGltfStructure(nlohmann::json& document, int scene, const GltfReport& report);

}  // namespace reflet
