// The files that a glTF scene is made of.
#include "scene/gltf/files.h"

#include "base/error.h"
#include "base/limits.h"
#include "scene/gltf/container.h"
#include "scene/gltf/uri.h"

#include <nlohmann/json.hpp>

#include <string>
#include <vector>

namespace reflet {

namespace {

/// URIs of files; data URIs are part of the document.
std::vector<std::string> namedUris(const nlohmann::json& document) {
    std::vector<std::string> uris;
    for (const char* key : {"buffers", "images"}) {
        const auto list = document.is_object() ? document.find(key) : document.end();
        if (list == document.end() || !list->is_array()) {
            continue;
        }
        for (const nlohmann::json& entry : *list) {
            const auto uri = entry.is_object() ? entry.find("uri") : entry.end();
            if (uri != entry.end() && uri->is_string() && !uri->get_ref<const std::string&>().starts_with("data:")) {
                uris.push_back(uri->get<std::string>());
            }
        }
    }
    return uris;
}

}  // namespace

void visitGltfFiles(const std::filesystem::path& path, const std::function<void(std::span<const uint8_t>)>& visit) {
    GltfReport report(path.string(), {});
    visit(readFileBytes(path, memoryLimit(), "", report));
    const GltfContainer container = readGltfContainer(path, report);
    for (const std::string& uri : namedUris(container.document)) {
        try {
            visit(readUri(uri, path.parent_path(), memoryLimit(), "uri", report));
        } catch (const GltfProblem& problem) {
            const std::string& text = problem.detail.text;
            visit({reinterpret_cast<const uint8_t*>(text.data()), text.size()});
        }
    }
}

std::vector<std::filesystem::path> namedGltfFiles(const std::filesystem::path& path) {
    std::vector<std::filesystem::path> files;
    try {
        GltfReport report(path.string(), {});
        for (const std::string& uri : namedUris(readGltfContainer(path, report).document)) {
            try {
                files.push_back(uriFile(uri, path.parent_path(), "uri", report).path);
            } catch (const GltfProblem&) {  // such a file is never read
                continue;
            }
        }
    } catch (const Error&) {
        return files;
    }
    return files;
}

}  // namespace reflet
