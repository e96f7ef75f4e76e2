// Light for scenes that bring none or too little, and environments by name.
#pragma once

#include "scene/scene.h"

#include <filesystem>
#include <optional>
#include <string>

namespace reflet {

/// A made environment with what its names in view files and on the command line leave open.
struct EnvironmentChoice {
    std::string name;            ///< "sky", "studio", "none", or an .hdr or .exr file
    std::filesystem::path base;  ///< folder of relative file names
    bool keepsSun = false;       ///< the sun was stated, even if it is dark
};

/// Whether the name is "sky" or "studio".
bool isMadeEnvironment(const std::string& name);

/// Replaces the environment.
/// sky: turned toward the view's sun and as bright as fits it; where there is none, the sky's own sun is added.
/// studio: turned so that its key light is behind the camera's left shoulder. none: black.
/// The default sun goes, but for sky, which changes it, and for none. For sky and studio the background becomes their
/// blur, unless it was something else than the environment before. Throws Error for a file that cannot be read.
void chooseEnvironment(View& view, const EnvironmentChoice& choice);

/// Adds light to the default view of a scene without an environment of its own:
/// no light at all, a clear sky with its sun; a sun only or a sun and lamps, a sky that fits it; lamps only, or a sun
/// from below, a dim studio, 4 stops below the estimated irradiance of the lamps. Returns what was added, for a
/// message; nullopt: nothing.
std::optional<std::string> addDefaultLight(const Scene& scene, View& view);

}  // namespace reflet
