// Decodes primitives compressed with KHR_draco_mesh_compression.
#pragma once

#include "scene/gltf/accessor.h"

#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace reflet {

/// A decoded primitive. The views look into `values`.
struct DracoPrimitive {
    std::vector<uint32_t> indices;  ///< three per triangle, less than `vertices`
    uint32_t vertices = 0;
    std::map<std::string, AccessorView> attributes;
    std::map<std::string, std::vector<vec4>> values;
};

/// `part` is the JSON path of the primitive, which has the extension. Throws Error.
DracoPrimitive decodeDraco(const GltfDocument& document, const tinygltf::Primitive& primitive, const std::string& part,
                           GltfReport& report);

}  // namespace reflet
