// What kernels may cost: the table limits.txt, one kernel a line.
#pragma once

#include "gpu_compilers/recorder.h"

#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace reflet::gpu_compilers {

struct KernelCost {
    uint64_t vgprs = 0;         ///< vector registers, for each lane
    uint64_t sgprs = 0;         ///< scalar registers
    uint64_t occupancy = 0;     ///< waves that a SIMD unit holds at once, as the driver counts them
    uint64_t instructions = 0;  ///< in all
    uint64_t innerLoop = 0;     ///< instructions of the largest loop that holds no other
};

struct Limits {
    std::string driver;  ///< that they were measured with
    std::map<std::string, KernelCost> kernels;
};

/// Kernels with fewer instructions are not in the table: what they cost is their bytes.
inline constexpr uint64_t leastInstructions = 250;

KernelCost costOf(const Kernel& kernel);

/// Throws Error if the file cannot be read.
Limits readLimits(const std::filesystem::path& file);
void writeLimits(const std::filesystem::path& file, const Limits& limits);

/// A line for each thing that costs more than the limits and `tolerance` (0.05: 5 %) allow, and for each kernel that
/// is in only one of the two.
std::vector<std::string> exceeded(const Limits& limits, const std::map<std::string, Kernel>& kernels, double tolerance);

}  // namespace reflet::gpu_compilers
