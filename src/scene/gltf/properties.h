// Connects the animated properties of a glTF file with what they change in the scene.
#pragma once

#include "scene/gltf/material.h"
#include "scene/gltf/pointer.h"

#include <map>
#include <vector>

namespace reflet {

/// A property channel whose targets are not known until the file's materials, cameras and lights are in the scene.
struct GltfOpenProperty {
    size_t animation = 0;  ///< index into Scene::animations
    size_t property = 0;   ///< index into its properties
    GltfPointer::Of of = GltfPointer::Of::material;
    size_t index = 0;  ///< in the file
};

/// What placing the nodes leaves to be done for animations.
struct GltfPlacement {
    std::vector<GltfOpenProperty> open;
    std::multimap<int, int32_t> cameras;  ///< from the file's index to the scene's nodes that have it
    std::multimap<int, int32_t> lights;
};

/// Gives the channels their targets, drops those of what the scene does not have, and gives what is animated its
/// largest values (applyLargestProperties). Throws Error.
void bindGltfProperties(const GltfDocument& document, const GltfMaterials& materials, const GltfPlacement& placement,
                        Scene& scene, GltfReport& report);

}  // namespace reflet
