// Hot reload: recompiles shaders of the source tree when they are edited while the program runs.
#pragma once

#include "gpu/shader.h"

#include <filesystem>
#include <functional>
#include <map>
#include <set>
#include <string>
#include <vector>

namespace reflet {

class ShaderWatch {
public:
    /// sources: the folder `src` of the source tree. Watches nothing if it does not exist.
    /// library: its shaders are replaced; must outlive the watch.
    ShaderWatch(gpu::ShaderLibrary& library, const std::filesystem::path& sources);

    [[nodiscard]] bool watches() const { return !files_.empty(); }

    /// Recompiles shaders changed since the last call and replaces the running ones, except those that do not compile.
    /// Returns whether any was replaced; then the caller must drop its pipelines. stop: polled before each shader.
    bool update(const std::function<bool()>& stop);

    /// Error of the last failed compilation, with file and line; empty: none.
    [[nodiscard]] const std::string& problem() const { return problem_; }
    /// Shaders replaced by the last update that replaced any.
    [[nodiscard]] const std::vector<std::string>& replaced() const { return replaced_; }

private:
    struct File {
        std::filesystem::file_time_type changed;
        std::set<std::string> includes;  ///< as written: relative to the folder
    };

    void read(const std::string& name);
    [[nodiscard]] std::set<std::string> usersOf(const std::string& name) const;
    bool compile(const std::string& name);

    gpu::ShaderLibrary& library_;
    std::filesystem::path sources_;
    std::map<std::string, File> files_;  ///< by their names relative to the folder
    std::set<std::string> broken_;
    std::string problem_;
    std::vector<std::string> replaced_;
};

}  // namespace reflet
