// Options shared by the subcommands that take a scene.
#pragma once

#include "cli/output_files.h"
#include "job/scene_options.h"

#include <string>
#include <string_view>
#include <vector>

namespace CLI {
class App;
}  // namespace CLI

namespace reflet {

/// Adds SCENE and the options to a subcommand.
void addSceneOptions(CLI::App& command, SceneOptions& options);
/// Adds the options other than SCENE, --preset and --variant, for a subcommand that takes several of these.
void addViewOptions(CLI::App& command, SceneOptions& options);

/// Throws UsageError unless there are names and all end in .exr or .png; then as tryOutputs. command: for its help.
void checkOutputs(const std::vector<std::string>& outputs, const InputFiles& inputs, std::string_view command);

}  // namespace reflet
