// Shaders of the source tree, compiled anew when they are edited while the program runs.
#pragma once

#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <vector>

namespace reflet {

class ShaderWatch {
public:
    /// sources: the folder `src` of the source tree. Watches nothing where that is not there.
    explicit ShaderWatch(const std::filesystem::path& sources);

    [[nodiscard]] bool watches() const { return !files_.empty(); }

    /// Compiles what has changed since the last time and puts it in the place of the running shaders, but for those
    /// that do not compile. True: something has been replaced, and the caller drops its pipelines.
    bool update();

    /// Of the last compilation that failed, with file and line; empty: none has.
    [[nodiscard]] const std::string& problem() const { return problem_; }
    /// Shaders that the last update with a change has replaced.
    [[nodiscard]] const std::vector<std::string>& replaced() const { return replaced_; }

private:
    struct File {
        std::filesystem::file_time_type changed;
        std::set<std::string> includes;  ///< as written, which is from the folder on
    };

    void read(const std::string& name);
    [[nodiscard]] std::set<std::string> usersOf(const std::string& name) const;
    bool compile(const std::string& name);

    std::filesystem::path sources_;
    std::map<std::string, File> files_;  ///< by their names from the folder on
    std::set<std::string> broken_;
    std::string problem_;
    std::vector<std::string> replaced_;
};

}  // namespace reflet
