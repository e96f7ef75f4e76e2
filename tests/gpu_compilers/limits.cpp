// Reads, writes and applies limits.txt.
#include "gpu_compilers/limits.h"

#include "base/error.h"
#include "base/file.h"

#include <sstream>

namespace reflet::gpu_compilers {

namespace {

constexpr std::string_view heading =
    "# What the compiler for NAVI21 makes of the kernels, by tests/gpu_compilers. Made anew, after a change that is "
    "meant, by\n"
    "#     REFLET_GPU_LIMITS=write build/bin/gpu_compiler_tests\n"
    "# The test allows 5 % more, 10 % with another driver than this one. Occupancy may not fall.\n";

}  // namespace

KernelCost costOf(const Kernel& kernel) {
    const auto get = [&](const char* name) { return kernel.statistics.at(name); };
    return {get("VGPRs"), get("SGPRs"), get("Subgroups per SIMD"), get("Instructions"), innerLoop(kernel.loops)};
}

Limits readLimits(const std::filesystem::path& file) {
    Limits limits;
    std::istringstream lines(readFile(file));
    for (std::string line; std::getline(lines, line);) {
        if (line.starts_with("driver: ")) {
            limits.driver = line.substr(line.find(' ') + 1);
        } else if (!line.empty() && !line.starts_with('#') && !line.starts_with("vgprs")) {
            std::istringstream words(line);
            KernelCost cost;
            std::string name;
            words >> cost.vgprs >> cost.sgprs >> cost.occupancy >> cost.instructions >> cost.innerLoop >> std::ws;
            std::getline(words, name);
            REFLET_CHECK(!name.empty(), "{}: cannot read \"{}\"", file.string(), line);
            limits.kernels[name] = cost;
        }
    }
    return limits;
}

void writeLimits(const std::filesystem::path& file, const Limits& limits) {
    std::string text =
        fmt::format("{}driver: {}\nvgprs sgprs occupancy instructions innerLoop kernel\n", heading, limits.driver);
    for (const auto& [name, cost] : limits.kernels) {
        text += fmt::format("{:5} {:5} {:9} {:12} {:9} {}\n", cost.vgprs, cost.sgprs, cost.occupancy, cost.instructions,
                            cost.innerLoop, name);
    }
    writeFileAtomically(file, text, Lasting::no);
}

std::vector<std::string> exceeded(const Limits& limits, const std::map<std::string, Kernel>& kernels,
                                  double tolerance) {
    std::vector<std::string> lines;
    for (const auto& [name, kernel] : kernels) {
        const KernelCost cost = costOf(kernel);
        const auto known = limits.kernels.find(name);
        if (known == limits.kernels.end()) {
            if (cost.instructions >= leastInstructions) {
                lines.push_back(fmt::format("{}: not in the table", name));
            }
            continue;
        }
        const auto compare = [&, &kernelName = name](const char* what, uint64_t now, uint64_t limit) {
            if (static_cast<double>(now) > static_cast<double>(limit) * (1.0 + tolerance)) {
                lines.push_back(fmt::format("{}: {} {}, in the table {}", kernelName, now, what, limit));
            }
        };
        compare("VGPRs", cost.vgprs, known->second.vgprs);
        compare("SGPRs", cost.sgprs, known->second.sgprs);
        compare("instructions", cost.instructions, known->second.instructions);
        compare("instructions in the inner loop", cost.innerLoop, known->second.innerLoop);
        if (cost.occupancy < known->second.occupancy) {
            lines.push_back(
                fmt::format("{}: {} waves, in the table {}", name, cost.occupancy, known->second.occupancy));
        }
    }
    for (const auto& [name, cost] : limits.kernels) {
        if (!kernels.contains(name)) {
            lines.push_back(fmt::format("{}: in the table, but in none of the frames", name));
        }
    }
    return lines;
}

}  // namespace reflet::gpu_compilers
