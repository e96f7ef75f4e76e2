// The options of `reflet dataset`.
#pragma once

#include "job/scene_options.h"

#include <cstdint>
#include <string>
#include <vector>

namespace reflet {

struct DatasetOptions {
    std::vector<std::string> scenes;  ///< files or builtin:NAME
    SceneOptions view;                ///< for all scenes; its `scene` is not used
    std::string folder;
    uint32_t frames = 0;
    uint32_t burst = 1;  ///< consecutive frames of one random camera
    std::string cameras = "random";
    std::string path;    ///< keyframes, for cameras == "path"
    double fps = 24.0;   ///< the time between frames of a burst, and between a frame and the one before it
    double speed = 1.0;  ///< factor on the motion of random cameras
    std::string height = "free";
    std::string fov = "normal";
    std::string sun = "scene";                 ///< or "random"
    std::vector<std::string> environments;     ///< names, files or folders to draw from; empty: the view's
    std::string exposure = "0..0";             ///< stops, added to the exposure that a picture of the frame would have
    std::vector<std::string> noisy{"1", "4"};  ///< samples per pixel, or presets
    uint32_t samples = 256;                    ///< of clean frames, at most
    float noise = 0.0F;
    float clamp = 0.0F;
    float shutter = 0.0F;        ///< share of the time between frames, of traced images
    std::string layout = "exr";  ///< or "oidn"
    bool displayed = false;      ///< oidn: also the tone-mapped images
    bool floats = false;         ///< all layers as 32-bit floats
    std::string share;
    unsigned threads = 0;
};

}  // namespace reflet
