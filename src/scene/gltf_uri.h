// Reads what a URI of a glTF file refers to: a data URI, or a file in the scene's own folder and nowhere else.
#pragma once

#include "scene/gltf_report.h"

#include <cstdint>
#include <filesystem>
#include <vector>

namespace reflet {

/// "%41" becomes "A"; what is no escape stays as it is.
std::string percentDecoded(std::string_view uri);

/// At most `maxBytes` bytes of what the URI refers to. Throws Error in the name of `part` where the URI is absolute,
/// has a scheme other than data, leads out of `folder` (also through a symbolic link), or cannot be read.
std::vector<uint8_t> readUri(const std::string& uri, const std::filesystem::path& folder, uint64_t maxBytes,
                             std::string_view part, const GltfReport& report);

}  // namespace reflet
