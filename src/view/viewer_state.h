// The viewer's state: everything that panels change and that is saved.
#pragma once

#include "job/scene_options.h"
#include "renderer/settings.h"
#include "scene/scene.h"

#include <cstdint>
#include <optional>
#include <string>

namespace reflet {

enum class Running : uint8_t {
    onDemand,    ///< renders after a change until the image has converged
    continuous,  ///< renders all the time
    paused,      ///< renders nothing
};

/// The content of the right side of the divider.
enum class CompareWith : uint8_t {
    nothing,
    preset,  ///< rendered live with another preset
    file,    ///< an EXR
    truth,   ///< path traced in the background
};

struct Compare {
    CompareWith with = CompareWith::nothing;
    std::string preset = "plain";
    std::string file;
    uint32_t samples = 256;   ///< samples per pixel of the ground truth
    float divider = 0.5F;     ///< position as a fraction of the image's width
    bool errorImage = false;  ///< FLIP map instead of the right image
};

struct ViewerState {
    SceneOptions source;  ///< the opened scene and its options
    View view;
    std::string preset;
    Settings settings;
    Settings ofPreset;  ///< baseline for "changed" and "reset"
    Running running = Running::onDemand;
    bool plays = false;  ///< animations play
    std::string show = "final";
    bool falseColor = false;  ///< colour map of the show's first channel, from low to high
    float low = 0.0F;
    float high = 1.0F;
    float scale = 1.0F;       ///< rendered pixels per window pixel, along each side
    float mostFrames = 0.0F;  ///< limit of frames per second; 0: no limit
    Compare compare;
    bool panels = true;
    float panelWidth = 380.0F;  ///< in desktop units, at text scale 1
    uvec2 window{0};            ///< size in desktop units
    bool help = false;
};

}  // namespace reflet
