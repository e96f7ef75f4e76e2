#include "cli/bench_motions.h"

#include "base/error.h"
#include "base/file.h"
#include "cli/output_files.h"
#include "measure/motions/output.h"

#include <fmt/format.h>

#include <filesystem>

namespace reflet {

namespace {

constexpr size_t tableWidth = 120;

void writeStrips(const std::string& folder, const MotionsPlan& plan, const MotionsResult& result) {
    for (size_t i = 0; i < plan.cases.size(); ++i) {
        writePng(std::filesystem::path(folder) / fmt::format("{}.png", plan.cases[i].name),
                 motionsStrip(plan, result, i));
    }
}

}  // namespace

MotionsPlan motionsPlan(const BenchCommand& command, TruthOptions truth, std::vector<Variant> variants) {
    if (!command.scenes.empty()) {
        failUsage("--motions has scenes of its own: leave '{}' out", command.scenes.front());
    }
    if (!command.pairs.empty() || !command.against.empty() || command.motionFrames > 0 || !command.plot.empty() ||
        !command.sizes.empty()) {
        failUsage("--motions excludes --compare, --against, --motion, --plot and --sizes");
    }
    if (truth.kind != TruthKind::reference) {
        failUsage("--motions needs --truth reference");
    }
    MotionsPlan plan;
    plan.cases = findMotionCases(command.motions);
    plan.variants = std::move(variants);
    plan.seed = command.shared.seed;
    plan.truth = std::move(truth);
    plan.strips = !command.strips.empty();
    if (command.hasSize) {
        plan.size = parseSize(command.shared.size);
    }
    if (command.hasWarmup) {
        plan.settle = command.warmup;
    }
    tryOutputs({command.json}, inputFiles(command.shared));
    return plan;
}

void benchMotions(const BenchCommand& command, const MotionsPlan& plan, const BenchHead& head, gpu::Device& device) {
    const MotionsResult result = measureMotions(plan, device);
    if (!command.json.empty()) {
        writeFileAtomically(command.json, motionsJson(head, plan, result));
    }
    if (plan.strips) {
        writeStrips(command.strips, plan, result);
    }
    const std::vector<Section> document = motionsDocument(head, plan, result);
    fmt::print("{}", command.markdown ? markdownOf(document) : plainTextOf(document, tableWidth));
}

}  // namespace reflet
