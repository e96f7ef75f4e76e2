// Where the vertices and triangles of a glTF primitive come from: accessors or Draco.
#pragma once

#include "scene/gltf_draco.h"

#include <map>
#include <string>
#include <vector>

namespace reflet {

/// A primitive before its vertices are read. All attributes have as many elements as POSITION, which is there, and are
/// of a type that their semantic allows.
struct PrimitiveSource {
    std::map<std::string, AccessorView> attributes;
    std::vector<uint32_t> triangles;  ///< three vertices each, all less than the number of vertices
    DracoPrimitive draco;             ///< keeps what attributes look into

    [[nodiscard]] const AccessorView* find(const std::string& semantic) const {
        const auto found = attributes.find(semantic);
        return found != attributes.end() ? &found->second : nullptr;
    }
};

/// `part` is the JSON path of the primitive, which draws triangles and has a POSITION. Throws Error.
PrimitiveSource openPrimitive(const GltfDocument& document, const tinygltf::Primitive& primitive,
                              const std::string& part, GltfReport& report);

}  // namespace reflet
