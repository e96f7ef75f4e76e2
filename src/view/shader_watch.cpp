// Watches the modification times of shader files, and compiles them with glslc.
#include "view/shader_watch.h"

#include "base/error.h"
#include "base/file.h"
#include "cli/command_line.h"
#include "gpu/shader.h"
#include "reflection/reflect_shader.h"

#include <array>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <string_view>

#include <sys/wait.h>
#include <unistd.h>

namespace reflet {

namespace {

namespace fs = std::filesystem;

bool isShader(const fs::path& file) {
    return file.extension() == ".comp" || file.extension() == ".vert" || file.extension() == ".frag";
}

bool isSource(const fs::path& file) {
    return isShader(file) || file.extension() == ".glsl" || file.extension() == ".h";
}

struct Ran {
    int status = 0;
    std::string said;
};

Ran runCommand(const std::string& command) {
    Ran ran;
    FILE* pipe = popen(command.c_str(), "r");
    if (pipe == nullptr) {
        fail("glslc cannot be started");
    }
    std::array<char, 4096> buffer{};
    while (const size_t count = std::fread(buffer.data(), 1, buffer.size(), pipe)) {
        ran.said.append(buffer.data(), count);
    }
    const int status = pclose(pipe);
    ran.status = WIFEXITED(status) ? WEXITSTATUS(status) : 1;
    return ran;
}

/// A new folder that only this user can enter: in a shared one, others could put a link where the compiler writes.
class PrivateFolder {
public:
    PrivateFolder() : path_((fs::temp_directory_path() / "reflet-shader-XXXXXX").string()) {
        if (::mkdtemp(path_.data()) == nullptr) {
            fail("{}: cannot create a folder there", fs::temp_directory_path().string());
        }
    }
    ~PrivateFolder() {
        std::error_code ignored;
        fs::remove_all(path_, ignored);
    }
    PrivateFolder(const PrivateFolder&) = delete;
    PrivateFolder& operator=(const PrivateFolder&) = delete;
    PrivateFolder(PrivateFolder&&) = delete;
    PrivateFolder& operator=(PrivateFolder&&) = delete;

    [[nodiscard]] const std::string& path() const { return path_; }

private:
    std::string path_;
};

}  // namespace

ShaderWatch::ShaderWatch(gpu::ShaderLibrary& library, const fs::path& sources) : library_(library), sources_(sources) {
    std::error_code error;
    for (const fs::directory_entry& entry : fs::recursive_directory_iterator(sources, error)) {
        if (entry.is_regular_file() && isSource(entry.path())) {
            read(entry.path().lexically_relative(sources).string());
        }
    }
}

void ShaderWatch::read(const std::string& name) {
    const fs::path path = sources_ / name;
    std::error_code error;
    const auto changed = fs::last_write_time(path, error);  // before the text: a write in between is noticed later
    const std::string text = readFile(path);
    File& file = files_[name];
    file.changed = changed;
    file.includes.clear();
    constexpr std::string_view include = "#include \"";
    for (size_t at = text.find(include); at != std::string::npos; at = text.find(include, at)) {
        at += include.size();
        file.includes.insert(text.substr(at, text.find('"', at) - at));
    }
}

// All files that include it, directly or indirectly, and the file itself.
std::set<std::string> ShaderWatch::usersOf(const std::string& name) const {
    std::set<std::string> users{name};
    for (size_t before = 0; before != users.size();) {
        before = users.size();
        for (const auto& [other, file] : files_) {
            for (const std::string& included : file.includes) {
                if (users.contains(included)) {
                    users.insert(other);
                    break;
                }
            }
        }
    }
    return users;
}

bool ShaderWatch::compile(const std::string& name) {
    const PrivateFolder folder;
    const fs::path out = fs::path(folder.path()) / "shader.spv";
    const Ran ran = runCommand(fmt::format("{} -I {} -o {} {} 2>&1", REFLET_GLSLC, shellWord(sources_.string()),
                                           shellWord(out.string()), shellWord((sources_ / name).string())));
    if (ran.status != 0) {
        problem_ = ran.said.empty() ? fmt::format("{}: glslc cannot be run", name) : ran.said;
        return false;
    }
    const std::string bytes = readFile(out);
    std::vector<uint32_t> words(bytes.size() / sizeof(uint32_t));
    std::memcpy(words.data(), bytes.data(), words.size() * sizeof(uint32_t));
    try {
        library_.replace(reflection::reflectShader(fs::path(name).filename().string(), std::move(words)));
    } catch (const Error& error) {
        problem_ = error.what();
        return false;
    }
    return true;
}

bool ShaderWatch::update(const std::function<bool()>& stop) {
    std::set<std::string> shaders;
    for (auto& [name, file] : files_) {
        std::error_code error;
        const auto changed = fs::last_write_time(sources_ / name, error);
        if (error || changed == file.changed) {
            continue;
        }
        try {
            read(name);
        } catch (const Error&) {  // an editor that saves by renaming has just removed it
            continue;
        }
        for (const std::string& user : usersOf(name)) {
            if (isShader(user)) {
                shaders.insert(user);
            }
        }
    }
    if (shaders.empty()) {
        return false;
    }
    shaders.insert(broken_.begin(), broken_.end());  // what they missed may exist now
    broken_.clear();
    problem_.clear();
    replaced_.clear();
    for (const std::string& shader : shaders) {
        if (stop()) {
            return false;
        }
        if (compile(shader)) {
            replaced_.push_back(shader);
        } else {
            broken_.insert(shader);
        }
    }
    return !replaced_.empty();
}

}  // namespace reflet
