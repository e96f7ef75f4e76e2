// The files that a glTF scene is made of.
#include "scene/gltf/files.h"

#include "base/error.h"
#include "base/limits.h"
#include "scene/gltf/container.h"
#include "scene/gltf/uri.h"

#include <string>
#include <vector>

namespace reflet {

namespace {

bool isData(const std::string& uri) {
    return uri.starts_with("data:");  // is part of the document
}

}  // namespace

void visitGltfFiles(const std::filesystem::path& path, const std::function<void(std::span<const uint8_t>)>& visit) {
    GltfReport report(path.string(), {});
    visit(readFileBytes(path, memoryLimit(), "", report));
    for (const std::string& uri : readGltfUris(path, report)) {
        if (isData(uri)) {
            continue;
        }
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
        for (const std::string& uri : readGltfUris(path, report)) {
            if (isData(uri)) {
                continue;
            }
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
