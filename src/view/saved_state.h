// Saves the viewer's state: a file for each scene in the user's configuration folder.
#pragma once

#include "view/viewer_state.h"

#include <filesystem>

namespace reflet {

/// $XDG_CONFIG_HOME/reflet, or .config/reflet in the home folder. Throws Error if there is no home folder.
std::filesystem::path configurationFolder();

/// A hash of the text that is stable across runs and machines, for file names.
std::string fingerprintOf(const std::string& text);

/// The file with the state of a scene: `scene` as on the command line. /dev/null, with one warning, if there is no home
/// folder.
std::filesystem::path stateFile(const std::string& scene);

/// The content of that file: everything that is restored when the scene is opened again.
std::string stateText(const ViewerState& state);

struct Restore {
    bool view = true;      ///< camera, light and time
    bool settings = true;  ///< preset and all settings
};

/// Restores the selected parts of the saved state of the state's scene. Returns false if nothing was saved. Throws
/// Error for a file that cannot be read; the state is unchanged then.
bool restoreState(ViewerState& state, const Restore& what);

}  // namespace reflet
