// Mutates glTF files so that most results are still JSON with right lengths, and many still load: random bytes rarely
// get past the parser.
#pragma once

#include <cstddef>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <optional>
#include <random>
#include <string>
#include <string_view>

namespace reflet::fuzz {

struct GltfParts {
    nlohmann::json document;
    std::string bin;
    bool glb = false;
};

/// The document and the binary chunk of a .gltf or .glb file; nothing if it is neither.
std::optional<GltfParts> gltfParts(std::string_view file);

/// The file of these parts, with right lengths.
std::string gltfFile(const GltfParts& parts);

/// Changes a number, a text or an index, or deletes, duplicates, swaps, copies or retypes values.
void mutateDocument(nlohmann::json& document, std::mt19937& random);

}  // namespace reflet::fuzz
