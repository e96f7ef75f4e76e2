// Runs the program again and again, each time with another Vulkan call that fails, and checks how it takes that.
#pragma once

#include "cli/program.h"
#include "fault/faults.h"

#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <string>
#include <vector>

namespace reflet::fault {

/// Variables of a process that runs with the layer.
Variables layerEnvironment(const std::filesystem::path& report, const std::string& fault);

/// What the layer reported.
struct Report {
    std::map<std::string, uint64_t> calls;  ///< by function
    bool hit = false;                       ///< the fault was made
    bool ended = false;                     ///< the process ended in the ordinary way
    std::string complaints;                 ///< leaked objects and misuse
};
Report readReport(const std::filesystem::path& report);

/// "vkAllocateMemory:3:VK_ERROR_OUT_OF_DEVICE_MEMORY"
std::string textOf(const Fault& fault);
/// What a message about the result has to say.
std::string wordsOf(VkResult result);

/// Faults for these calls: one for each function, the calls and errors of which are spread. With REFLET_FAULT_ALL=N
/// each error of the first, the last and N calls in between of each function.
std::vector<Fault> plan(const std::map<std::string, uint64_t>& calls);

/// What a swept command does and writes.
struct Command {
    std::string name;  ///< in the summary
    std::function<Outcome(const Variables&)> run;
    std::filesystem::path folder;      ///< that it runs in
    std::vector<std::string> outputs;  ///< files that it writes there
    std::vector<std::string> few;      ///< all faults to make without REFLET_FAULT_ALL; empty: as plan() says
};

/// Runs the command without a fault, then with each of those planned, and expects each time: status 0 or 1, one line
/// that says what failed, old or whole output files and no others, no leaked objects. Prints a table.
void sweep(const Command& command);

}  // namespace reflet::fault
