// Sweeps faults over a command.
#include "fault/sweep.h"

#include "base/error.h"
#include "base/file.h"
#include "base/json_text.h"
#include "fault/effort.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <fstream>
#include <random>
#include <set>

namespace reflet::fault {

namespace fs = std::filesystem;

namespace {

constexpr const char* oldContent = "old";

struct Tally {
    uint64_t calls = 0;
    int faults = 0;
    int refused = 0;
    int recovered = 0;
    int missed = 0;  ///< faults that were not made: the call did not happen this time
    int wrong = 0;
};

// The error of the call: in turn, so that a few faults have different ones.
VkResult errorOf(const FunctionInfo& info, size_t turn) {
    const auto count = static_cast<size_t>(std::ranges::find(info.errors, VK_SUCCESS) - info.errors.begin());
    return info.errors.at(turn % count);
}

std::vector<uint64_t> chosenCalls(uint64_t count, uint64_t most) {
    std::set<uint64_t> chosen{1, count};
    std::minstd_rand random(static_cast<unsigned>(count));
    if (most + 2 >= count) {
        for (uint64_t call = 1; call <= count; ++call) {
            chosen.insert(call);
        }
    }
    while (chosen.size() < std::min(most + 2, count)) {
        chosen.insert(1 + random() % count);
    }
    return {chosen.begin(), chosen.end()};
}

// Whether an output is what it was before, or complete.
bool isOldOrWhole(const fs::path& file) {
    try {
        const std::string content = readFile(file);
        if (content == oldContent) {
            return true;
        }
        const std::string kind = file.extension().string();
        if (kind == ".png") {
            return readBitmap(file).width > 0;
        }
        if (kind == ".exr") {
            return !readExr(file).empty();
        }
        return kind == ".json" ? !parseJson(content).is_null() : content.ends_with("\n");
    } catch (const std::exception&) {
        return false;
    }
}

std::string wrongFiles(const Command& command) {
    for (const auto& entry : fs::directory_iterator(command.folder)) {
        const std::string name = entry.path().filename().string();
        const bool isOutput = std::ranges::find(command.outputs, name) != command.outputs.end();
        if (entry.is_regular_file() && !isOutput) {
            return "left the file " + name;
        }
    }
    for (const std::string& output : command.outputs) {
        if (!isOldOrWhole(command.folder / output)) {
            return output + " is neither old nor whole";
        }
    }
    return "";
}

void resetFiles(const Command& command) {
    for (const std::string& output : command.outputs) {
        std::ofstream(command.folder / output) << oldContent;
    }
}

// Empty if all is well.
std::string wrongEnd(const Command& command, const Outcome& outcome, const Report& report, const Fault& fault) {
    if (!report.ended) {
        return "did not end in the ordinary way";
    }
    if (!report.complaints.empty()) {
        return report.complaints;
    }
    if (outcome.status != 0 && outcome.status != 1) {
        return "status " + std::to_string(outcome.status);
    }
    if (std::string files = wrongFiles(command); !files.empty()) {
        return files;
    }
    if (outcome.status == 0) {
        const bool written = std::ranges::all_of(
            command.outputs, [&](const std::string& file) { return readFile(command.folder / file) != oldContent; });
        return written ? "" : "succeeded without writing its files";
    }
    const std::string line = outcome.err.substr(outcome.err.rfind('\n', outcome.err.size() - 2) + 1);
    const bool says = line.starts_with("reflet: ") && line.find("internal error") == std::string::npos &&
                      line.find(wordsOf(fault.result)) != std::string::npos;
    return says ? "" : "does not say what failed";
}

void printTable(const std::string& name, const std::map<std::string, Tally>& tallies) {
    Tally sum;
    std::printf("%-44s %6s %6s %8s %10s %7s %6s\n", name.c_str(), "calls", "faults", "status 1", "recovered", "missed",
                "wrong");
    const auto row = [](const std::string& first, const Tally& t) {
        std::printf("%-44s %6d %6d %8d %10d %7d %6d\n", first.c_str(), static_cast<int>(t.calls), t.faults, t.refused,
                    t.recovered, t.missed, t.wrong);
    };
    for (const auto& [function, t] : tallies) {
        row("  " + function, t);
        sum = {sum.calls + t.calls,         sum.faults + t.faults, sum.refused + t.refused,
               sum.recovered + t.recovered, sum.missed + t.missed, sum.wrong + t.wrong};
    }
    row("  all", sum);
}

}  // namespace

Variables layerEnvironment(const fs::path& report, const std::string& fault) {
    return {{"VK_INSTANCE_LAYERS", "VK_LAYER_REFLET_fault"},
            {"VK_LAYER_PATH", REFLET_FAULT_LAYER_FOLDER},
            {"REFLET_FAULT", fault},
            {"REFLET_FAULT_REPORT", report.string()}};
}

Report readReport(const fs::path& report) {
    Report read;
    std::ifstream file(report);
    for (std::string line; std::getline(file, line);) {
        std::istringstream words(line);
        std::string kind;
        std::string function;
        words >> kind >> function;
        if (kind == "count") {
            words >> read.calls[function];
        } else if (kind == "hit") {
            read.hit = true;
        } else if (kind == "end") {
            read.ended = true;
        } else {
            read.complaints += (read.complaints.empty() ? "" : "; ") + line;
        }
    }
    return read;
}

std::string textOf(const Fault& fault) {
    const auto result = std::ranges::find(resultNames, fault.result, &ResultName::result);
    return std::string(functions.at(fault.function).name) + ":" + std::to_string(fault.call) +
           (fault.always ? "+:" : ":") + result->name;
}

std::string wordsOf(VkResult result) {
    switch (result) {
        case VK_ERROR_OUT_OF_HOST_MEMORY:
            return "host memory";
        case VK_ERROR_OUT_OF_DEVICE_MEMORY:
            return "device memory";
        case VK_ERROR_DEVICE_LOST:
            return "device was lost";
        case VK_ERROR_SURFACE_LOST_KHR:
            return "surface was lost";
        default:
            return "";
    }
}

std::vector<Fault> plan(const std::map<std::string, uint64_t>& calls) {
    std::vector<Fault> faults;
    size_t turn = 0;
    for (size_t i = 0; i < functionCount; ++i) {
        const FunctionInfo& info = functions.at(i);
        const auto known = calls.find(info.name);
        if (known == calls.end()) {
            continue;
        }
        const auto function = static_cast<Function>(i);
        if (!testsAll()) {
            const uint64_t call = 1 + (turn % 3) * (known->second - 1) / 2;  // the first, a middle one, the last
            faults.push_back({function, call, errorOf(info, turn / 3 + turn), false});
            ++turn;
            continue;
        }
        for (const uint64_t call : chosenCalls(known->second, callsBetween())) {
            for (size_t e = 0; e < info.errors.size() && info.errors.at(e) != VK_SUCCESS; ++e) {
                faults.push_back({function, call, info.errors.at(e), false});
            }
        }
    }
    return faults;
}

void sweep(const Command& command) {
    const fs::path report = command.folder.string() + ".report";
    const auto run = [&](const std::string& fault) {
        fs::remove(report);
        resetFiles(command);
        return command.run(layerEnvironment(report, fault));
    };
    const Outcome plain = run("");
    const Report counted = readReport(report);
    ASSERT_EQ(plain.status, 0) << plain.err;
    ASSERT_TRUE(counted.ended && counted.complaints.empty()) << "is the layer loaded? " << counted.complaints;
    std::vector<Fault> faults = plan(counted.calls);
    if (!testsAll() && !command.few.empty()) {
        faults.clear();
        for (const std::string& fault : command.few) {
            faults.push_back(parseFault(fault).value());
        }
    }
    std::map<std::string, Tally> tallies;
    for (const Fault& fault : faults) {
        const std::string text = textOf(fault);
        Tally& tally = tallies[functions.at(fault.function).name];
        tally.calls = counted.calls.at(functions.at(fault.function).name);
        const Outcome outcome = run(text);
        const Report told = readReport(report);
        const std::string wrong = wrongEnd(command, outcome, told, fault);
        ++tally.faults;
        tally.missed += told.hit ? 0 : 1;
        tally.refused += outcome.status == 1 ? 1 : 0;
        tally.recovered += outcome.status == 0 && told.hit ? 1 : 0;
        tally.wrong += wrong.empty() ? 0 : 1;
        EXPECT_TRUE(wrong.empty()) << text << ": " << wrong << "; status " << outcome.status
                                   << ", said: " << outcome.err;
    }
    if (testsAll()) {
        printTable(command.name, tallies);
    }
    fs::remove(report);
}

}  // namespace reflet::fault
