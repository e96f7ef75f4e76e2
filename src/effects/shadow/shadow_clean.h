// Shadow denoiser: removes the sun visibility's noise of low sample counts by accumulation over frames, then by a blur
// over neighbours on the same surface. The kernel is proportional to the penumbra and anisotropic, longer along the
// shadow's edge than across it. Shared by C++ and GLSL.
//
// tiles: those with penumbras → gather: temporal accumulation, and each pixel's kernel → blur, twice.
// (After: Schied et al., Spatiotemporal Variance-Guided Filtering, HPG 2017: history, then wavelets that stop at edges;
// Mehta et al., Axis-Aligned Filtering for Interactive Sampled Soft Shadows, ACM TOG 2012: kernels from the penumbra.)
#ifndef REFLET_EFFECTS_SHADOW_CLEAN_H
#define REFLET_EFFECTS_SHADOW_CLEAN_H

#include "base/shared.h"
#include "effects/view.h"

SHARED_BEGIN

// Texels of the gathered and blurred images (R32_UINT): visibility (unorm16) and, in the upper bits, penumbra width
// (half) [m]; 0: use the visibility unchanged.
const uint shadowTileSide = 8;  // pixels; one thread group per tile
const uint maxShadowTileGroups = 65535;

// Header size of the tile list in bytes: group counts for an indirect dispatch, then the number of tiles.
const uint shadowTilesHeader = 16;

struct ShadowTilesParams {
    uvec2 size;
};

struct ShadowDenoiseParams {
    ViewParams view;
    vec3 toSun;          // world space, unit
    uint historyFrames;  // maximum history length; 0: no history
    uint samples;        // samples per pixel and frame of the visibility
    uint hasPrevious;    // 1: the history holds the last frame
};

struct ShadowBlurParams {
    uvec2 size;
    uint samples;  // as in ShadowDenoiseParams
};

SHARED_END

#ifdef __cplusplus

#include "effects/gbuffer/gbuffer.h"
#include "gpu/pass_list.h"

namespace reflet {

/// visibility: R8; penumbra: RG16F, x: full width perpendicular to the sun's direction [m], 0 or less: unknown (see
/// SunVisibility). Sets params.hasPrevious. Returns R8. own: none: this frame alone,
/// whatever params.historyFrames is.
gpu::Image denoiseShadow(gpu::PassList& f, gpu::HistoryImage* own, const GBuffer& g, gpu::Image visibility,
                         gpu::Image penumbra, ShadowDenoiseParams params);

}  // namespace reflet
#endif

#endif
