// Gives access to the attributes and triangles of a glTF primitive, whether from accessors or from Draco.
#pragma once

#include "scene/gltf/draco.h"

#include <map>
#include <string>
#include <vector>

namespace reflet {

/// A primitive before its vertices are read. POSITION exists, and all attributes have as many elements and a type that
/// their semantic allows.
struct PrimitiveSource {
    std::map<std::string, AccessorView> attributes;
    std::vector<uint32_t> triangles;  ///< `corners` vertex indices each, in range
    size_t corners = 3;               ///< 1: points, 2: segments of lines
    DracoPrimitive draco;             ///< owns the data that attributes view

    [[nodiscard]] const AccessorView* find(const std::string& semantic) const {
        const auto found = attributes.find(semantic);
        return found != attributes.end() ? &found->second : nullptr;
    }
};

/// `part` is the JSON path of the primitive, which must have a POSITION. Throws Error.
PrimitiveSource openPrimitive(const GltfDocument& document, const tinygltf::Primitive& primitive,
                              const std::string& part, GltfReport& report);

}  // namespace reflet
