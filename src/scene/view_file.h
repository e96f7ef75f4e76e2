// View files: camera, sun, lamps, environment, probes, mirrors and time as JSON, to see one scene from other places in
// other light.
#pragma once

#include "scene/scene.h"

#include <nlohmann/json_fwd.hpp>

#include <filesystem>

namespace reflet {

/// Changes what the file names in `view`; what it does not name stays.
///   { "camera": { "position": [6,1,0], "target": [0,0,0], "up": [0,1,0], "fov_y": 75, "near": 0.05 },
///        instead of "fov_y": "orthographic_height": 4, metres from the lower to the upper edge
///     "sun": { "direction": [0.4,-0.9,-0.2], "irradiance": [3.14,3.14,3.14], "angular_diameter": 0.53 },
///     "lamps": { "radius": 0.05, "off": [0, 2] },
///     "environment": { "radiance": [0,0,0] },       or { "image": "sky.hdr", "intensity": 1, "rotation": 0 }
///     "probes": [{ "position": [0,1,0], "box_min": [-2,0,-2], "box_max": [2,3,2] }],
///     "mirrors": ["looking glass"],
///     "time": 1.5 }
/// Angles in degrees, paths relative to the file. An image or a radiance replaces the whole environment, a list
/// of probes, an empty one too, all others. Throws Error:
/// a file that cannot be read, JSON that is malformed (with its line), a key that is unknown (naming the nearest), a
/// value of the wrong type, length or range.
void applyViewFile(const std::filesystem::path& path, View& view);

/// The same of JSON that was read already. path: for messages and of what it names.
void applyViewJson(const nlohmann::json& json, const std::filesystem::path& path, View& view);

/// What makes this view of any other one of the scene when a view file has it, to the last bit but for directions,
/// which are made unit length again. Of a camera or a sun that a node moves, the place is left to the node.
nlohmann::ordered_json viewJson(const View& view);

}  // namespace reflet
