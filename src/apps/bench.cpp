// `reflet bench`: what frames cost and how near to the truth they are, pass by pass, and one against the other.
#include "apps/bench/against.h"
#include "apps/bench/bandwidth.h"
#include "apps/bench/output.h"
#include "apps/bench/work.h"
#include "apps/command_line.h"
#include "apps/commands.h"
#include "apps/device_options.h"
#include "apps/show.h"
#include "base/error.h"
#include "base/file.h"

#include <algorithm>
#include <array>
#include <cstdio>
#include <memory>

namespace reflet {

namespace {

struct BenchCommand {
    SceneOptions shared;
    std::vector<std::string> scenes;
    std::vector<std::string> sizes;
    std::vector<std::string> presets;
    std::vector<std::string> variants;
    std::vector<std::pair<std::string, std::string>> pairs;
    std::string against;
    uint32_t rounds = 5;
    uint32_t firstFrames = 5;
    uint32_t warmup = 11;
    uint32_t frames = 20;
    std::string truth = "reference";
    std::string truthBounces = "1";
    bool truthVisibleOnly = true;
    uint32_t truthSamples = 256;
    std::string truthFilter = "box";
    std::string truthCache;
    std::string layer = "final";
    bool noBandwidth = false;
    uint32_t motionFrames = 0;
    float orbit = 30.0F;
    std::string device;
    bool validate = false;
    std::string json;
    std::string markdown;
    std::string plot;
};

// What the truth has.
constexpr std::array<std::string_view, 4> comparable{"final", "direct", "indirect_diffuse", "indirect_specular"};

uint32_t parseBounces(const std::string& text) {
    if (text == "unlimited") {
        return ReferenceOptions::unlimited;
    }
    uint32_t bounces = 0;
    if (!CLI::detail::lexical_cast(text, bounces)) {
        failUsage("--truth-bounces wants a number or 'unlimited', is '{}'", text);
    }
    return bounces;
}

TruthOptions truthOptions(const BenchCommand& command) {
    TruthOptions options;
    parseTruth(command.truth, options);
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
        variants.push_back({"default", loadSettings(command.shared)});
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
        BenchScene scene{source, loadScene(options), {}, command.shared.seed};
        scene.view = loadView(options, scene.scene);
        scenes.push_back(std::move(scene));
    }
    return scenes;
}

BenchPlan makePlan(const BenchCommand& command) {
    BenchPlan plan;
    plan.sizes = sizesOf(command);
    plan.truth = truthOptions(command);
    plan.variants = variantsOf(command);
    plan.pairs = pairsOf(command);
    plan.firstFrames = command.firstFrames;
    plan.warmup = command.warmup;
    plan.frames = command.frames;
    plan.layer = command.layer;
    plan.motion = {command.motionFrames, command.orbit, command.warmup};
    if (plan.motion.frames > 0 && plan.truth.kind == TruthKind::none) {
        failUsage("--motion needs a truth: --truth reference or --truth chain:RAYS");
    }
    if (std::ranges::find(comparable, plan.layer) == comparable.end()) {
        failUsage("--layer wants one of {}, is '{}'", fmt::join(comparable, ", "), plan.layer);
    }
    for (const std::string& file : {command.json, command.markdown, command.plot}) {
        if (!file.empty()) {
            const AtomicFile trial(file);  // better now than after minutes of work
        }
    }
    plan.scenes = scenesOf(command);
    return plan;
}

// What two programs are both told.
std::vector<std::string> sharedWords(const BenchCommand& command) {
    std::vector<std::string> words{"--seed", std::to_string(command.shared.seed)};
    const auto add = [&](const char* option, const std::string& value) {
        if (!value.empty()) {
            words.insert(words.end(), {option, value});
        }
    };
    add("--view-file", command.shared.viewFile);
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
        failUsage("--against and --compare do not go together: two builds, or two lists of settings");
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

void writeResults(const BenchCommand& command, const BenchHead& head, const BenchPlan& plan,
                  const BenchResult& result) {
    const std::string table = benchMarkdown(head, plan, result);
    if (!command.json.empty()) {
        writeFileAtomically(command.json, benchJson(head, plan, result));
    }
    if (!command.markdown.empty()) {
        writeFileAtomically(command.markdown, table);
    }
    if (!command.plot.empty()) {
        writeFileAtomically(command.plot, benchPlot(plan, result));
    }
    fmt::print("{}", table);
}

void bench(const BenchCommand& command, const std::string& typed) {
    BenchPlan plan = makePlan(command);
    gpu::Device device({.select = command.device, .validation = command.validate, .onMessage = printWarning});
    for (const uvec2& size : plan.sizes) {
        requireSize(device, size);
    }
    BenchHead head{REFLET_VERSION, typed, device.description().name, device.description().driver};
    if (!command.against.empty()) {
        plan.truth.kind = TruthKind::none;
        writeResults(command, head, plan, benchAgainst(command, plan));
        return;
    }
    head.bandwidth = command.noBandwidth ? 0.0 : measureBandwidth(device);
    writeResults(command, head, plan, measure(plan, device));
    if (command.validate && !device.validationMessages().empty()) {
        fail("the validation layers had {} messages", device.validationMessages().size());
    }
}

constexpr const char* footer =
    "Device time is what the device's timestamps say, pass by pass; submitted: from submission to fence, by the host's "
    "clock; wall: the whole call. 'first': frames without history, with all shaders compiled; 'steady': frames after "
    "the warm-up, errors those of frame warmup + frames + 1.\n"
    "--compare takes lists of presets and settings, 'preset:fast,trace_screen.maxSteps=32', and renders both frame by "
    "frame in turn. --against runs another build of this program and this one in turn.\n"
    "The bytes of a pass are those of all images and buffers that it binds, each once; floor: the time that moving "
    "them takes at the measured bandwidth. More: docs/bench.md\n"
    "builtin:tessellated-N is one room of N triangles (100 times a square: 100, 400, … 1000000).\n"
    "Example: reflet bench builtin:cubes builtin:cave --preset fast,quality --size 640x360 --json bench.json";

void addTimesOptions(CLI::App& command, BenchCommand& options) {
    command.add_option("--first", options.firstFrames, "Measured frames without history")
        ->check(CLI::Range(0U, 100000U))
        ->capture_default_str();
    command.add_option("--warmup", options.warmup, "Frames between the last one without history and the measured ones")
        ->check(CLI::Range(0U, 1000000U))
        ->capture_default_str();
    command.add_option("--frames", options.frames, "Measured frames with history")
        ->check(CLI::Range(1U, 1000000U))
        ->capture_default_str();
    command.add_option("--motion", options.motionFrames, "Frames that are compared while the camera turns; 0: none")
        ->check(CLI::Range(0U, 100000U))
        ->capture_default_str();
    command.add_option("--orbit", options.orbit, "Degrees that it turns round what it looks at, over all of them")
        ->check(CLI::Range(-360.0F, 360.0F))
        ->capture_default_str();
    command.add_option("--rounds", options.rounds, "With --against: runs of each program")
        ->check(CLI::Range(1U, 1000U))
        ->capture_default_str();
    command.add_flag("--no-bandwidth", options.noBandwidth, "Do not measure the device's bandwidth; no floors then");
}

void addTruthOptions(CLI::App& command, BenchCommand& options) {
    command
        .add_option("--truth", options.truth,
                    "What pictures are held against: the path tracer's, that of the same settings at so many rays with "
                    "nothing that cleans, or nothing")
        ->type_name("reference|chain:RAYS|none")
        ->capture_default_str();
    command.add_option("--truth-bounces", options.truthBounces, "Scattered rays of the path tracer's paths")
        ->type_name("N|unlimited")
        ->capture_default_str();
    command.add_flag("--truth-visible-only,!--truth-all-light", options.truthVisibleOnly,
                     "Scattered rays bring light only from points that the camera sees [on]");
    command.add_option("--truth-spp", options.truthSamples, "The path tracer's samples per pixel")
        ->check(CLI::Range(2U, 1U << 20U))
        ->capture_default_str();
    command.add_option("--truth-filter", options.truthFilter, "Where in the pixel the path tracer's samples are")
        ->check(CLI::IsMember({"box", "center"}))
        ->capture_default_str();
    command.add_option("--truth-cache", options.truthCache, "Folder that keeps truths [~/.cache/reflet/truth]")
        ->type_name("DIR");
    command.add_option("--layer", options.layer, "Which layer of light errors are of")
        ->type_name("NAME")
        ->capture_default_str();
}

void addOutputOptions(CLI::App& command, BenchCommand& options) {
    command.add_option("--json", options.json, "All numbers")->type_name("F.json");
    command.add_option("--markdown", options.markdown, "The tables, which are also printed")->type_name("F.md");
    command.add_option("--plot", options.plot, "Error against time")->type_name("F.svg");
    command.add_flag("--validate", options.validate,
                     "Run under the Vulkan validation layers; any message is a failure. Times mean nothing then");
}

}  // namespace

void addBenchCommand(CLI::App& app) {
    auto options = std::make_shared<BenchCommand>();
    CLI::App* command = app.add_subcommand("bench", "Measure what frames cost, and how near to the truth they are");
    command->add_option("SCENE", options->scenes, "A .gltf or .glb file, or builtin:NAME; may be several")->required();
    command->add_option("--preset", options->presets, "Presets to measure (reflet list presets)")
        ->type_name("P,Q,...")
        ->allow_extra_args(false)
        ->delimiter(',');
    command->add_option("--variant", options->variants, "Settings to measure under a name; may be repeated")
        ->type_name("NAME=[PRESET,]KEY=VALUE,...")
        ->allow_extra_args(false);
    command->add_option("--compare", options->pairs, "Two lists of presets and settings, in turn; may be repeated")
        ->type_name("A B")
        ->allow_extra_args(false);
    command->add_option("--against", options->against, "Another build of this program, in turn with this one")
        ->type_name("PROGRAM");
    addViewOptions(*command, options->shared);
    command->add_option("--sizes", options->sizes, "Several sizes, for cost per pixel; in the place of --size")
        ->type_name("WxH,WxH,...")
        ->allow_extra_args(false)
        ->delimiter(',');
    addTimesOptions(*command, *options);
    addTruthOptions(*command, *options);
    addDeviceOption(*command, options->device);
    addOutputOptions(*command, *options);
    command->footer(footer);
    command->callback([options, command] { bench(*options, commandLine(*command)); });
}

}  // namespace reflet
