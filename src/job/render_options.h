// Options of `reflet render`: what to render, and to which files.
#pragma once

#include "job/scene_options.h"
#include "job/sequence_options.h"

#include <cstdint>
#include <string>
#include <vector>

namespace reflet {

struct RenderOptions {
    SceneOptions scene;
    std::vector<std::string> outputs;
    uint32_t frames = 0;   ///< 0: as many as the settings need
    std::string effort;    ///< effort of a still: draft, normal or high; empty: normal
    double seconds = 0.0;  ///< time limit of a still; 0: the effort's
    SequenceOptions sequence;
    std::string show = "final";
    std::vector<std::string> aovs;
    std::string device;
    std::string timings;
    bool validate = false;
};

}  // namespace reflet
