// What the window shows and how: all that is saved, and all that panels change.
#pragma once

#include "apps/scene_options.h"
#include "render/settings.h"
#include "scene/scene.h"

#include <cstdint>
#include <optional>
#include <string>

namespace reflet {

enum class Running : uint8_t {
    onDemand,    ///< frames are drawn after a change, until the picture has come to rest
    continuous,  ///< one after the other
    paused,      ///< none
};

/// What the right side of the divider shows.
enum class CompareWith : uint8_t {
    nothing,
    preset,  ///< live
    file,    ///< an EXR
    truth,   ///< path traced in the background
};

struct Compare {
    CompareWith with = CompareWith::nothing;
    std::string preset = "plain";
    std::string file;
    uint32_t samples = 256;   ///< of the truth, per pixel
    float divider = 0.5F;     ///< share of the picture's width
    bool errorImage = false;  ///< FLIP in the place of the right side
};

struct ViewerState {
    SceneOptions source;  ///< what was opened, and how
    View view;
    std::string preset;
    Settings settings;
    Settings ofPreset;  ///< what "changed" and "reset" are measured by
    Running running = Running::onDemand;
    bool plays = false;  ///< animations
    std::string show = "final";
    bool falseColor = false;  ///< of the show's first channel, from low to high
    float low = 0.0F;
    float high = 1.0F;
    float scale = 1.0F;       ///< pixels rendered for each of the window's, along a side
    float mostFrames = 0.0F;  ///< a second; 0: no limit
    Compare compare;
    bool panels = true;
    float panelWidth = 380.0F;  ///< in the desktop's units, on a display that does not make text larger
    uvec2 window{0};            ///< the same
    bool help = false;
};

}  // namespace reflet
