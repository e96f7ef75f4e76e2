// Reflects a shader's interface from its SPIR-V, with spirv-cross: at build time, for the tables that are embedded
// beside the SPIR-V, and at run time for edited shaders (hot reload). The library itself needs no reflection.
#pragma once

#include "gpu/shader.h"

#include <cstdint>
#include <string_view>
#include <vector>

namespace reflet::reflection {

/// Throws std::logic_error if the words are not SPIR-V, or use a kind of resource that Reflet does not support.
gpu::ReflectedShader reflectShader(std::string_view name, std::vector<uint32_t> words);

}  // namespace reflet::reflection
