// The options of `reflet render`.
#pragma once

#include "capture/scene_options.h"

#include <cstdint>
#include <string>
#include <vector>

namespace reflet {

/// For outputs whose name has a run of #.
struct SequenceOptions {
    uint32_t firstFrame = 0;  ///< the number in the first file's name
    double fps = 24.0;
    std::string path;       ///< of the camera: "orbit", or a JSON file
    uint32_t segment = 48;  ///< frames; 0: all
    uint32_t warmUp = 16;   ///< frames before each segment
    std::string share;      ///< "3/16"
    bool overwrite = false;
};

struct RenderOptions {
    SceneOptions scene;
    std::vector<std::string> outputs;
    uint32_t frames = 0;  ///< 0: as many as the settings need
    SequenceOptions sequence;
    std::string show = "final";
    std::vector<std::string> aovs;
    std::string device;
    std::string timings;
    bool validate = false;
};

}  // namespace reflet
