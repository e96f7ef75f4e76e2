// The plan and the results of a bench, as plain values.
#pragma once

#include "compare/compare.h"
#include "measure/bench/convergence.h"
#include "measure/bench/motion.h"
#include "measure/bench/samples.h"
#include "measure/bench/subject.h"
#include "measure/bench/truth.h"
#include "measure/variants.h"

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace reflet {

struct BenchPlan {
    std::vector<BenchScene> scenes;
    std::vector<uvec2> sizes;
    std::vector<Variant> variants;                   ///< each measured alone
    std::vector<std::pair<Variant, Variant>> pairs;  ///< each measured with alternating frames
    uint32_t firstFrames = 5;                        ///< measured frames without history
    uint32_t warmup = 11;                            ///< frames between those without history and the measured ones
    uint32_t frames = 20;                            ///< measured frames with history
    TruthOptions truth;
    MotionPlan motion;            ///< its warmup equals that of the plan
    std::string layer = "final";  ///< layer whose error is measured
    float pixelsPerDegree = 67.0F;
    std::vector<uint32_t> stillFrames;  ///< as in ConvergencePlan; empty: not measured
    bool plotsConvergence = false;      ///< whether the plot is that of the error over these frames
};

/// Measurements of one state: without history, or with the history of earlier frames.
struct BenchState {
    Samples samples;
    std::optional<Difference> error;
    std::optional<double> displayedFlip;  ///< by displayedFlip(), with the variant's tone mapping
};

struct BenchRun {
    std::string scene;
    std::string variant;
    std::string settings;  ///< settings that differ from the defaults, in the form of --set
    uvec2 size{0};
    uint64_t triangles = 0;
    uint64_t memory = 0;  ///< bytes of device memory: scene, frame and history
    BenchState first;
    BenchState steady;              ///< the error is that of frame warmup + frames + 1
    std::vector<StillError> still;  ///< errors at the plan's stillFrames
    std::optional<MotionResult> motion;
    std::string truthFile;
    double truthNoise = 0.0;
    uint32_t truthSamples = 0;
};

/// Two runs whose frames alternated.
struct BenchPair {
    size_t a = 0;  ///< index into BenchResult::runs
    size_t b = 0;
};

struct BenchResult {
    std::vector<BenchRun> runs;
    std::vector<BenchPair> pairs;
};

/// Shows progress. Throws Error.
BenchResult measure(const BenchPlan& plan, gpu::Device& device);

}  // namespace reflet
