// What the drawn scene of a glTF document uses.
#pragma once

#include <nlohmann/json.hpp>

#include <vector>

namespace reflet {

/// Per material: whether a mesh of the document refers to it. The document passed the schema check, here and below.
std::vector<bool> usedGltfMaterials(const nlohmann::json& document);

/// Whether the target of an animation channel has a pointer (KHR_animation_pointer).
bool hasGltfPointer(const nlohmann::json& target);

/// Per animation: whether a channel of it moves a node of the scene, or what a joint of its skins hangs from, or has a
/// pointer. scene: its index; < 0: the file's own. A file without scenes uses all its nodes.
std::vector<bool> usedGltfAnimations(const nlohmann::json& document, int scene);

}  // namespace reflet
