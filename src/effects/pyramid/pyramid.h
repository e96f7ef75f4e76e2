// Hierarchical depth (Hi-Z): a min/max pyramid of nearest and farthest depth. Shared by C++ and GLSL. All levels are in
// one image, in the layout of effects/levels.h. The sky is excluded, as nothing can hit it: cells with only sky have a
// nearest depth of 0 and a farthest of -1, cells with some sky a negative farthest.
#ifndef REFLET_EFFECTS_PYRAMID_H
#define REFLET_EFFECTS_PYRAMID_H

#include "base/shared.h"

SHARED_BEGIN

// Number of levels including level 0 (the depth buffer): cells of up to 64 x 64 pixels.
const uint pyramidLevels = 7;

struct PyramidParams {
    uvec2 size;        // of level 0
    uint level;        // to make, from 1
    uint secondLayer;  // 1: the farthest depth is that of back faces, if any
};

SHARED_END

#ifdef __cplusplus

#include "gpu/pass_list.h"

namespace reflet {

/// RG32F: the largest (nearest) and the smallest (farthest) reversed depth of each cell, negative where there is sky.
/// backDepth: the second layer, or none.
gpu::Image makePyramid(gpu::PassList& f, gpu::Image depth, gpu::Image backDepth = {});

}  // namespace reflet
#endif

#endif
