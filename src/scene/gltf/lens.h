// Lenses of glTF cameras: Reflet's own `extras`, with the keys of view files.
#pragma once

#include "scene/gltf/document.h"
#include "scene/gltf/report.h"
#include "scene/scene.h"

#include <string>

namespace reflet {

/// `part`: the camera. `camera`: with its projection. Throws GltfProblem, and leaves the camera as it was, for keys
/// that contradict each other.
void readGltfLens(const tinygltf::Value& extras, const std::string& part, Camera& camera, const GltfReport& report);

/// Makes cameras that focus on nodes that are not there focus automatically, with a warning.
void checkGltfFocus(Scene& scene, GltfReport& report);

}  // namespace reflet
