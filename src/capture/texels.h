// Decodes read-back images of the frame's formats to floats.
#pragma once

#include "base/math.h"
#include "gpu/resource.h"

#include <cstddef>
#include <span>
#include <vector>

namespace reflet {

/// One vec4 per texel; channels that the format lacks are 0 (alpha 1). R32_UINT is a packed unit vector (x, y, z).
std::vector<vec4> decodeTexels(VkFormat format, std::span<const std::byte> bytes);

}  // namespace reflet
