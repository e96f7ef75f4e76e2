// View files: camera, sun, lamps, environment, background, probes, mirrors and time as JSON, to render a scene from
// another view or in other light.
#pragma once

#include "scene/scene.h"

#include <nlohmann/json_fwd.hpp>

#include <filesystem>

namespace reflet {

/// Applies the file to `view`; what the file does not mention is unchanged.
///   { "camera": { "position": [6,1,0], "target": [0,0,0], "up": [0,1,0], "fov_y": 75, "near": 0.05 },
///        instead of "fov_y": "orthographic_height": 4, metres from the lower to the upper edge
///        and a lens: "aperture_radius": 0.02 or "f_number": 2.8, "sensor_height": 24, "focus_distance": 3 or "focus":
///        a node's name or a point, "blades": 6, "blade_rotation": 10
///     "sun": { "direction": [0.4,-0.9,-0.2], "irradiance": [3.14,3.14,3.14], "angular_diameter": 0.53 },
///     "lamps": { "radius": 0.05, "off": [0, 2] },
///     "environment": { "radiance": [0,0,0] },       or { "image": "sky.hdr", "intensity": 1, "rotation": 0 }
///        or "sky", "studio", "none" or a file's name, as --environment; "sky" and "studio" can be the image, too
///     "background": "blur",                         as --background, or three display values
///     "probes": [{ "position": [0,1,0], "box_min": [-2,0,-2], "box_max": [2,3,2] }],
///     "mirrors": ["looking glass"],
///     "time": 1.5 }
/// Angles are in degrees, paths relative to the file. An image or a radiance replaces the whole environment; a list of
/// probes, even an empty one, replaces all others. Throws Error for an unreadable file, malformed JSON (with its line),
/// an unknown key (naming the nearest), or a value of the wrong type, length or range.
void applyViewFile(const std::filesystem::path& path, View& view);

/// The same for parsed JSON. path: for messages, and the base of relative paths.
void applyViewJson(const nlohmann::json& json, const std::filesystem::path& path, View& view);

/// A view file that turns any view of the scene into this one, exactly except for directions, which are normalized
/// again.
/// The placement of a camera or a sun that a node moves is left to the node.
nlohmann::ordered_json viewJson(const View& view);

}  // namespace reflet
