// Mips of an image of light: mean radiance of ever larger squares of pixels, for what must not see single ones.
// Shared by C++ and GLSL. All levels lie in one image, as render/levels.h says, down to a single cell.
#ifndef REFLET_RENDER_LIGHT_MIPS_H
#define REFLET_RENDER_LIGHT_MIPS_H

#include "base/shared.h"

SHARED_BEGIN

struct LightMipsParams {
    uvec2 size;  // of level 0
    uint level;  // to make, from 1
};

SHARED_END

#ifdef __cplusplus

#include "gpu/frame.h"

namespace reflet {

/// RGBA16F: level 1 and up of an RGBA16F image. Each cell is the mean of its pixels, be they fewer at an edge.
gpu::Image makeLightMips(gpu::Frame& f, gpu::Image light);

}  // namespace reflet
#endif

#endif
