// Which histories a frame reads. Sequences, the window, default numbers of frames and the passes themselves all take it
// from here.
#pragma once

#include "base/math.h"

#include <cstdint>

namespace reflet {

struct Settings;
struct Scene;

/// Which histories a frame reads with some settings.
struct HistoryUse {
    bool shadows = false;         ///< denoised visibility of the sun (shadow.history)
    bool hitLight = false;        ///< last frame's lit image, as light at hits (trace_screen.light=previous)
    bool probes = false;          ///< one face captured per frame (probes.refresh=face)
    bool denoise = false;         ///< indirect light, diffuse and specular (denoise.history)
    bool temporal = false;        ///< temporal antialiasing
    bool accumulate = false;      ///< mean over all frames of a still view
    bool cameraTextures = false;  ///< textures that show what another camera of the scene sees
    bool exposure = false;        ///< smoothed exposure: it settles in the first frame of a still view

    [[nodiscard]] bool any() const {
        return shadows || hitLight || probes || denoise || temporal || accumulate || cameraTextures || exposure;
    }
};

HistoryUse historyUse(const Settings& settings);
HistoryUse historyUse(const Settings& settings, const Scene& scene);

/// Frames of a still view and scene after which its image is settled: what `render` takes without --frames. 1 where
/// there is no history. A mean (accumulate) never settles; it counts as the reference's default, 64 samples per pixel.
uint32_t framesToSettle(HistoryUse use, const Settings& settings);

/// The size at which a picture of `size` is rendered: temporal upscaling brings it to full size.
uvec2 renderSize(const Settings& settings, uvec2 size);

/// Subpixel jitter of a frame, in pixels off the pixel's centre; 0 where nothing averages over frames. `frame` counts
/// from the renderer's start, `framesBefore` those with the same view and settings.
vec2 frameJitter(const Settings& settings, uint32_t frame, uint32_t framesBefore);

}  // namespace reflet
