// Cameras in view files, keyframes of camera paths and `extras` of glTF cameras.
#pragma once

#include "base/json.h"
#include "scene/camera.h"

#include <nlohmann/json_fwd.hpp>

#include <string>
#include <vector>

namespace reflet {

/// All keys that a view file's camera (or a keyframe) may have.
std::vector<std::string> cameraKeys(bool keyframe);

/// Sets the fields whose keys the node has; ignores other keys. Does not touch the camera's node.
void readCameraFields(const JsonNode& node, Camera& camera);

/// Of those, only the lens.
void readLens(const JsonNode& node, Camera& camera);

/// What readCameraFields turns into the same camera: without the placement if a node moves it.
nlohmann::ordered_json cameraJson(const Camera& camera);

/// All values of a camera, in the units of view files; those of the lens only if it has an aperture.
nlohmann::ordered_json cameraRecord(const Camera& camera);

}  // namespace reflet
