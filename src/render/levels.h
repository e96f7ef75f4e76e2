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

/// What the levels from 1 to below `levels` need. At least one texel.
inline uvec2 levelsImageSize(uvec2 pixels, uint32_t levels) {
    uint32_t rows = 0;
    for (uint32_t level = 1; level < levels; ++level) {
        rows += levelSize(pixels, level).y;
    }
    return glm::max(uvec2(levelSize(pixels, 1).x, rows), uvec2(1));
}

}  // namespace reflet
