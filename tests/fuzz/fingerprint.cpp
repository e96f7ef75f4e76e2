// The files that a scene names, as the fingerprint of a sequence and the loader read them. Input that does not start as
// JSON is a list of URIs, one a line. Outside of the scene's folder lies a file that nobody may open.
#include "fuzz.h"
#include "scene/gltf/files.h"
#include "scene/gltf/gltf.h"

#include <sys/inotify.h>

#include <array>
#include <nlohmann/json.hpp>
#include <span>

namespace {

using namespace reflet;
namespace fs = std::filesystem;

/// OUTSIDE/secret, OUTSIDE/scene/ with the scene, a file that it may name, and links that lead out.
class Folders {
public:
    Folders() : outside_(fuzz::folder() / "outside"), inside_(outside_ / "scene") {
        fs::create_directories(inside_ / "in");
        fuzz::writeBytes(outside_ / "secret", "secret", 6);
        fuzz::writeBytes(inside_ / "texels", "texels", 6);
        fs::create_symlink("../secret", inside_ / "link");
        fs::create_symlink("../../scene", inside_ / "in/up");
        fs::create_symlink("..", inside_ / "parent");
        events_ = ::inotify_init1(IN_NONBLOCK | IN_CLOEXEC);
        if (events_ < 0 || ::inotify_add_watch(events_, outside_.c_str(), IN_OPEN) < 0) {
            fuzz::finding("no inotify");
        }
    }

    [[nodiscard]] fs::path scene() const { return inside_ / "scene.gltf"; }
    [[nodiscard]] fs::path secret() const { return outside_ / "secret"; }

    /// Whether a file outside of the scene's folder has been opened since the last call.
    [[nodiscard]] bool leaked() const {
        alignas(inotify_event) std::array<char, 4096> buffer{};
        return ::read(events_, buffer.data(), buffer.size()) > 0;
    }

private:
    fs::path outside_;
    fs::path inside_;
    int events_ = -1;
};

/// A document with these URIs as images, and as buffers, which the loader reads whether they are used or not.
std::string documentOfUris(std::string_view lines) {
    nlohmann::json document{{"asset", {{"version", "2.0"}}}, {"buffers", nlohmann::json::array()}};
    document["images"] = nlohmann::json::array();
    while (!lines.empty()) {
        const size_t end = std::min(lines.find('\n'), lines.size());
        document["images"].push_back({{"uri", lines.substr(0, end)}});
        document["buffers"].push_back({{"uri", lines.substr(0, end)}, {"byteLength", 4}});
        lines.remove_prefix(std::min(end + 1, lines.size()));
    }
    return document.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

}  // namespace

FUZZ_TARGET(fingerprint) {
    static const Folders folders;
    const std::string_view input(reinterpret_cast<const char*>(bytes), size);
    const std::string text = input.starts_with('{') ? std::string(input) : documentOfUris(input);
    writeBytes(folders.scene(), text.data(), text.size());
    survive([&] { visitGltfFiles(folders.scene(), [](std::span<const uint8_t>) {}); });
    survive([&] { (void)loadGltf(folders.scene()); });
    if (folders.leaked()) {
        finding("a file outside of the scene's folder was opened");
    }
    return 0;
}
