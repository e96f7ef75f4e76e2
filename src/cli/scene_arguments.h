// Options shared by the subcommands that take a scene.
#pragma once

#include "capture/scene_options.h"

namespace CLI {
class App;
}  // namespace CLI

namespace reflet {

/// Adds SCENE and the options to a subcommand.
void addSceneOptions(CLI::App& command, SceneOptions& options);
/// Adds the options other than SCENE, --preset and --variant, for a subcommand that takes several of these.
void addViewOptions(CLI::App& command, SceneOptions& options);

}  // namespace reflet
