// Run by the build: writes the masks of blue_noise.h as numbers for a C++ array. make_blue_noise FILE
#include "noise/blue_noise.h"
#include "noise/void_and_cluster.h"

#include <cstdio>

namespace {

// A rank as the middle of its share of 0 to 65535.
uint32_t fractionOf(uint32_t rank) {
    constexpr uint32_t share = 65536 / (reflet::blueNoiseSide * reflet::blueNoiseSide);
    return rank * share + share / 2;
}

}  // namespace

int main(int argc, char** argv) {
    std::FILE* file = argc == 2 ? std::fopen(argv[1], "w") : nullptr;
    if (file == nullptr) {
        std::fputs("make_blue_noise: wants one file that it can write to\n", stderr);
        return 1;
    }
    const auto low = reflet::voidAndClusterRanks(reflet::blueNoiseSide, reflet::blueNoiseSlices, 1);
    const auto high = reflet::voidAndClusterRanks(reflet::blueNoiseSide, reflet::blueNoiseSlices, 2);
    for (size_t i = 0; i < low.size(); ++i) {
        std::fprintf(file, "0x%08xU,%c", fractionOf(low[i]) | fractionOf(high[i]) << 16U, i % 8 == 7 ? '\n' : ' ');
    }
    const bool written = std::ferror(file) == 0;
    return std::fclose(file) == 0 && written ? 0 : 1;
}
