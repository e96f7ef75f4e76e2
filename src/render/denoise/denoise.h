// Cleans what few rays per pixel brought: over frames, then over neighbours on the same surface. One for both lobes, on
// the grid of pixels that the rays leave. Shared by C++ and GLSL.
//
// tiles: how bright 8x8 pixels are → gather: fireflies spread, what of the last frames still holds → blur, several
// times. What it cleans is light before the surface's own colour comes in. (After: Schied et al., Spatiotemporal
// Variance-Guided Filtering, HPG 2017: moments over time; Zhdan, ReBLUR, Ray Tracing Gems II, 2021: a recurrent blur
// whose radius follows history and hit distance; Stachowiak and Uludag, Stochastic Screen-Space Reflections, SIGGRAPH
// 2015: reflections are reprojected by where they seem to be.)
#ifndef REFLET_RENDER_DENOISE_H
#define REFLET_RENDER_DENOISE_H

#include "base/shared.h"
#include "render/view.h"

SHARED_BEGIN

#define DENOISE_SETTINGS(VALUE, SWITCH, CHOICE)                                                                        \
    SWITCH(enabled, 0,                                                                                                 \
           "Denoise diffuse GI and reflections with a spatiotemporal filter. Removes the noise of low sample counts.") \
    VALUE(uint, history, 64, 0, 1024,                                                                                  \
          "Maximum history length in frames (temporal accumulation). More: less noise, more ghosting. 0: no history, " \
          "each frame is denoised alone.")                                                                             \
    VALUE(uint, passes, 2, 0, 4,                                                                                       \
          "Blur passes of eight taps each; every pass halves the radius. More: smoother, slower.")                     \
    VALUE(float, radius, 24.0, 0.0, 256.0,                                                                             \
          "Maximum blur radius in pixels, used where there is no history. Shrinks with remaining noise, near hits "    \
          "and narrow lobes.")                                                                                         \
    VALUE(float, fireflies, 8.0, 0.0, 1000.0,                                                                          \
          "Firefly clamp: samples brighter than this many times the local mean are clamped and their energy spread "   \
          "over the neighbours. 0: off.")                                                                              \
    VALUE(float, clip, 2.0, 0.0, 100.0,                                                                                \
          "History clip (variance clipping): maximum difference of the history from current neighbours, in standard "  \
          "deviations. Lower: less ghosting. Higher: less noise. 0: off.")                                             \
    SWITCH(directional, 1,                                                                                             \
           "Store how diffuse light varies with the normal, so that pixels with different normals can share samples, " \
           "and normal map detail survives denoising and half resolution.")
SETTINGS(DenoiseSettings, DENOISE_SETTINGS)

const uint denoiseTileSide = 8;  // pixels of the grid

struct DenoiseTilesParams {
    uvec2 size;   // of the grid
    float limit;  // DenoiseSettings.fireflies
};

struct DenoiseGatherParams {
    ViewParams view;  // of the grid
    DenoiseSettings settings;
    vec2 motionToPixels;  // pixels of the grid that a motion of 1 moves
    uint hasPrevious;     // 1: the history holds the last frame
};

struct DenoiseBlurParams {
    ViewParams view;  // of the grid
    float radius;     // pixels of the grid, without history
    float gridAngle;  // what a pixel of the grid covers at distance 1 [m/m]; orthographic: at any distance [m]
    uint pass;        // 0, 1, …
};

SHARED_END

#ifdef __cplusplus

#include "gpu/frame.h"
#include "render/bounce/rays.h"

namespace reflet {

/// What the denoiser remembers of a lobe from frame to frame; images of the grid's size.
struct DenoiseHistory {
    gpu::History light;        ///< RGBA16F: mean radiance, mean hit distance [m]; 1x1 where nothing is remembered
    gpu::History surface;      ///< RG32_UINT: bits of the depth, 0: none with this lobe; normal and roughness
    gpu::History moments;      ///< RG16F: frames in the mean, mean square of a frame's luminance
    gpu::History directional;  ///< of LobeLight, its mean; 1x1 where nothing is remembered or the lobe has none
    bool valid = false;        ///< whether `previous` of all is there
};

/// That denoise() reads and writes in this frame. size: of the grid.
DenoiseHistory denoiseHistory(gpu::Frame& f, uint32_t lobe, uvec2 size, const DenoiseSettings& settings);

/// The same light with less noise. picture: the whole picture's view, of which light.from is a grid. Mean radiance is
/// kept; what comes in as inf, NaN or beyond half floats goes out as finite.
LobeLight denoise(gpu::Frame& f, const LobeLight& light, uint32_t lobe, const ViewParams& picture,
                  const DenoiseSettings& settings);

}  // namespace reflet
#endif

#endif
