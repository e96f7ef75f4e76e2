// Adaptive sampling: estimates the remaining noise of a lobe in each tile and distributes a ray budget accordingly.
// Shared by C++ and GLSL.
//
// The mean of n rays with standard deviation s has the error s / sqrt(n). For a given total of rays, the sum of squared
// errors over the image is least when n is proportional to s. History counts: one more frame contributes 1 / (f + 1) to
// a mean over f frames.
#ifndef REFLET_EFFECTS_ADAPTIVE_RAYS_H
#define REFLET_EFFECTS_ADAPTIVE_RAYS_H

#include "base/shared.h"
#include "effects/view.h"

SHARED_BEGIN

const uint maxAdaptiveRays = 8;  // per pixel

// Noise is quantized into classes, each 2^(1/4) times the one before.
const uint noiseClasses = 64;
const float noiseClassesPerOctave = 4.0;
const float noiseClassOfOne = 44.0;

// Histogram: pixels of each noise class, then the pixels of mirrors, whose ray count does not depend on noise.
const uint histogramSize = noiseClasses + 1;

struct MeasureNoiseParams {
    ViewParams view;      // of the grid
    vec2 motionToPixels;  // from motion in uv to pixels of the grid
    uvec2 picture;        // full resolution, pixels
    uint scale;           // full-resolution pixels per grid pixel, along each side
    uint blockOffset;     // of the traced pixel within its block, along each side
    uint hasHistory;      // 1: the histories hold the last frame
};

struct ShareRaysParams {
    uvec2 tiles;
    uint mean;    // rays per pixel with the lobe
    uint mirror;  // rays per pixel in tiles where all surfaces are mirrors
    float least;  // per pixel
    float most;
};

SHARED_END

#ifdef __cplusplus

#include "effects/lobe/ray_tiles.h"

namespace reflet {

/// A lobe's history from the last frame.
struct LobeHistory {
    gpu::Image light;    ///< of the grid's size: RGBA16F: mean radiance
    gpu::Image surface;  ///< RG32_UINT: R: depth as bits, 0: no surface with this lobe
    gpu::Image moments;  ///< RG16F: frames in the mean, mean square of a frame's luminance
    gpu::Image lit;      ///< full resolution, RGBA16F: the lit image
    bool valid = false;  ///< false: there is no history
};

/// Ray counts per tile in proportion to the noise; `counts.rays` is their mean over the pixels with the lobe.
RayTiles shareRays(gpu::PassList& f, gpu::HistoryImage& own, const RaySurfaces& from, uint32_t lobe,
                   const RayCounts& counts, const LobeHistory& past);

/// The most rays that a pixel gets if the mean is `mean`.
uint32_t adaptiveRayLimit(gpu::PassList& f, uvec2 size, uint32_t mean);

}  // namespace reflet
#endif

#endif
