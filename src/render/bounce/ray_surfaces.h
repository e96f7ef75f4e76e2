// The surfaces that a lobe's rays leave: every pixel's, or those of one pixel of each 2x2 or 4x4. Shared by C++ and
// GLSL.
//
// A coarser grid is a view of its own: a smaller picture by a camera whose pixel centres are the picked pixels'
// centres. So sources need not know of it.
#ifndef REFLET_RENDER_RAY_SURFACES_H
#define REFLET_RENDER_RAY_SURFACES_H

#include "base/shared.h"
#include "render/view.h"

SHARED_BEGIN

struct PickSurfacesParams {
    uvec2 size;        // of the whole picture, pixels
    uvec2 picked;      // of the coarser one
    uint scale;        // pixels of a block along each side
    uint blockOffset;  // within the block, along each side, that is picked
};

SHARED_END

#ifdef __cplusplus

#include "gpu/frame.h"
#include "render/gbuffer/gbuffer.h"

namespace reflet {

/// Surfaces that rays leave, a pixel of `view` each.
struct RaySurfaces {
    GBuffer g;           ///< as of the whole picture; a coarser grid's depth is R32F, and there is no emissive
    ViewParams view;     ///< its clip space puts the picked pixels' centres at the centres of the coarser picture's
                         ///< pixels. pixelAngle is the whole picture's: depth is as fine as that
    uint32_t scale = 1;  ///< pixels of the whole picture along a block's sides
};

/// Which pixel of a block is picked, along each side.
constexpr uint32_t blockPixelOffset(uint32_t scale) {
    return (scale - 1) / 2;
}

/// The view of a coarser grid: ceil(size / scale) pixels.
ViewParams viewOfBlocks(const ViewParams& view, uint32_t scale);

/// Picks the surfaces of a grid with blocks of scale x scale pixels; 1: all of them, nothing is copied. A block
/// whose picked pixel lies outside of the picture shows the sky.
RaySurfaces pickSurfaces(gpu::Frame& f, const GBuffer& g, const ViewParams& view, uint32_t scale);

}  // namespace reflet
#endif

#endif
