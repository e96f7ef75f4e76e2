// The viewer's memory: a file for each scene in the user's configuration folder.
#pragma once

#include "view/viewer_state.h"

#include <filesystem>

namespace reflet {

/// $XDG_CONFIG_HOME/reflet, or ~/.config/reflet.
std::filesystem::path configurationFolder();

/// The same for the same text, wherever and whenever: for names of files.
std::string fingerprintOf(const std::string& text);

/// Where the state of a scene is kept: `scene` as on the command line.
std::filesystem::path stateFile(const std::string& scene);

/// What is to come back when the scene is opened again, as it is kept in the file.
std::string stateText(const ViewerState& state);

struct Restore {
    bool view = true;      ///< camera, light and time
    bool settings = true;  ///< preset and all settings
};

/// Changes the state to what was saved of its scene, as far as that is asked for. False: nothing was. Throws Error for
/// a file that cannot be read; then the state is as it was.
bool restoreState(ViewerState& state, const Restore& what);

}  // namespace reflet
