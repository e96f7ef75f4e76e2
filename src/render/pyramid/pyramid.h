// The depth pyramid: nearest and farthest depth of ever larger squares of pixels. Shared by C++ and GLSL.
// All levels lie in one image, as render/levels.h says. The sky does not count: nothing can hit it. Cells that show
// nothing else have a nearest depth of 0 and a farthest of -1, others that show some sky a negative farthest.
#ifndef REFLET_RENDER_PYRAMID_H
#define REFLET_RENDER_PYRAMID_H

#include "base/shared.h"

SHARED_BEGIN

// Levels that rays use, the pixels themselves (level 0) included: cells of up to 64 x 64 pixels.
const uint pyramidLevels = 7;

struct PyramidParams {
    uvec2 size;        // of level 0
    uint level;        // to make, from 1
    uint secondLayer;  // 1: the farthest is that of the back faces, where there are any
};

SHARED_END

#ifdef __cplusplus

#include "gpu/frame.h"

namespace reflet {

/// RG32F: the largest (nearest) and the smallest (farthest) reversed depth of each cell, negative where there is sky.
/// backDepth: of the second layer, or none.
gpu::Image makePyramid(gpu::Frame& f, gpu::Image depth, gpu::Image backDepth = {});

}  // namespace reflet
#endif

#endif
