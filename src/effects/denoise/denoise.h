// Spatiotemporal denoiser for diffuse GI and reflections: accumulation over frames, then a blur over neighbours on the
// same surface. Works on the traced grid. Shared by C++ and GLSL.
//
// tiles: brightness of 8x8 pixels → gather: firefly clamp, reprojected history → blur, several passes. The light is
// demodulated: not yet multiplied by the surface's reflectance. (After: Schied et al., Spatiotemporal Variance-Guided
// Filtering, HPG 2017: moments over time; Zhdan, ReBLUR, Ray Tracing Gems II, 2021: a recurrent blur whose radius
// follows history and hit distance; Stachowiak and Uludag, Stochastic Screen-Space Reflections, SIGGRAPH 2015:
// reflections are reprojected at their virtual image.)
#ifndef REFLET_EFFECTS_DENOISE_H
#define REFLET_EFFECTS_DENOISE_H

#include "base/shared.h"
#include "effects/view.h"

SHARED_BEGIN

#define DENOISE_SETTINGS(VALUE, SWITCH, CHOICE)                                                                        \
    SWITCH(enabled, 0,                                                                                                 \
           "Denoise indirect light (diffuse GI and reflections) with a spatiotemporal filter. Removes the noise of "   \
           "low sample counts.")                                                                                       \
    VALUE(uint, history, 64, 0, 1024,                                                                                  \
          "Maximum history length in frames (temporal accumulation). More: less noise, more ghosting. 0: no history, " \
          "each frame is denoised alone. At rest histories grow beyond it.")                                           \
    VALUE(uint, passes, 2, 0, 4,                                                                                       \
          "Blur passes of up to eight taps; every pass halves the radius. More: smoother, slower. Ambient occlusion "  \
          "has at most one.")                                                                                          \
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
    vec2 motionToPixels;  // from motion in uv to pixels of the grid
    float gridAngle;      // size of a grid pixel at distance 1 [m/m]; orthographic: at any distance [m]
    uint hasPrevious;     // 1: the history holds the last frame
};

struct DenoiseBlurParams {
    ViewParams view;  // of the grid
    float radius;     // pixels of the grid, without history
    float gridAngle;  // size of a grid pixel at distance 1 [m/m]; orthographic: at any distance [m]
    uint pass;        // 0, 1, …
};

SHARED_END

#ifdef __cplusplus

#include "effects/lobe/rays.h"
#include "gpu/pass_list.h"

namespace reflet {

/// Owns the denoiser's history of a lobe.
struct DenoiseStore {
    gpu::HistoryImage light{"denoise.light"};
    gpu::HistoryImage surface{"denoise.surface"};
    gpu::HistoryImage moments{"denoise.moments"};
    gpu::HistoryImage directional{"denoise.directional"};
};

/// The denoiser's history of a lobe; images of the grid's size.
struct DenoiseHistory {
    gpu::History light;        ///< RGBA16F: mean radiance, mean hit distance [m]; 1x1 without history
    gpu::History surface;      ///< RG32_UINT: depth as bits, 0: no surface with this lobe; normal and roughness
    gpu::History moments;      ///< RG16F: history length in frames, mean squared luminance of a frame
    gpu::History directional;  ///< mean of LobeLight.directional; 1x1 without history or if the lobe has none
    bool valid = false;        ///< whether all `previous` images exist
};

/// The history that denoise() reads and writes in this frame. own: none: there is no history. size: of the grid.
DenoiseHistory denoiseHistory(gpu::PassList& f, DenoiseStore* own, uint32_t lobe, uvec2 size,
                              const DenoiseSettings& settings);

/// Denoises the lobe. own: none: this frame alone, whatever settings.history is. picture: the full-resolution view of
/// light.from. Preserves mean radiance; infinity, NaN and values beyond half floats become finite.
LobeLight denoise(gpu::PassList& f, DenoiseStore* own, const LobeLight& light, uint32_t lobe, const ViewParams& picture,
                  DenoiseSettings settings);

}  // namespace reflet
#endif

#endif
