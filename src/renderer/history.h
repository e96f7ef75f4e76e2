// Which histories a frame reads: the common source for sequences, the window, default numbers of frames and the passes
// themselves.
#pragma once

#include "base/math.h"

#include <cstdint>

namespace reflet {

struct Settings;
struct Scene;

/// Which histories a frame reads with given settings.
struct HistoryUse {
    bool shadows = false;         ///< denoised visibility of the sun (shadow.history)
    bool hitLight = false;        ///< last frame's lit image, as light at hits (trace_screen.light=previous)
    bool probes = false;          ///< one face captured per frame (probes.refresh=face)
    bool denoise = false;         ///< indirect light, diffuse and specular (denoise.history)
    bool temporal = false;        ///< temporal antialiasing
    bool accumulate = false;      ///< mean over all frames of a still view
    bool cameraTextures = false;  ///< textures that show the view of another camera of the scene
    bool exposure = false;        ///< smoothed exposure: it settles in the first frame of a still view

    [[nodiscard]] bool any() const {
        return shadows || hitLight || probes || denoise || temporal || accumulate || cameraTextures || exposure;
    }
};

HistoryUse historyUse(const Settings& settings);
HistoryUse historyUse(const Settings& settings, const Scene& scene);

/// Number of frames of a still view and scene until the image has settled: the default of `render --frames`. 1 if there
/// is no history. Accumulation never settles; for it, the reference's default is used: 64 samples per pixel.
uint32_t framesToSettle(HistoryUse use, const Settings& settings);

/// The rendered size of a picture of `size`; smaller with temporal upscaling.
uvec2 renderSize(const Settings& settings, uvec2 size);

/// Subpixel jitter of a frame, in pixels from the pixel's centre; 0 if nothing averages over frames. frame: counted
/// from the renderer's start; framesBefore: number of frames before it with the same view and settings.
vec2 frameJitter(const Settings& settings, uint32_t frame, uint32_t framesBefore);

}  // namespace reflet
