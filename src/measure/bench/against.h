// Benchmarks another build of the program against this one: runs both as separate processes, alternately.
#pragma once

#include "measure/bench/work.h"

#include <cstdint>
#include <string>
#include <vector>

namespace reflet {

struct AgainstPlan {
    std::string other;                ///< the other program
    uint32_t rounds = 5;              ///< runs of each program
    std::vector<std::string> scenes;  ///< as typed
    std::vector<uvec2> sizes;
    std::vector<std::vector<std::string>> variants;  ///< the options that select each: {"--preset", "fast"}
    std::vector<std::string> shared;                 ///< options that both understand: view, settings, seed, device
    uint32_t firstFrames = 5;
    uint32_t warmup = 11;
    uint32_t frames = 20;
};

/// Adds two runs and a pair for each scene, size and variant; a sample is the median of one run of a program. If the
/// other program has no `bench`, both run `render --timings`, which gives only device times of frames with history.
/// Throws Error.
void measureAgainst(const AgainstPlan& plan, BenchResult& result);

}  // namespace reflet
