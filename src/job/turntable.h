// Renders turntables: a whole turn around a scene, each frame a finished still.
#pragma once

#include "job/sequence.h"

#include <cstdint>
#include <string>
#include <string_view>

namespace reflet {

struct TurntableOptions {
    RenderOptions render;  ///< with the frames' number and names; of the sequence first frame, fps, share, overwrite
    double seconds = 4.0;  ///< of the film
    std::string effort = "normal";  ///< draft, normal or high
    bool animated = false;          ///< the animations play: a whole number of times
    std::string light;              ///< "camera" or "scene": what the light stays with; empty: see turntableView
};

/// Number of frames: seconds times fps, at least 2. Throws UsageError for too many.
uint32_t turntableFrames(const TurntableOptions& options);

/// The preset of an effort. Throws UsageError for an unknown one.
std::string_view turntablePreset(const std::string& effort);

/// The first frame's view, and what all others share.
struct Turntable {
    View first;
    vec3 pivot{0.0F};         ///< on the vertical axis of the turn
    bool lightTurns = false;  ///< sun and environment turn with the camera
    uint32_t frames = 1;
    double played = 0.0;  ///< seconds of the animations that play during the turn; 0: they stand still

    /// The camera goes counter-clockwise as seen from above.
    [[nodiscard]] View view(uint32_t frame) const;
    /// The frame before it; of the first: the last.
    [[nodiscard]] View before(uint32_t frame) const { return view((frame + frames - 1) % frames); }
};

/// A camera from --camera or a view file goes around its target. Otherwise the scene is framed from all sides; in a
/// closed room, or where the scene's own camera has a roof above it, the camera stands inside and turns around itself.
/// A file without light is lit by a studio. A made environment turns with the camera, as if the scene turned, unless
/// the scene has a sun.
Turntable makeTurntable(const TurntableOptions& options, const Scene& scene);

/// The settings with the exposure that suits all sides on average, where it is automatic: an exposure of each frame's
/// own would flicker.
Settings exposedForAll(const RenderJob& job, const Turntable& turntable);

/// Renders the frames of this share whose files are missing, each from an empty history until its noise is that of the
/// effort: the same bytes in any order. Throws Error when interrupted. Returns how many it wrote.
uint32_t renderTurntable(const RenderJob& job, const Turntable& turntable, const std::string& effort);

}  // namespace reflet
