// Seeds of the target of the C API.
#include "seeds.h"

#include <random>

namespace reflet::fuzz {

// Zeros are a frame of all effects with nothing wrong; the more of the bytes are something else, the more is.
std::vector<Seed> apiSeeds() {
    std::vector<Seed> seeds;
    std::mt19937 random(5);
    for (uint32_t i = 0; i < 48; ++i) {
        std::string bytes(60 + 20 * i, '\0');
        for (char& byte : bytes) {
            byte = random() % 48 < i ? static_cast<char>(random() % 256) : '\0';
        }
        bytes[0] = static_cast<char>(random() % (i % 4 == 3 ? 256 : 240));
        seeds.push_back({"api", "calls-" + std::to_string(i), bytes});
    }
    return seeds;
}

}  // namespace reflet::fuzz
