// Layout of a mip chain in one image: levels below one another, level 1 (2x2 pixels per cell) at the top. Sizes are
// rounded up, so that with odd sizes the cells at the right and bottom edges cover fewer pixels and no pixel is left
// out. In GLSL: levels.glsl.
#pragma once

#include "base/math.h"

#include <cstdint>

namespace reflet {

/// Size of a level in cells; level 0 is the image itself.
inline uvec2 levelSize(uvec2 pixels, uint32_t level) {
    return (pixels + (1U << level) - 1U) >> level;
}

/// The first row of a level, from 1 on. A row or two between levels may be unused: this keeps it a closed formula,
/// where ray marching would otherwise have to add up heights at every step.
inline uint32_t levelRow(uvec2 pixels, uint32_t level) {
    return pixels.y - (pixels.y >> (level - 1)) + level - 1;
}

/// Image size for levels 1 to `levels` - 1. At least one texel.
inline uvec2 levelsImageSize(uvec2 pixels, uint32_t levels) {
    return glm::max(uvec2(levelSize(pixels, 1).x, levelRow(pixels, levels)), uvec2(1));
}

}  // namespace reflet
