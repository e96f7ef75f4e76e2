// The inputs that fuzzing starts from, all made by our own code.
#pragma once

#include <string>
#include <vector>

namespace reflet::fuzz {

struct Seed {
    std::string target;  ///< as its libFuzzer program is called, without "fuzz_"
    std::string name;
    std::string bytes;
};

/// Of the targets that read scenes and images.
std::vector<Seed> sceneSeeds();
/// Of the targets that read settings, records and states.
std::vector<Seed> stateSeeds();
/// Of the target of the C API.
std::vector<Seed> apiSeeds();

}  // namespace reflet::fuzz
