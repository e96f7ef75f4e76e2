// How much is spent on a frame while the image moves, so that on slow devices it still follows the hand.
#pragma once

#include "base/math.h"
#include "renderer/settings.h"

#include <optional>

namespace reflet {

/// Reductions of a frame.
struct Effort {
    float scale = 1.0F;    ///< of the sides of what is rendered
    bool fewRays = false;  ///< at most one ray per pixel and lobe and one layer of glass; no planar reflections

    [[nodiscard]] bool isReduced() const { return scale < 1.0F || fewRays; }
    bool operator==(const Effort&) const = default;
};

/// Applies the effort to the size and the settings of an image. Temporal upscaling, where the settings have it, stays
/// as it is: most of what it costs depends on the size that it scales to.
void reduce(const Effort& effort, uvec2& size, Settings& settings);

/// Chooses the effort from the times of earlier frames.
class EffortControl {
public:
    static constexpr double targetMs = 120.0;  ///< of a moving frame: eight a second, and five under load

    /// A frame of an image of this size (before reductions) took so long.
    void note(uvec2 size, const Effort& effort, double milliseconds);
    /// A frame without reductions was stopped after so long.
    void noteStopped(uvec2 size, double milliseconds);
    /// For the next moving frame of an image of this size.
    [[nodiscard]] Effort choose(uvec2 size);

private:
    double perPixel_ = 0.0;         ///< milliseconds, without reductions
    std::optional<Effort> chosen_;  ///< the last one, kept while it is nearly right: every new size costs the history
    double chosenFor_ = 0.0;        ///< perPixel_ at that time
};

}  // namespace reflet
