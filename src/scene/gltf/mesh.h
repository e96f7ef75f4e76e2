// Converts primitives of a glTF file to meshes.
#pragma once

#include "scene/gltf/material.h"

#include <cstdint>
#include <vector>

namespace reflet {

class GltfMeshes {
public:
    /// The references must outlive this object. variant: index of the material variant; < 0: none.
    GltfMeshes(const GltfDocument& document, GltfMaterials& materials, Scene& scene, GltfReport& report, int variant)
        : document_(document),
          materials_(materials),
          scene_(scene),
          report_(report),
          variant_(variant),
          meshes_(document.model.meshes.size()),
          loaded_(document.model.meshes.size(), false) {}

    /// Indices into Scene::meshes, one per primitive of the file's mesh that draws triangles. Throws Error.
    const std::vector<uint32_t>& use(int mesh);

private:
    void loadPrimitive(size_t mesh, size_t primitive);

    const GltfDocument& document_;
    GltfMaterials& materials_;
    Scene& scene_;
    GltfReport& report_;
    int variant_;
    std::vector<std::vector<uint32_t>> meshes_;
    std::vector<bool> loaded_;
};

}  // namespace reflet
