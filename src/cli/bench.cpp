// `reflet bench`: measures the cost of frames, pass by pass, and their error against a reference; compares variants.
#include "base/error.h"
#include "base/file.h"
#include "cli/bench_motions.h"
#include "cli/bench_options.h"
#include "cli/command_line.h"
#include "cli/commands.h"
#include "cli/device_options.h"
#include "cli/output_files.h"
#include "measure/bench/against.h"
#include "measure/bench/bandwidth.h"
#include "measure/bench/output.h"
#include "measure/bench/work.h"
#include "renderer/presets.h"
#include "version.h"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <array>
#include <memory>

namespace reflet {

namespace {

// The layers of a ground truth image.
constexpr std::array<std::string_view, 4> comparable{"final", "direct", "indirect_diffuse", "indirect_specular"};

uint32_t parseBounces(const std::string& text) {
    if (text == "unlimited") {
        return ReferenceOptions::unlimited;
    }
    uint32_t bounces = 0;
    if (!CLI::detail::lexical_cast(text, bounces)) {
        failUsage("--truth-bounces must be a number or 'unlimited', is '{}'", text);
    }
    return bounces;
}

TruthOptions truthOptions(const BenchCommand& command) {
    TruthOptions options;
    parseTruth(command.truth, options);
    if (!command.truthOf.empty()) {
        if (options.kind != TruthKind::chain) {
            failUsage("--truth-of needs --truth chain:RAYS");
        }
        options.chainOf = settingsOfList(command.truthOf, command.shared, "--truth-of " + command.truthOf);
    }
    options.reference.bounces = parseBounces(command.truthBounces);
    options.reference.samples = command.truthSamples;
    options.reference.visibleOnly = command.truthVisibleOnly;
    options.reference.filter = command.truthFilter == "box" ? PixelFilter::box : PixelFilter::center;
    options.folder = command.truthCache.empty() ? standardTruthFolder() : std::filesystem::path(command.truthCache);
    return options;
}

std::vector<uvec2> sizesOf(const BenchCommand& command) {
    std::vector<uvec2> sizes;
    std::ranges::transform(command.sizes, std::back_inserter(sizes), parseSize);
    if (sizes.empty()) {
        sizes.push_back(parseSize(command.shared.size));
    }
    return sizes;
}

std::vector<Variant> variantsOf(const BenchCommand& command) {
    std::vector<Variant> variants = makeVariants(command.presets, command.variants, command.shared);
    if (variants.empty() && command.pairs.empty()) {
        variants.push_back({std::string(defaultPreset), loadSettings(command.shared)});
    }
    return variants;
}

std::vector<std::pair<Variant, Variant>> pairsOf(const BenchCommand& command) {
    std::vector<std::pair<Variant, Variant>> pairs;
    const auto variant = [&](const std::string& list) {
        return Variant{list, settingsOfList(list, command.shared, "--compare " + list)};
    };
    for (const auto& [a, b] : command.pairs) {
        pairs.emplace_back(variant(a), variant(b));
    }
    return pairs;
}

std::vector<BenchScene> scenesOf(const BenchCommand& command) {
    std::vector<BenchScene> scenes;
    for (const std::string& source : command.scenes) {
        SceneOptions options = command.shared;
        options.scene = source;
        options.size = command.sizes.empty() ? options.size : command.sizes.front();  // for a camera to be framed
        BenchScene scene{source, loadScene(options), {}, command.shared.seed};
        scene.view = loadView(options, scene.scene);
        scenes.push_back(std::move(scene));
    }
    return scenes;
}

// In ascending order, each once.
std::vector<uint32_t> stillFrames(const BenchCommand& command, TruthKind truth) {
    std::vector<uint32_t> frames = command.convergence;
    if (command.octaves) {
        frames.insert(frames.end(), {1, 8, 32, 128});
    }
    const char* option = command.octaves ? "--octaves" : "--convergence";
    if (!frames.empty() && truth == TruthKind::none) {
        failUsage("{} needs a ground truth: --truth reference or --truth chain:RAYS", option);
    }
    if (!frames.empty() && !command.against.empty()) {
        failUsage("{} and --against exclude each other: --against measures no errors", option);
    }
    std::ranges::sort(frames);
    frames.erase(std::unique(frames.begin(), frames.end()), frames.end());  // clang 14 has no std::ranges::unique
    return frames;
}

BenchPlan makePlan(const BenchCommand& command) {
    if (command.scenes.empty()) {
        failUsage("SCENE is missing: name scenes, or cases with --motions");
    }
    BenchPlan plan;
    plan.sizes = sizesOf(command);
    plan.truth = truthOptions(command);
    plan.variants = variantsOf(command);
    plan.pairs = pairsOf(command);
    plan.firstFrames = command.firstFrames;
    plan.warmup = command.warmup;
    plan.frames = command.frames;
    plan.layer = command.layer;
    plan.motion = {command.motionFrames, command.orbit, command.warmup, command.fps, command.restFrames};
    plan.stillFrames = stillFrames(command, plan.truth.kind);
    plan.plotsConvergence = !command.convergence.empty();
    if (plan.motion.frames > 0 && plan.truth.kind == TruthKind::none) {
        failUsage("--motion needs a ground truth: --truth reference or --truth chain:RAYS");
    }
    if (plan.motion.rest > 0 && plan.motion.frames == 0) {
        failUsage("--rest needs --motion N");
    }
    if (std::ranges::find(comparable, plan.layer) == comparable.end()) {
        failUsage("--layer must be one of {}, is '{}'", fmt::join(comparable, ", "), plan.layer);
    }
    InputFiles inputs = inputFiles(command.shared);
    inputs.scenes = command.scenes;
    tryOutputs({command.json, command.plot}, inputs);
    plan.scenes = scenesOf(command);
    return plan;
}

// The arguments that both programs get.
std::vector<std::string> sharedWords(const BenchCommand& command) {
    std::vector<std::string> words{"--seed", std::to_string(command.shared.seed)};
    const auto add = [&](const char* option, const std::string& value) {
        if (!value.empty()) {
            words.insert(words.end(), {option, value});
        }
    };
    add("--view-file", command.shared.viewFile);
    add("--environment", command.shared.environment);
    add("--background", command.shared.background);
    add("--camera", command.shared.camera);
    add("--scene", command.shared.sceneIndex ? std::to_string(*command.shared.sceneIndex) : "");
    add("--device", command.device);
    for (const std::string& file : command.shared.settingsFiles) {
        add("--settings", file);
    }
    for (const std::string& assignment : command.shared.set) {
        add("--set", assignment);
    }
    return words;
}

BenchResult benchAgainst(const BenchCommand& command, const BenchPlan& plan) {
    if (!command.pairs.empty()) {
        failUsage("--against and --compare exclude each other: compare two builds, or two lists of settings");
    }
    AgainstPlan against;
    against.other = command.against;
    against.rounds = command.rounds;
    against.scenes = command.scenes;
    against.sizes = plan.sizes;
    for (const std::string& preset : command.presets) {
        against.variants.push_back({"--preset", preset});
    }
    for (const std::string& variant : command.variants) {
        against.variants.push_back({"--variant", variant});
    }
    if (against.variants.empty()) {
        against.variants.emplace_back();
    }
    against.shared = sharedWords(command);
    against.firstFrames = plan.firstFrames;
    against.warmup = plan.warmup;
    against.frames = plan.frames;
    BenchResult result;
    measureAgainst(against, result);
    return result;
}

constexpr size_t terminalWidth = 120;

void writeResults(const BenchCommand& command, const BenchHead& head, const BenchPlan& plan,
                  const BenchResult& result) {
    if (!command.json.empty()) {
        writeFileAtomically(command.json, benchJson(head, plan, result));
    }
    if (!command.plot.empty()) {
        writeFileAtomically(command.plot, benchPlot(plan, result));
    }
    const std::vector<Section> document = benchDocument(head, plan, result);
    fmt::print("{}", command.markdown ? markdownOf(document) : plainTextOf(document, terminalWidth));
}

void benchScenes(const BenchCommand& command, const BenchPlan& plan, BenchHead& head, gpu::Device& device) {
    for (const uvec2& size : plan.sizes) {
        requireSize(device, size);
    }
    if (!command.against.empty()) {
        BenchPlan untrue = plan;
        untrue.truth.kind = TruthKind::none;
        writeResults(command, head, untrue, benchAgainst(command, untrue));
        return;
    }
    head.bandwidth = command.noBandwidth ? 0.0 : measureBandwidth(device);
    writeResults(command, head, plan, measure(plan, device));
}

void bench(const BenchCommand& command, const std::string& typed) {
    std::optional<BenchPlan> scenes;
    std::optional<MotionsPlan> motions;
    if (command.motions.empty()) {
        scenes = makePlan(command);
    } else {
        motions = motionsPlan(command, truthOptions(command), variantsOf(command));
    }
    gpu::Device device(programDevice(command.device, command.validate));
    BenchHead head{versionText, typed, device.description().name, device.description().driver};
    if (motions) {
        requireSize(device, motions->size);
        benchMotions(command, *motions, head, device);
    } else {
        benchScenes(command, *scenes, head, device);
    }
    if (command.validate && !device.validationMessages().empty()) {
        fail("the validation layers reported {} messages", device.validationMessages().size());
    }
}

}  // namespace

void addBenchCommand(CLI::App& app) {
    auto options = std::make_shared<BenchCommand>();
    CLI::App* command = app.add_subcommand("bench", "Measure the cost of frames and their error against a reference");
    addBenchOptions(*command, *options);
    command->callback([options, command] {
        options->hasSize = command->count("--size") > 0;
        options->hasWarmup = command->count("--warmup") > 0;
        bench(*options, commandLine(*command));
    });
}

}  // namespace reflet
