// Which animations of a glTF file play.
#pragma once

#include "scene/gltf/document.h"
#include "scene/scene.h"

#include <string>
#include <vector>

namespace reflet {

/// Removes the animations of the document that do not play; wanted: GltfOptions::animation. Returns all that there are.
/// Throws UsageError if there is none of that name or number.
std::vector<AnimationClip> chooseGltfAnimations(GltfDocument& document, const std::string& wanted, GltfReport& report);

}  // namespace reflet
