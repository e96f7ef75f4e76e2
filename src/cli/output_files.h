// Checks the files that a subcommand will write.
#pragma once

#include <string>
#include <vector>

namespace reflet {

struct SceneOptions;

struct InputFiles {
    std::vector<std::string> files;   ///< or patterns of sequences
    std::vector<std::string> scenes;  ///< with the files that they name
};

/// Fails now, not after minutes of work. Throws Error if one of the outputs cannot be written, UsageError if it would
/// replace one of the inputs or an earlier output. Empty names are left out.
void tryOutputs(const std::vector<std::string>& outputs, const InputFiles& inputs);

/// What the options of a scene name, and `more` files.
InputFiles inputFiles(const SceneOptions& options, const std::vector<std::string>& more = {});

}  // namespace reflet
