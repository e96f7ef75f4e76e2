// The command line that renders the window's picture.
#pragma once

#include "view/workspace.h"

#include <string>

namespace reflet {

/// "cave" for "builtin:cave" and for "scenes/cave.glb".
std::string sceneStem(const std::string& scene);

/// `reflet render ...` for the state. A changed view is written to a file, which is kept. Throws Error.
std::string renderCommand(const Workspace& work);

}  // namespace reflet
