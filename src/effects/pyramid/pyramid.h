// Hierarchical depth (Hi-Z): a min/max pyramid of nearest and farthest depth. Shared by C++ and GLSL. All levels are in
// one image: level 0 at the left, the others at its right in the layout of effects/levels.h. Level 0 holds the depths
// of both layers, so that a step of a ray is one load, whatever its level. The sky is excluded, as nothing can hit it:
// cells with only sky have a nearest depth of 0 and a farthest of -1, cells with some sky a negative farthest.
#ifndef REFLET_EFFECTS_PYRAMID_H
#define REFLET_EFFECTS_PYRAMID_H

#include "base/shared.h"

SHARED_BEGIN

// Number of levels including level 0 (the depth buffer): cells of up to 64 x 64 pixels.
const uint pyramidLevels = 7;

struct PyramidParams {
    uvec2 size;        // of level 0
    uint level;        // 1, 3, 5: makes this one and the next; with 1 also level 0
    uint secondLayer;  // 1: the farthest depth is that of back faces, if any
};

SHARED_END

#ifdef __cplusplus

#include "gpu/pass_list.h"

namespace reflet {

/// RG32F: the largest (nearest) and the smallest (farthest) reversed depth of each cell, negative where there is sky;
/// of level 0 the depths of both layers, the second 0 where there is none. backDepth: the second layer, or none.
gpu::Image makePyramid(gpu::PassList& f, gpu::Image depth, gpu::Image backDepth = {});

}  // namespace reflet
#endif

#endif
