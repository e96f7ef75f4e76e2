// Quality reductions while the image moves, so that interaction stays smooth on slow devices.
#pragma once

#include "base/math.h"
#include "renderer/settings.h"

#include <optional>

namespace reflet {

/// Reductions of a frame.
struct Effort {
    float scale = 1.0F;    ///< factor on width and height of the rendered image
    bool fewRays = false;  ///< at most one ray per pixel and lobe and one layer of glass; no planar reflections

    [[nodiscard]] bool isReduced() const { return scale < 1.0F || fewRays; }
    bool operator==(const Effort&) const = default;
};

/// Applies the effort to the size and the settings of an image. Temporal upscaling, if enabled, is unchanged: most of
/// its cost depends on the output size.
void reduce(const Effort& effort, uvec2& size, Settings& settings);

/// Chooses the effort from the times of earlier frames.
class EffortControl {
public:
    static constexpr double targetMs = 120.0;  ///< target time of a moving frame: eight per second, five under load

    /// Records the time of a frame. size: before reductions.
    void note(uvec2 size, const Effort& effort, double milliseconds);
    /// Records that a frame without reductions was stopped after this time.
    void noteStopped(uvec2 size, double milliseconds);
    /// The effort for the next moving frame of an image of this size.
    [[nodiscard]] Effort choose(uvec2 size);

private:
    double perPixel_ = 0.0;         ///< milliseconds, without reductions
    std::optional<Effort> chosen_;  ///< last choice, kept while nearly right: every new size invalidates the history
    double chosenFor_ = 0.0;        ///< perPixel_ at the time of that choice
};

}  // namespace reflet
