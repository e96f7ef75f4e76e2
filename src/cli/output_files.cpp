// Checks the files that a subcommand will write.
#include "cli/output_files.h"

#include "base/error.h"
#include "base/file.h"
#include "capture/scene_options.h"

#include <algorithm>
#include <filesystem>
#include <system_error>

namespace reflet {

namespace fs = std::filesystem;

namespace {

/// Also for files that do not exist yet, and for patterns of sequences.
bool areOneFile(const fs::path& a, const fs::path& b) {
    std::error_code error;
    if (fs::equivalent(a, b, error)) {
        return fs::is_regular_file(a, error);  // /dev/null may be named twice
    }
    const fs::path name = fs::weakly_canonical(fs::absolute(a), error);
    return !error && !fs::exists(a, error) && name == fs::weakly_canonical(fs::absolute(b), error);
}

}  // namespace

void tryOutputs(const std::vector<std::string>& outputs, const std::vector<std::string>& inputs) {
    for (auto output = outputs.begin(); output != outputs.end(); ++output) {
        if (output->empty()) {
            continue;
        }
        const AtomicFile trial(*output);
        const auto isOutput = [&](const std::string& file) { return !file.empty() && areOneFile(*output, file); };
        if (std::ranges::any_of(inputs, isOutput)) {
            failUsage("{}: would replace an input of this command: choose another name", *output);
        }
        if (std::any_of(outputs.begin(), output, isOutput)) {
            failUsage("{}: two outputs have this name: choose another for one of them", *output);
        }
    }
}

std::vector<std::string> inputFiles(const SceneOptions& options, const std::vector<std::string>& more) {
    std::vector<std::string> files = options.settingsFiles;
    files.insert(files.end(), more.begin(), more.end());
    files.insert(files.end(), {options.scene, options.viewFile, options.environment});
    return files;
}

}  // namespace reflet
