// A glTF file as validated tinygltf structures.
#pragma once

#include "base/math.h"
#include "scene/gltf/report.h"
#include "scene/gltf/structure.h"

#include <cstdint>
#include <filesystem>
#include <vector>

namespace reflet {

/// All indices in `model` are in range, all buffer views lie in their buffers and all accessors in their views, and the
/// nodes form trees. `model.buffers` hold their bytes; `model.images` are not decoded. Buffer views and accessors that
/// are invalid, but tolerated, are empty; GltfReport::use throws their problem.
struct GltfDocument : GltfStructure {
    std::filesystem::path folder;  ///< of the file: URIs are relative to it
    std::vector<bool> isChild;     ///< per node: has a parent
};

/// Reads and checks the file; warns of unsupported extensions. scene: the one that will be drawn, < 0: the file's own.
/// Throws Error.
GltfDocument readGltfDocument(const std::filesystem::path& path, GltfReport& report, int scene = -1);

/// Cross-checks that ensure GltfDocument's invariants; the second fills isChild. Called by readGltfDocument.
void checkGltfBuffers(tinygltf::Model& model, GltfReport& report);
void checkGltfNodes(GltfDocument& document, GltfReport& report);

/// The roots of this scene, in its order. Nodes that it lists although they are below others become roots, or are left
/// out where they are drawn below another root anyway. scene: in range.
std::vector<int> rootsOfGltfScene(GltfDocument& document, size_t scene);

/// An optional vector of three numbers.
inline glm::dvec3 vectorOr(const std::vector<double>& values, const glm::dvec3& otherwise) {
    return values.size() == 3 ? glm::dvec3(values[0], values[1], values[2]) : otherwise;
}

}  // namespace reflet
