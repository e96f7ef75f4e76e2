// Rays where they are needed: how much noise a lobe's light still has in each tile, and how a budget of rays is shared
// by it. Shared by C++ and GLSL.
//
// A tile whose light has the standard deviation s from ray to ray, and is the mean of n rays, has the error s /
// sqrt(n). For the sum of squares over the picture to be least with a given number of rays, n goes as s. What is
// remembered counts: to a mean of f frames one more brings 1 / (f + 1).
#ifndef REFLET_RENDER_ADAPTIVE_RAYS_H
#define REFLET_RENDER_ADAPTIVE_RAYS_H

#include "base/shared.h"
#include "render/view.h"

SHARED_BEGIN

const uint maxAdaptiveRays = 8;  // that a pixel may get

// Noise is sorted into classes, each 2^(1/4) times the one before.
const uint noiseClasses = 64;
const float noiseClassesPerOctave = 4.0;
const float noiseClassOfOne = 44.0;

// Begins the histogram: pixels of each class, and then those of mirrors, whose rays no noise changes.
const uint histogramSize = noiseClasses + 1;

struct MeasureNoiseParams {
    ViewParams view;      // of the grid
    vec2 motionToPixels;  // pixels of the grid that a motion of 1 moves
    uvec2 picture;        // pixels
    uint scale;           // of the grid: pixels of the picture
    uint blockOffset;     // within a block, along each side, of the picked pixel
    uint hasHistory;      // 1: the histories hold the last frame
};

struct ShareRaysParams {
    uvec2 tiles;
    uint mean;    // rays per pixel with the lobe
    uint mirror;  // per pixel of tiles that are all mirrors
    float least;  // per pixel
    float most;
};

SHARED_END

#ifdef __cplusplus

#include "render/bounce/ray_tiles.h"

namespace reflet {

/// What is known of a lobe's light from the last frame.
struct LobeHistory {
    gpu::Image light;    ///< of the grid's size: RGBA16F: mean radiance
    gpu::Image surface;  ///< RG32_UINT: R: bits of the depth, 0: no surface with this lobe
    gpu::Image moments;  ///< RG16F: frames in the mean, mean square of a frame's luminance
    gpu::Image lit;      ///< of the picture's size, RGBA16F: the whole picture
    bool valid = false;  ///< false: nothing is
};

/// Numbers of rays that follow the noise: `counts.rays` is their mean over the pixels with the lobe, and `most` the
/// largest. picture: the whole picture's size.
RayTiles shareRays(gpu::Frame& f, const RaySurfaces& from, uint32_t lobe, const RayCounts& counts,
                   const LobeHistory& past);

/// What a pixel may get of a mean of so many.
uint32_t adaptiveRayLimit(gpu::Frame& f, uvec2 size, uint32_t mean);

}  // namespace reflet
#endif

#endif
