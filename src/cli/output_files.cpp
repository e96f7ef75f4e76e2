// Checks the files that a subcommand will write.
#include "cli/output_files.h"

#include "base/error.h"
#include "base/file.h"
#include "capture/scene_options.h"
#include "capture/sequence_names.h"
#include "scene/gltf/files.h"

#include <algorithm>
#include <filesystem>
#include <iterator>
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

/// The file itself and, of a pattern, the frames that exist.
std::vector<fs::path> withFrames(const std::string& file) {
    std::vector<fs::path> files{file};
    if (std::error_code error;
        FrameNames::isPattern(file) && fs::is_directory(fs::absolute(file).parent_path(), error)) {
        std::ranges::copy(FrameNames(file).existing(), std::back_inserter(files));
    }
    return files;
}

/// What patterns of sequences name is added, and what scenes name if there is something that could be replaced.
std::vector<fs::path> allInputs(const Inputs& inputs, const std::vector<std::string>& outputs) {
    const bool replacing = std::ranges::any_of(outputs, [](const std::string& file) {
        std::error_code error;
        return FrameNames::isPattern(file) || fs::exists(file, error);
    });
    std::vector<fs::path> all;
    for (const std::string& file : inputs.files) {
        std::ranges::copy(withFrames(file), std::back_inserter(all));
    }
    for (const std::string& scene : inputs.scenes) {
        all.emplace_back(scene);
        if (replacing) {
            std::ranges::copy(namedGltfFiles(scene), std::back_inserter(all));
        }
    }
    return all;
}

}  // namespace

void tryOutputs(const std::vector<std::string>& outputs, const Inputs& inputs) {
    std::vector<fs::path> taken = allInputs(inputs, outputs);
    std::erase_if(taken, [](const fs::path& file) { return file.empty(); });
    const size_t inputCount = taken.size();
    for (const std::string& output : outputs) {
        if (output.empty()) {
            continue;
        }
        const AtomicFile trial(output);
        for (const fs::path& file : withFrames(output)) {
            const auto same =
                std::ranges::find_if(taken, [&](const fs::path& other) { return areOneFile(file, other); });
            if (same == taken.end()) {
                continue;
            }
            if (static_cast<size_t>(same - taken.begin()) >= inputCount) {
                failUsage("{}: two outputs have this name: choose another for one of them", output);
            }
            const std::string input = *same == output ? "" : fmt::format(", {}", same->string());
            failUsage("{}: would replace an input of this command{}: choose another name", output, input);
        }
        taken.emplace_back(output);
    }
}

Inputs inputFiles(const SceneOptions& options, const std::vector<std::string>& more) {
    Inputs inputs{options.settingsFiles, {options.scene}};
    inputs.files.insert(inputs.files.end(), more.begin(), more.end());
    inputs.files.insert(inputs.files.end(), {options.viewFile, options.environment});
    return inputs;
}

}  // namespace reflet
