// Checks the files that a subcommand will write.
#include "cli/output_files.h"

#include "base/error.h"
#include "base/file.h"
#include "job/scene_options.h"
#include "job/sequence_names.h"
#include "scene/gltf/files.h"

#include <algorithm>
#include <filesystem>
#include <iterator>
#include <system_error>

namespace reflet {

namespace fs = std::filesystem;

namespace {

/// Where writing to the path writes: to what a symbolic link names, also if that does not exist yet.
fs::path writtenAt(const fs::path& path) {
    std::error_code error;
    const fs::path full = fs::absolute(path);
    return fs::weakly_canonical(fs::is_symlink(full, error) ? full.parent_path() / fs::read_symlink(full, error) : full,
                                error);
}

/// Also for files that do not exist yet.
bool areOneFile(const fs::path& a, const fs::path& b) {
    std::error_code error;
    if (fs::equivalent(a, b, error)) {
        return fs::is_regular_file(a, error);  // /dev/null may be named twice
    }
    if (fs::exists(a, error)) {
        return false;
    }
    const fs::path name = writtenAt(a);
    return !name.empty() && name == writtenAt(b);
}

/// Whether a sequence of this name has the file. Names with several runs of # are those of single files.
bool isFrameOf(const std::string& pattern, const fs::path& file) {
    const std::string name = fs::path(pattern).filename().string();
    const size_t last = name.rfind('#');
    if (last == std::string::npos || name.find_first_not_of('#', name.find('#')) < last) {
        return false;
    }
    std::error_code error;
    return FrameNames(pattern).matches(file.filename().string()) &&
           fs::equivalent(fs::absolute(pattern).parent_path(), fs::absolute(file).parent_path(), error);
}

/// With each run of # as one: sequences whose names differ in the digits alone have files in common from some frame on.
std::string withOneDigit(std::string name) {
    const auto areDigits = [](char a, char b) { return a == '#' && b == '#'; };
    name.erase(std::unique(name.begin(), name.end(), areDigits), name.end());
    return name;
}

bool collide(const std::string& a, const std::string& b) {
    return areOneFile(a, b) || isFrameOf(a, b) || isFrameOf(b, a) ||
           (FrameNames::isPattern(a) && FrameNames::isPattern(b) && areOneFile(withOneDigit(a), withOneDigit(b)));
}

/// With what scenes name, if there is something that could be replaced.
std::vector<std::string> allInputs(const InputFiles& inputs, const std::vector<std::string>& outputs) {
    const bool replacing = std::ranges::any_of(outputs, [](const std::string& file) {
        std::error_code error;
        return FrameNames::isPattern(file) || fs::exists(file, error);
    });
    std::vector<std::string> all = inputs.files;
    for (const std::string& scene : inputs.scenes) {
        all.push_back(scene);
        if (replacing) {
            std::ranges::copy(namedGltfFiles(scene), std::back_inserter(all));
        }
    }
    std::erase(all, "");
    return all;
}

}  // namespace

void tryOutputs(const std::vector<std::string>& outputs, const InputFiles& inputs) {
    const std::vector<std::string> taken = allInputs(inputs, outputs);
    for (auto output = outputs.begin(); output != outputs.end(); ++output) {
        if (output->empty()) {
            continue;
        }
        const AtomicFile trial(*output);
        const auto isOutput = [&](const std::string& file) { return !file.empty() && collide(*output, file); };
        if (const auto input = std::ranges::find_if(taken, isOutput); input != taken.end()) {
            const std::string which = *input == *output ? "" : fmt::format(", {}", *input);
            failUsage("{}: would replace an input of this command{}: choose another name", *output, which);
        }
        if (std::any_of(outputs.begin(), output, isOutput)) {
            failUsage("{}: two outputs have this name: choose another for one of them", *output);
        }
    }
}

InputFiles inputFiles(const SceneOptions& options, const std::vector<std::string>& more) {
    InputFiles inputs{options.settingsFiles, {options.scene}};
    inputs.files.insert(inputs.files.end(), more.begin(), more.end());
    inputs.files.insert(inputs.files.end(), {options.viewFile, options.environment});
    return inputs;
}

}  // namespace reflet
