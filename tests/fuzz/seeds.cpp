// Writes the inputs that fuzzing starts from: `fuzz_seeds FOLDER` makes a folder for each target.
#include "seeds.h"
#include "base/file.h"

#include <cstdio>
#include <filesystem>

using namespace reflet;

int main(int argc, char** argv) {
    if (argc != 2) {
        std::fputs("usage: fuzz_seeds FOLDER\n", stderr);
        return 2;
    }
    const std::filesystem::path folder = argv[1];
    for (const auto& seeds : {fuzz::sceneSeeds(), fuzz::stateSeeds(), fuzz::apiSeeds()}) {
        for (const fuzz::Seed& seed : seeds) {
            std::filesystem::create_directories(folder / seed.target);
            writeFileAtomically(folder / seed.target / seed.name, seed.bytes, Lasting::no);
        }
    }
    return 0;
}
