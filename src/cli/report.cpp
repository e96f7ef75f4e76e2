// `reflet report`: writes a page that compares the error and time of variants.
#include "base/ascii.h"
#include "base/error.h"
#include "base/file.h"
#include "base/image_file.h"
#include "base/progress.h"
#include "cli/command_line.h"
#include "cli/commands.h"
#include "cli/device_options.h"
#include "cli/in_range.h"
#include "cli/scene_arguments.h"
#include "compare/heat_map.h"
#include "measure/report/plot.h"
#include "measure/report/scene_work.h"
#include "measure/report/text.h"
#include "reference/sample_progress.h"
#include "renderer/presets.h"
#include "renderer/renderer.h"
#include "scene/builtin.h"
#include "version.h"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <iterator>
#include <memory>

namespace reflet {

namespace {

namespace fs = std::filesystem;

constexpr uint32_t truthSamples = 256;

struct ReportCommand {
    SceneOptions shared;
    std::vector<std::string> scenes;
    std::string folder;
    std::vector<std::string> presets;
    std::vector<std::string> variants;
    std::string device;
    uint32_t frames = 32;
    std::optional<uint32_t> bounces;
    std::optional<uint32_t> samples;
    float noise = 0.0F;
};

// A built-in scene's description, if it is one, and its size: "1204 triangles, 5 materials, 2 lamps besides the sun."
std::string describe(const std::string& source, const Scene& scene) {
    size_t indices = 0;
    for (const Instance& instance : scene.instances) {
        indices += scene.meshes[instance.mesh].indices.size();
    }
    std::string facts =
        fmt::format("{}, {}, {} besides the sun.", countText(indices / 3, "triangle"),
                    countText(scene.materials.size(), "material"), countText(scene.lamps.size(), "lamp"));
    const auto all = builtinScenes();
    const auto found =
        std::ranges::find_if(all, [&](const BuiltinScene& b) { return source == fmt::format("builtin:{}", b.name); });
    if (found == all.end()) {
        return facts;
    }
    std::string what(found->description);
    what[0] = asciiUpper(what[0]);
    return fmt::format("{}. {}", what, facts);
}

std::string nameOf(const std::string& source) {
    constexpr std::string_view builtin = "builtin:";
    return source.starts_with(builtin) ? source.substr(builtin.size()) : fs::path(source).stem().string();
}

// Loads all scenes before any long work, so that a broken one fails at once.
std::vector<ReportInput> loadInputs(const ReportCommand& command) {
    std::vector<ReportInput> inputs;
    FileNames prefixes;
    for (const std::string& source : command.scenes) {
        SceneOptions options = command.shared;
        options.scene = source;
        ReportInput input{.name = nameOf(source), .source = source, .scene = loadScene(options)};
        input.view = loadView(options, input.scene);
        input.description = describe(source, input.scene);
        input.filePrefix = prefixes.take(fileNameOf(input.name));
        input.position = fmt::format("{} ({} of {})", input.name, inputs.size() + 1, command.scenes.size());
        inputs.push_back(std::move(input));
    }
    // Scenes of the same name are shown as the user typed them.
    for (ReportInput& input : inputs) {
        if (std::ranges::count(command.scenes, nameOf(input.source), nameOf) > 1) {
            input.name = input.source;
        }
    }
    return inputs;
}

ReportWork makeWork(const ReportCommand& command) {
    if (std::isnan(command.noise)) {
        failUsage("--noise must be a number, is '{}'", command.noise);
    }
    const Settings settings = loadSettings(command.shared);
    ReportWork work;
    work.folder = command.folder;
    work.size = parseSize(command.shared.size);
    work.seed = command.shared.seed;
    work.frames = command.frames;
    work.reference.bounces = command.bounces.value_or(ReferenceOptions::unlimited);
    work.reference.samples = command.samples.value_or(command.noise > 0.0F ? largestSamples : truthSamples);
    work.reference.noise = command.noise;
    work.reference.lambertOnly = settings.materials.lambertOnly != 0;
    work.reference.seed = command.shared.seed;
    work.tonemap = settings.tonemap;
    std::vector<std::string> names = command.presets;
    if (names.empty()) {
        std::ranges::transform(presets(), std::back_inserter(names), &Preset::name);
    }
    work.variants = makeVariants(names, command.variants, command.shared);
    return work;
}

void makeReportFolder(const fs::path& folder) {
    std::error_code error;
    fs::create_directories(folder, error);
    if (error) {
        fail("{}: cannot be created: {}", folder.string(), error.message());
    }
    const AtomicFile trial(folder / "index.html");  // fails now, not after minutes of work
}

// Returns the file's name.
std::string writeErrorScale(const fs::path& folder) {
    constexpr uint32_t width = 256;
    constexpr uint32_t height = 12;
    FloatImage ramp{width, height, {"Y"}, {}};
    for (uint32_t i = 0; i < width * height; ++i) {
        ramp.data.push_back(static_cast<float>(i % width) / static_cast<float>(width - 1));
    }
    writePng(folder / "error-scale.png", heatMap(ramp));
    return "error-scale.png";
}

std::string errorTimePlot(const ReportPage& page) {
    ScatterPlot plot;
    plot.title = "Every variant on every scene: left is faster, down is closer to the ground truth";
    plot.xLabel = "milliseconds per frame";
    plot.yLabel = "relative MSE against the ground truth";
    for (const ReportScene& scene : page.scenes) {
        for (const ReportVariant& variant : scene.variants) {
            plot.points.push_back({variant.name, scene.name, variant.frameMs, variant.againstTruth.relativeMse});
        }
    }
    return scatterPlot(plot);
}

void report(const ReportCommand& command, const std::string& typed) {
    const ReportWork work = makeWork(command);
    const std::vector<ReportInput> inputs = loadInputs(command);
    makeReportFolder(work.folder);
    gpu::Device device(programDevice(command.device));
    requireSize(device, work.size);

    ReportPage page;
    page.version = versionText;
    page.command = typed;
    page.device = device.description().name;
    page.size = work.size;
    page.seed = work.seed;
    page.frames = work.frames;
    page.bounces = command.bounces;
    page.errorScale = writeErrorScale(work.folder);
    FileNames names;
    for (const ReportInput& input : inputs) {
        page.scenes.push_back(workOn(work, input, device, names));
    }
    page.plotSvg = errorTimePlot(page);
    writeFileAtomically(work.folder / "report.json", reportJson(page));
    writeFileAtomically(work.folder / "table.md", reportMarkdown(page));
    writeFileAtomically(work.folder / "index.html", reportHtml(page));
    tellWritten((work.folder / "index.html").string());
}

constexpr const char* reportFooter =
    "DIR/index.html is the page; it needs neither network nor server. Beside it are its images, report.json with all "
    "numbers, and table.md.\n"
    "--set and --settings apply to all variants, on top of their presets, and to the tone mapping of the references.\n"
    "Custom variants: --variant NAME=KEY=VALUE,KEY=VALUE or, based on a preset, --variant "
    "NAME=PRESET,KEY=VALUE.\n"
    "Example: reflet report builtin:cubes scene.glb -o out --preset fast,quality --variant "
    "rays8=fast,diffuse.rays=8";

void addTruthOptions(CLI::App& command, ReportCommand& options) {
    command.add_option("--bounces", options.bounces, "Scattered rays per path of the references [unlimited]")
        ->type_name("N");
    command
        .add_option("--spp", options.samples,
                    fmt::format("Maximum samples per pixel of the references [{}; with --noise {}]", truthSamples,
                                largestSamples))
        ->type_name("N")
        ->check(inRange(2U, largestSamples));  // noise cannot be estimated from one sample
    command.add_option("--noise", options.noise, "Stop path tracing when the noise falls below this (0.01: 1 %)")
        ->type_name("X")
        ->check(inRange(0.0F, 10.0F));
}

}  // namespace

void addReportCommand(CLI::App& app) {
    auto options = std::make_shared<ReportCommand>();
    options->shared.size = "640x360";
    CLI::App* command =
        app.add_subcommand("report", "Write a web page that compares variants with the ground truth, and their times");
    command->add_option("SCENE", options->scenes, "A .gltf or .glb file, or builtin:NAME; may be several")->required();
    command->add_option("-o,--output", options->folder, "Folder for the page and its images")
        ->type_name("DIR")
        ->required();
    command->add_option("--preset", options->presets, "Presets to compare [all] (see reflet list presets)")
        ->type_name("P,Q,...")
        ->allow_extra_args(false)
        ->delimiter(',');
    command->add_option("--variant", options->variants, "Named list of settings to compare; may be repeated")
        ->type_name("NAME=[PRESET,]KEY=VALUE,...")
        ->allow_extra_args(false);
    addViewOptions(*command, options->shared);
    command->add_option("--frames", options->frames, "Frames to render per variant; the last one is shown")
        ->check(inRange(1U, 1000000U))
        ->capture_default_str();
    addTruthOptions(*command, *options);
    addDeviceOption(*command, options->device);
    command->footer(reportFooter);
    command->callback([options, command] { report(*options, commandLine(*command)); });
}

}  // namespace reflet
