// Reads the target of a URI in a glTF file: a data URI, or a file inside the scene's folder.
#pragma once

#include "scene/gltf/report.h"

#include <cstdint>
#include <filesystem>
#include <vector>

namespace reflet {

/// "%41" becomes "A"; invalid escapes are kept.
std::string percentDecoded(std::string_view uri);

/// Absolute paths without symbolic links.
struct UriFile {
    std::filesystem::path folder;
    std::filesystem::path path;  ///< in the folder; the file may not exist
};

/// The file that a URI names; not a data URI. Throws Error as readUri.
UriFile uriFile(const std::string& uri, const std::filesystem::path& folder, std::string_view part,
                const GltfReport& report);

/// The bytes of the URI's target; of a file, at most `maxBytes`. Throws Error that names `part` if the URI is absolute,
/// has a scheme other than data, leads out of `folder` (also by a symbolic link), or cannot be read.
std::vector<uint8_t> readUri(const std::string& uri, const std::filesystem::path& folder, uint64_t maxBytes,
                             std::string_view part, const GltfReport& report);

}  // namespace reflet
