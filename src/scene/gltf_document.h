// A glTF file as tinygltf's structures, with everything in them checked.
#pragma once

#include "base/math.h"
#include "scene/gltf_report.h"

#include <tiny_gltf.h>
#include <cstdint>
#include <filesystem>
#include <vector>

namespace reflet {

/// Every index in `model` is one that exists, every buffer view lies in its buffer and every accessor in its view, and
/// no node has two parents or is its own ancestor. `model.buffers` hold their bytes; `model.images` are not decoded.
struct GltfDocument {
    std::filesystem::path folder;  ///< of the file: URIs are relative to it
    tinygltf::Model model;
    std::vector<bool> isChild;  ///< per node: has a parent
};

/// Reads and checks the file; warns of extensions that are used but not known. Throws Error.
GltfDocument readGltfDocument(const std::filesystem::path& path, GltfReport& report);

/// Checks what takes more than one value to check (see GltfDocument), and fills isChild. Part of readGltfDocument.
void checkGltfBuffers(const tinygltf::Model& model, const GltfReport& report);
void checkGltfNodes(GltfDocument& document, const GltfReport& report);

/// A node's or an extension's three numbers, which the file may leave out.
inline glm::dvec3 vectorOr(const std::vector<double>& values, const glm::dvec3& otherwise) {
    return values.size() == 3 ? glm::dvec3(values[0], values[1], values[2]) : otherwise;
}

}  // namespace reflet
