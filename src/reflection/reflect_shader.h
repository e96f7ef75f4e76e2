// Reads a shader's interface from its SPIR-V, with spirv-cross: while building, for the tables that are embedded beside
// the SPIR-V, and for shaders that were edited while the program runs. The library itself needs no reflection.
#pragma once

#include "gpu/shader.h"

#include <cstdint>
#include <string_view>
#include <vector>

namespace reflet::reflection {

/// Throws std::logic_error for words that are not SPIR-V, or have a kind of resource that Reflet does not use.
gpu::ReflectedShader reflectShader(std::string_view name, std::vector<uint32_t> words);

}  // namespace reflet::reflection
