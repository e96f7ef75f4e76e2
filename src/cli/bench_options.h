// The command line of `reflet bench`.
#pragma once

#include "job/scene_options.h"

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace CLI {
class App;
}  // namespace CLI

namespace reflet {

/// The options as typed.
struct BenchCommand {
    SceneOptions shared;
    std::vector<std::string> scenes;
    std::vector<std::string> sizes;
    std::vector<std::string> presets;
    std::vector<std::string> variants;
    std::vector<std::pair<std::string, std::string>> pairs;
    std::string against;
    uint32_t rounds = 5;
    uint32_t firstFrames = 5;
    uint32_t warmup = 11;
    uint32_t frames = 20;
    std::string truth = "reference";
    std::string truthOf;
    std::string truthBounces = "unlimited";
    bool truthVisibleOnly = false;
    uint32_t truthSamples = 256;
    std::string truthFilter = "box";
    std::string truthCache;
    std::string layer = "final";
    bool noBandwidth = false;
    uint32_t motionFrames = 0;
    float orbit = 30.0F;
    float fps = 24.0F;
    uint32_t restFrames = 0;
    bool octaves = false;
    std::vector<uint32_t> convergence;
    std::vector<std::string> motions;  ///< names of cases; empty: scenes are measured
    std::string strips;                ///< folder
    bool hasSize = false;              ///< --size was given
    bool hasWarmup = false;            ///< --warmup was given
    std::string device;
    bool validate = false;
    std::string json;
    bool markdown = false;
    std::string plot;
};

void addBenchOptions(CLI::App& command, BenchCommand& options);

}  // namespace reflet
