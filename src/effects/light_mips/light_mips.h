// Mips of a radiance image, for prefiltered lookups at the hits of cones. Shared by C++ and GLSL. All levels are in one
// image, in the layout of effects/levels.h, down to a single cell.
#ifndef REFLET_EFFECTS_LIGHT_MIPS_H
#define REFLET_EFFECTS_LIGHT_MIPS_H

#include "base/shared.h"

SHARED_BEGIN

struct LightMipsParams {
    uvec2 size;  // of level 0
    uint level;  // to make, from 1
};

SHARED_END

#ifdef __cplusplus

#include "gpu/pass_list.h"

namespace reflet {

/// RGBA16F: level 1 and up of an RGBA16F image. Each cell is the mean of its pixels; cells at edges may have fewer.
gpu::Image makeLightMips(gpu::PassList& f, gpu::Image light);

}  // namespace reflet
#endif

#endif
