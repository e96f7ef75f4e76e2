// The cases of `reflet bench --motions`: a small scene, and how its view, time and lights change from frame to frame.
#pragma once

#include "scene/scene.h"

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace reflet {

struct MotionCase {
    /// Which lag is measured, in frames from `event` on.
    enum class Lag : uint8_t {
        none,
        light,  ///< frames until 90 % of a step in light is visible; nothing else changes
        rest,   ///< frames until the error is at most 1.1 times that at rest
    };

    std::string_view name;
    std::string_view description;                     ///< one line
    std::string_view scene;                           ///< a built-in scene
    uint32_t frames = 12;                             ///< number of measured frames
    View (*view)(const View& first, uint32_t frame);  ///< frame 0: at rest, before the measured frames
    double ratio = 1.5;                               ///< target: error in motion over error at rest
    Lag lag = Lag::none;
    uint32_t event = 1;  ///< the frame with the step, or the first frame at rest
};

std::span<const MotionCase> motionCases();

/// The cases of these names, each once; "all": all cases. Throws UsageError for an unknown name.
std::vector<MotionCase> findMotionCases(const std::vector<std::string>& names);

}  // namespace reflet
