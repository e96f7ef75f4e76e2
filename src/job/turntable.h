// Renders turntables: a full turn around a scene, each frame a converged still.
#pragma once

#include "job/sequence.h"

#include <cstdint>
#include <string>
#include <string_view>

namespace reflet {

struct TurntableOptions {
    RenderOptions render;  ///< number and names of the frames; `sequence`: only firstFrame, fps, share, overwrite
    double seconds = 4.0;  ///< duration of the film
    std::string effort = "normal";  ///< draft, normal or high
    bool animated = false;          ///< whether animations play, a whole number of times
    std::string light;              ///< "camera" or "scene": what the light is fixed to; empty: see makeTurntable
};

/// Number of frames: seconds times fps, at least 2. Throws UsageError for too many.
uint32_t turntableFrames(const TurntableOptions& options);

/// The preset of an effort. Throws UsageError for an unknown one.
std::string_view turntablePreset(const std::string& effort);

/// The first frame's view, and the parameters of all others.
struct Turntable {
    View first;
    vec3 pivot{0.0F};         ///< a point on the vertical axis of the turn
    bool lightTurns = false;  ///< sun and environment turn with the camera
    uint32_t frames = 1;
    double played = 0.0;  ///< seconds of animation that play during the turn; 0: static

    /// The view of a frame. The camera moves counter-clockwise as seen from above.
    [[nodiscard]] View view(uint32_t frame) const;
    /// The view of the frame before; for the first frame, that of the last.
    [[nodiscard]] View before(uint32_t frame) const { return view((frame + frames - 1) % frames); }
};

/// A camera from --camera or a view file orbits its target. Otherwise the scene is framed from all sides; in a closed
/// room, or where the scene's own camera has a roof above it, the camera stands inside and turns in place. A file
/// without light is lit by a studio. A built-in environment turns with the camera, as if the scene turned, unless the
/// scene has a sun.
Turntable makeTurntable(const TurntableOptions& options, const Scene& scene);

/// The settings with automatic exposure replaced by one that suits all sides on average: metering each frame separately
/// would flicker.
Settings exposedForAll(const RenderJob& job, const Turntable& turntable);

/// Renders the frames of this share whose files are missing, each from an empty history down to the effort's noise, so
/// that the files do not depend on the order. Throws Error when interrupted. Returns how many it wrote.
uint32_t renderTurntable(const RenderJob& job, const Turntable& turntable, const std::string& effort);

}  // namespace reflet
