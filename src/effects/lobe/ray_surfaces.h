// The surfaces that a lobe's rays start from: every pixel, or at reduced resolution one pixel of each block (2x2 to
// 4x4). Shared by C++ and GLSL.
//
// A coarse grid is treated as a view of its own: a smaller image by a camera whose pixel centres are those of the
// picked pixels. Ray sources need no special case.
#ifndef REFLET_EFFECTS_RAY_SURFACES_H
#define REFLET_EFFECTS_RAY_SURFACES_H

#include "base/shared.h"
#include "effects/view.h"

SHARED_BEGIN

struct PickSurfacesParams {
    uvec2 size;        // full resolution, pixels
    uvec2 picked;      // of the coarse grid
    uint scale;        // side of a block in pixels
    uint blockOffset;  // of the picked pixel within its block, along each side
};

SHARED_END

#ifdef __cplusplus

#include "effects/gbuffer/gbuffer.h"
#include "gpu/pass_list.h"

namespace reflet {

/// Surfaces that rays start from, one per pixel of `view`.
struct RaySurfaces {
    GBuffer g;             ///< as at full resolution, but a coarse grid's depth is R32F and has no emissive
    ViewParams view;       ///< its clip space maps the picked pixels' centres to the coarse pixels' centres. pixelAngle
                           ///< stays that of full resolution, the resolution of depth
    uint32_t scale = 1;    ///< side of a block in full-resolution pixels
    gpu::Image origins{};  ///< RGBA32F array: points in world space where rays start, if not at the surfaces; none
    gpu::Image ambientOcclusion{};  ///< of ambientOcclusion(), at full resolution: dims prefiltered light; may be none
};

/// The picked pixel of a block, along each side.
constexpr uint32_t blockPixelOffset(uint32_t scale) {
    return (scale - 1) / 2;
}

/// The view of a coarse grid: ceil(size / scale) pixels.
ViewParams viewOfBlocks(const ViewParams& view, uint32_t scale);

/// The surfaces of a grid with blocks of scale x scale pixels; with 1 nothing is copied. A block whose picked pixel
/// lies outside of the image counts as sky.
RaySurfaces pickSurfaces(gpu::PassList& f, const GBuffer& g, const ViewParams& view, uint32_t scale);

}  // namespace reflet
#endif

#endif
