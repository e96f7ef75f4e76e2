// JSON pointers of KHR_animation_pointer, as the glTF 2.0 Asset Object Model has them.
#pragma once

#include "scene/animation.h"

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace reflet {

/// A property that Reflet animates.
struct GltfPointer {
    enum class Of : uint8_t { node, mesh, material, camera, light };

    Of of = Of::node;
    size_t index = 0;      ///< of the node, mesh, …; may be out of range
    std::string nodePath;  ///< of nodes and meshes: the path of a target without the extension; empty: `property`
    Property property = Property::visible;
    uint32_t texture = 0;  ///< of texture transforms: index into materialTextures
    int components = 1;    ///< of `property`
};

/// nullopt if it names no such property. The array that it indexes is named by `arrayOf`.
std::optional<GltfPointer> parseGltfPointer(std::string_view pointer);

std::string_view arrayOf(GltfPointer::Of of);

}  // namespace reflet
