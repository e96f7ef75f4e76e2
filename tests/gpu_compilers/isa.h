// Reads the assembly that Mesa's compiler for AMD GPUs (ACO, RDNA) prints: instructions by kind, for each loop.
#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

namespace reflet::gpu_compilers {

/// Instructions by the unit that executes them.
struct Instructions {
    uint32_t vector = 0;          ///< VALU: once for all lanes
    uint32_t transcendental = 0;  ///< VALU at a quarter of the rate: reciprocals, roots, exponentials, sines
    uint32_t scalar = 0;          ///< SALU and branches
    uint32_t loads = 0;           ///< images and buffers, without a sampler
    uint32_t samples = 0;         ///< through a sampler
    uint32_t stores = 0;
    uint32_t atomics = 0;
    uint32_t constants = 0;    ///< scalar loads
    uint32_t shared = 0;       ///< of shared memory
    uint32_t memoryWaits = 0;  ///< waits for loads and samples that were issued after the last such wait
    uint32_t sharedWaits = 0;  ///< waits for shared memory or constants

    [[nodiscard]] uint32_t sum() const {
        return vector + transcendental + scalar + loads + samples + stores + atomics + constants + shared;
    }
};

/// A loop, or (the first one) what is in none.
struct Loop {
    int parent = -1;            ///< index of the loop around it; 0: none around it; -1: this is the first one
    bool innermost = true;      ///< holds no other loop
    Instructions instructions;  ///< without those of the loops inside
};

/// Loops in the order of their first instruction; the first entry is the code outside of all loops.
std::vector<Loop> loopsOf(std::string_view assembly);

/// Instructions of the largest loop that holds no other; 0 if there are no loops.
uint32_t innerLoop(const std::vector<Loop>& loops);

}  // namespace reflet::gpu_compilers
