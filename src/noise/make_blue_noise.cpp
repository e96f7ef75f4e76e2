// Run by the build: make_blue_noise FILE writes the masks of blue_noise.h as the elements of a C++ array.
#include "noise/blue_noise.h"
#include "noise/void_and_cluster.h"

#include <cstdio>

namespace {

// Maps a rank to the centre of its interval of 0 to 65535.
uint32_t fractionOf(uint32_t rank) {
    constexpr uint32_t share = 65536 / (reflet::blueNoiseSide * reflet::blueNoiseSide);
    return rank * share + share / 2;
}

}  // namespace

int main(int argc, char** argv) {
    std::FILE* file = argc == 2 ? std::fopen(argv[1], "w") : nullptr;
    if (file == nullptr) {
        std::fputs("make_blue_noise: needs one argument, a file that can be written\n", stderr);
        return 1;
    }
    const auto low = reflet::voidAndClusterRanks(reflet::blueNoiseSide, 1);
    const auto high = reflet::voidAndClusterRanks(reflet::blueNoiseSide, 2);
    for (size_t i = 0; i < low.size(); ++i) {
        std::fprintf(file, "0x%08xU,%c", fractionOf(low[i]) | fractionOf(high[i]) << 16U, i % 8 == 7 ? '\n' : ' ');
    }
    const bool written = std::ferror(file) == 0;
    return std::fclose(file) == 0 && written ? 0 : 1;
}
