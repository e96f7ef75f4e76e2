// Cleans the sun's visibility of the noise that few samples leave: over frames, then over neighbours on the same
// surface, by a kernel in proportion to the penumbra, longer along the shadow's edge than across it. Shared by C++ and
// GLSL.
//
// tiles: which need cleaning → gather: what of the last frames still holds, and each pixel's kernel → blur, twice.
// (After: Schied et al., Spatiotemporal Variance-Guided Filtering, HPG 2017: history, then wavelets that stop at edges;
// Mehta et al., Axis-Aligned Filtering for Interactive Sampled Soft Shadows, ACM TOG 2012: kernels from the penumbra.)
#ifndef REFLET_RENDER_SHADOW_CLEAN_H
#define REFLET_RENDER_SHADOW_CLEAN_H

#include "base/shared.h"
#include "render/view.h"

SHARED_BEGIN

// A texel (R32_UINT) of what is gathered and blurred: visibility (unorm16) and, above it, the penumbra's width (half)
// [m]; 0: the visibility is as it was.
const uint shadowTileSide = 8;  // pixels; a group of threads each
const uint maxShadowTileGroups = 65535;

// Bytes before the list of tiles: group counts for an indirect dispatch, then the number of tiles.
const uint shadowTilesHeader = 16;

struct ShadowTilesParams {
    uvec2 size;
};

struct ShadowDenoiseParams {
    ViewParams view;
    vec3 toSun;          // world space, unit
    uint historyFrames;  // whose mean is kept, at most; 0: none
    uint samples;        // of a pixel and frame, that the visibility was made of
    uint hasPrevious;    // 1: the history holds the last frame
};

struct ShadowBlurParams {
    uvec2 size;
    uint samples;  // as in ShadowDenoiseParams
};

SHARED_END

#ifdef __cplusplus

#include "gpu/frame.h"
#include "render/gbuffer/gbuffer.h"

namespace reflet {

/// visibility: R8; penumbra: RG16F, x: full width across the sun's direction [m], 0 or less: none known (see
/// SunVisibility). params.hasPrevious is set here. Gives R8.
gpu::Image denoiseShadow(gpu::Frame& f, const GBuffer& g, gpu::Image visibility, gpu::Image penumbra,
                         ShadowDenoiseParams params);

}  // namespace reflet
#endif

#endif
