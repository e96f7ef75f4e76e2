// Levels of ever larger squares of pixels that lie in one image, below one another, level 1 (2x2 pixels a cell) at the
// top. Sizes are rounded up, so that cells at the right and lower edges of odd sizes stand for fewer pixels and no
// pixel is left out. In GLSL: levels.glsl.
#pragma once

#include "base/math.h"

#include <cstdint>

namespace reflet {

/// Cells of a level; level 0: the pixels themselves.
inline uvec2 levelSize(uvec2 pixels, uint32_t level) {
    return (pixels + (1U << level) - 1U) >> level;
}

/// The first row of a level, from 1 on. A row or two between levels may be left over: that way there is a formula for
/// it, where rays that march through levels would have to add up heights at every step.
inline uint32_t levelRow(uvec2 pixels, uint32_t level) {
    return pixels.y - (pixels.y >> (level - 1)) + level - 1;
}

/// What the levels from 1 to below `levels` need. At least one texel.
inline uvec2 levelsImageSize(uvec2 pixels, uint32_t levels) {
    return glm::max(uvec2(levelSize(pixels, 1).x, levelRow(pixels, levels)), uvec2(1));
}

}  // namespace reflet
