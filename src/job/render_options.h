// The options of `reflet render`.
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
    uint32_t frames = 0;  ///< 0: as many as the settings need
    SequenceOptions sequence;
    std::string show = "final";
    std::vector<std::string> aovs;
    std::string device;
    std::string timings;
    bool validate = false;
};

}  // namespace reflet
