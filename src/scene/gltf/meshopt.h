// Decodes buffer views compressed with EXT_meshopt_compression.
#pragma once

#include "scene/gltf/report.h"

#include <tiny_gltf.h>
#include <nlohmann/json.hpp>

namespace reflet {

/// Whether the buffer holds only what compressed buffer views decode to, and need not be read.
bool isMeshoptFallback(const nlohmann::json& buffer);

/// Decodes each compressed buffer view into a buffer of its own, to which the view refers afterwards. `document` passed
/// the schema check, and `model` has its buffers. Throws Error.
void decodeMeshopt(const nlohmann::json& document, tinygltf::Model& model, GltfReport& report);

}  // namespace reflet
