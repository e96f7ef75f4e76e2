// Reads a .gltf or .glb file into its JSON document and its binary chunk.
#pragma once

#include "scene/gltf/report.h"

#include <cstdint>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

namespace reflet {

struct GltfContainer {
    nlohmann::json document;                  ///< any JSON value, nested at most 128 deep
    std::optional<std::vector<uint8_t>> bin;  ///< the binary chunk of a .glb that has one
};

/// A .glb is recognized by its first bytes, not by its name. Throws Error.
GltfContainer readGltfContainer(const std::filesystem::path& path, GltfReport& report);

/// The URIs of its buffers and images, without keeping anything else of the document. Throws Error.
std::vector<std::string> readGltfUris(const std::filesystem::path& path, GltfReport& report);

/// The first `maxBytes` bytes of a regular file, or all of it if shorter. `within`: if not empty, a folder that `path`
/// lies in, both without symbolic links; none that appears meanwhile is followed. Throws Error that names `part`.
std::vector<uint8_t> readFileBytes(const std::filesystem::path& path, uint64_t maxBytes, std::string_view part,
                                   const GltfReport& report, const std::filesystem::path& within = {});

}  // namespace reflet
