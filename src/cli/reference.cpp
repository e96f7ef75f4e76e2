// `reflet reference`: path traces a reference image on the CPU.
#include "reference/reference.h"
#include "base/error.h"
#include "base/interrupt.h"
#include "base/progress.h"
#include "base/text.h"
#include "capture/pictures.h"
#include "capture/show.h"
#include "cli/commands.h"
#include "cli/output_files.h"
#include "cli/scene_arguments.h"
#include "cli/sequence_arguments.h"
#include "effects/exposure/exposure.h"
#include "job/sequence_files.h"
#include "job/sequence_plan.h"
#include "job/sequence_record.h"
#include "job/sequence_views.h"
#include "reference/sample_progress.h"
#include "renderer/background/background.h"
#include "renderer/exposure/scene_exposure.h"

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <memory>
#include <new>

namespace reflet {

namespace {

struct ReferenceCommand {
    SceneOptions scene;
    std::vector<std::string> outputs;
    uint32_t frames = 1;
    SequenceOptions sequence;
    std::optional<uint32_t> bounces;
    std::optional<uint32_t> samples;
    float noise = 0.0F;
    std::string filter = "box";
    std::string sampling = "cosine";
    bool visibleOnly = false;
    bool pinhole = false;
    std::vector<std::string> layers;
    std::optional<float> aoRadius;
    std::optional<float> aoFalloff;
    unsigned threads = 0;
};

constexpr uint32_t standardSamples = 64;
constexpr uint32_t largestSide = 65536;  // pixels; EXR files that are larger cannot be read

void checkNumbers(const ReferenceCommand& command, uvec2 size) {
    if (size.x > largestSide || size.y > largestSide) {
        failUsage("--size {}: the image can have up to {} pixels a side", command.scene.size, largestSide);
    }
    const auto isNan = [](const std::optional<float>& number) { return number && std::isnan(*number); };
    if (isNan(command.aoRadius) || isNan(command.aoFalloff)) {  // which no range refuses
        failUsage("{} must be a number, is 'nan'", isNan(command.aoRadius) ? "--ao-radius" : "--ao-falloff");
    }
    if (std::isnan(command.noise)) {
        failUsage("--noise must be a number, is '{}'", command.noise);
    }
}

bool asksFor(const ReferenceCommand& command, std::string_view layer) {
    return std::ranges::find(command.layers, layer) != command.layers.end();
}

// Whether the layer needs more than the first surface.
bool carriesBounces(std::string_view layer) {
    return layer == "final" || layer == "indirect_diffuse" || layer == "indirect_specular";
}

constexpr std::array<std::string_view, 9> layerNames{
    "final",  "direct", "indirect_diffuse", "indirect_specular", "albedo",
    "normal", "depth",  "sun_visibility",   "ambient_occlusion"};

void checkLayers(const ReferenceCommand& command) {
    for (const std::string& layer : command.layers) {
        if (std::ranges::find(layerNames, layer) == layerNames.end()) {
            const std::vector<std::string> names(layerNames.begin(), layerNames.end());
            failUsage("--layers: there is no layer '{}'{}; there are: {}", layer, suggestion(layer, names),
                      fmt::join(names, ", "));
        }
        if (std::ranges::count(command.layers, layer) > 1) {
            failUsage("--layers: '{}' is named twice", layer);
        }
    }
    if ((command.aoRadius || command.aoFalloff) && !asksFor(command, "ambient_occlusion")) {
        failUsage("--ao-radius and --ao-falloff are for the layer ambient_occlusion: add --layers ambient_occlusion");
    }
}

ReferenceOptions referenceOptions(const ReferenceCommand& command, const Settings& settings) {
    ReferenceOptions options;
    options.bounces = command.bounces.value_or(ReferenceOptions::unlimited);
    options.samples = command.samples.value_or(command.noise > 0.0F ? largestSamples : standardSamples);
    options.noise = command.noise;
    options.filter = command.filter == "box" ? PixelFilter::box : PixelFilter::center;
    options.diffuse = command.sampling == "cosine" ? DiffuseSampling::cosine : DiffuseSampling::uniform;
    options.visibleOnly = command.visibleOnly;
    options.pinhole = command.pinhole;
    options.lambertOnly = settings.materials.lambertOnly != 0;
    options.ambientOcclusion = asksFor(command, "ambient_occlusion");
    options.aoRadius = command.aoRadius.value_or(options.aoRadius);
    options.aoFalloff = command.aoFalloff.value_or(options.aoFalloff);
    if (!command.layers.empty() && std::ranges::none_of(command.layers, carriesBounces)) {
        options.bounces = 0;
    }
    options.seed = command.scene.seed;
    options.threads = command.threads;
    return options;
}

/// What is traced, and how.
struct Job {
    const ReferenceCommand& command;
    const Settings& settings;
    const ReferenceOptions& options;
    const Scene& scene;
    const View& view;
    uvec2 size;
};

ReferencePicture tracePicture(const Job& job, const View& view, uint32_t seed,
                              const std::function<void(const ReferenceProgress&)>& show) {
    ReferenceOptions options = job.options;
    options.seed = seed;
    try {
        return traceReference(job.scene, view, job.size, options, [&](const ReferenceProgress& now) {
            show(now);
            return !InterruptNote::arrived();
        });
    } catch (const std::bad_alloc&) {
        fail("not enough memory for an image of {}x{} pixels: choose a smaller --size", job.size.x, job.size.y);
    }
}

bool wasInterrupted(const Job& job, const ReferencePicture& picture) {
    return !picture.complete && picture.samples < job.options.samples;
}

// Those that are asked for, in that order, and first an unnamed copy of the first, which every viewer shows.
std::vector<ImageLayer> chosenLayers(const ReferencePicture& picture, const ReferenceCommand& command) {
    std::vector<ImageLayer> all = picture.layers();
    if (command.layers.empty()) {
        return all;
    }
    std::vector<ImageLayer> chosen;
    for (const std::string& name : command.layers) {
        const auto found = std::ranges::find(all, name, &ImageLayer::name);
        if (chosen.empty()) {
            chosen.push_back({"", found->image});
        }
        chosen.push_back(*found);
    }
    return chosen;
}

std::vector<ImageLayer> layersOf(const ReferencePicture& picture, const ReferenceCommand& command,
                                 const Background& background) {
    std::vector<ImageLayer> layers = chosenLayers(picture, command);
    const bool showsFinal = command.layers.empty() || command.layers.front() == "final";
    for (ImageLayer& layer : layers) {
        if (background.needsCoverage() && ((layer.name.empty() && showsFinal) || layer.name == "final")) {
            layer.image = withAlpha(layer.image, picture.coverage);
        }
    }
    return layers;
}

void writePicture(const Job& job, const std::string& file, const ReferencePicture& picture,
                  const TonemapSettings& tonemap) {
    const Background& background = job.view.background;
    const std::vector<std::string>& layers = job.command.layers;
    if (isExr(file)) {
        writeExr(file, layersOf(picture, job.command, background));
    } else if (!layers.empty() && layers.front() != "final") {
        writePng(file, makePicture(findShow(layers.front()), chosenLayers(picture, job.command).front().image));
    } else {
        writePng(file, displayedOver(picture.final, picture.coverage, background, tonemap));
    }
}

std::string raysText(uint64_t rays, double seconds) {
    constexpr double million = 1e6;
    const double millions = static_cast<double>(rays) / million;
    return fmt::format("{:.2f} million rays in {:.2f} s: {:.2f} million rays per second", millions, seconds,
                       millions / std::max(seconds, 1.0 / million));
}

std::string summary(const ReferencePicture& picture) {
    return fmt::format(
        "{}, noise {}; {}",
        picture.samples == 1 ? "1 sample per pixel" : fmt::format("{} samples per pixel", picture.samples),
        picture.samples == 1 ? "unknown" : fmt::format("{:.3g}", picture.noise),
        raysText(picture.rays, picture.seconds));
}

void traceOne(const Job& job) {
    const InterruptNote note;
    SampleProgress progress("tracing", job.options, job.size);
    const ReferencePicture picture =
        tracePicture(job, job.view, job.options.seed, [&](const ReferenceProgress& now) { progress.set(now); });
    const TonemapSettings tonemap = exposedAs(job.settings.tonemap, job.scene, picture.final, picture.depth);
    for (const std::string& file : job.command.outputs) {
        writePicture(job, file, picture, tonemap);
    }
    if (wasInterrupted(job, picture)) {
        fail("interrupted after {} of {} samples per pixel; {} {} the samples so far", picture.samples,
             job.options.samples, fmt::join(job.command.outputs, ", "),
             job.command.outputs.size() == 1 ? "holds" : "hold");
    }
    fmt::print("{}{}\n", summary(picture),
               exposesAutomatically(job.settings.tonemap, job.scene)
                   ? fmt::format("; exposure {:+.2f} stops", tonemap.exposure)
                   : "");
}

// Everything that the images depend on: equal in all shares and, except for an orbit, for any number of frames.
nlohmann::ordered_json makeRecord(const Job& job, const FrameNames& names) {
    const ReferenceCommand& c = job.command;
    const ReferenceOptions& o = job.options;
    nlohmann::ordered_json record = commonRecord(c.scene, c.sequence, c.frames, job.view);
    record["reference"] = {{"samples", o.samples},   {"noise", o.noise},
                           {"bounces", o.bounces},   {"filter", c.filter},
                           {"sampling", c.sampling}, {"visible_only", o.visibleOnly},
                           {"pinhole", o.pinhole},   {"lambert_only", o.lambertOnly},
                           {"layers", c.layers}};
    if (o.ambientOcclusion) {
        record["reference"]["ao"] = {o.aoRadius, o.aoFalloff};
    }
    if (!isExr(names.pattern())) {
        for (const SettingEntry& entry : settingEntries()) {
            if (entry.name.starts_with("tonemap.")) {
                record["settings"][entry.name] = settingText(job.settings, entry);
            }
        }
    }
    return record;
}

// Every frame has other noise, which depends on its number alone; the first has that of a single image.
uint32_t frameSeed(uint32_t seed, uint32_t frame) {
    return seed + frame * 0x9E3779B9U;  // odd: no two frames share a seed
}

void traceSequence(const Job& job) {
    const InterruptNote note;
    const ReferenceCommand& c = job.command;
    const SequenceViews views(job.view, job.scene, c.sequence, c.frames);
    const SequenceFiles files(c.outputs, c.sequence.firstFrame);
    for (const FrameNames& names : files.names()) {
        beginSequence(names, makeRecord(job, names), c.sequence.overwrite, printWarning);
    }
    const SequencePlan plan{.frames = c.frames};
    const auto runs = plan.runs(parseShare(c.sequence.share), [&](uint32_t frame) { return files.isMissing(frame); });
    Progress progress("tracing frame", plan.work(runs));
    uint32_t traced = 0;
    uint64_t rays = 0;
    double seconds = 0.0;
    for (const SequencePlan::Run& run : runs) {
        const auto missing = files.missing(run.begin);  // another process may have made some in the meantime
        if (!missing.empty()) {
            const ReferencePicture picture =
                tracePicture(job, views.of(run.begin), frameSeed(job.options.seed, run.begin), [](const auto&) {});
            if (wasInterrupted(job, picture)) {
                fail("interrupted after {} frames; run the same command again to continue", traced);
            }
            const TonemapSettings tonemap = exposedAs(job.settings.tonemap, job.scene, picture.final, picture.depth);
            for (const auto& file : missing) {
                writePicture(job, file.string(), picture, tonemap);
            }
            ++traced;
            rays += picture.rays;
            seconds += picture.seconds;
        }
        progress.advance();
    }
    fmt::print("{} of {} frames traced; {}\n", traced, c.frames, raysText(rays, seconds));
}

void trace(const ReferenceCommand& command) {
    const uvec2 size = parseSize(command.scene.size);
    checkNumbers(command, size);
    checkLayers(command);
    const Settings settings = loadSettings(command.scene);
    const ReferenceOptions options = referenceOptions(command, settings);
    checkOutputs(command.outputs, inputFiles(command.scene, {command.sequence.path}), "reference");
    const bool sequence = isSequence(command.outputs, command.sequence, command.frames);
    const Scene scene = loadScene(command.scene);
    const View view = loadView(command.scene, scene);
    const Job job{command, settings, options, scene, view, size};
    if (sequence) {
        traceSequence(job);
    } else {
        traceOne(job);
    }
}

constexpr const char* referenceFooter =
    "The EXR has the layers final (also without a name, for viewers), direct, indirect_diffuse, indirect_specular,\n"
    "albedo, normal, depth and sun_visibility, named as in `reflet render --aov`. Direct light is what reaches a\n"
    "surface straight from the sun and lamps, plus emission and background. Light from emissive surfaces and from the\n"
    "environment is indirect and arrives through scattered rays, as in the renderer. Rays do not see the sun and "
    "lamps.\n"
    "Depth and normal are those of the pixel's centre, through a pinhole.\n"
    "A camera with an aperture is a thin lens; --visible-only tests what its centre sees.\n"
    "ambient_occlusion is the cosine-weighted share of directions without a surface within --ao-radius, as `--show\n"
    "ambient_occlusion` of the renderer estimates it; with --visible-only, surfaces that the camera does not see do "
    "not\n"
    "count.\n"
    "With both --spp and --noise, rendering stops at whichever is reached first.\n"
    "Noise is the square root of the mean over the pixels of (variance of the mean) / (luminance² + 0.01). Its square\n"
    "estimates the image's own relative MSE.\n"
    "Of the settings, only materials.lambert_only and (for PNG) tonemap.* apply.\n"
    "An interrupt (Ctrl-C) writes the samples so far, at least one per pixel, and exits with status 1; a second one\n"
    "exits at once. Of a sequence it keeps the frames that are done; run the same command again to continue.\n"
    "Example: reflet reference builtin:cubes --size 640x360 --spp 256 -o reference.exr\n"
    "reflet reference scene.glb --frames 96 --path orbit --noise 0.02 -o clean_####.exr";

}  // namespace

void addReferenceCommand(CLI::App& app) {
    auto options = std::make_shared<ReferenceCommand>();
    CLI::App* command = app.add_subcommand("reference", "Path trace a scene on the CPU: the ground truth");
    addSceneOptions(*command, options->scene);
    command
        ->add_option(
            "-o,--output", options->outputs,
            "Output image, .exr or .png; may be repeated. With a run of #, as in clean_####.exr, every frame is "
            "written to the file of its number, and existing files are kept")
        ->type_name("FILE")
        ->allow_extra_args(false);
    std::vector<const CLI::Option*> sequenceOptions = addSequenceOptions(*command, options->sequence, false);
    sequenceOptions.push_back(command->add_option("--frames", options->frames, "Sequences: number of frames")
                                  ->check(CLI::Range(1U, 1000000U))
                                  ->capture_default_str());
    command->add_option("--bounces", options->bounces, "Scattered rays per path; 0: only direct light [unlimited]")
        ->type_name("N");
    command
        ->add_option("--spp", options->samples,
                     fmt::format("Maximum samples per pixel [{}; with --noise {}]", standardSamples, largestSamples))
        ->type_name("N")
        ->check(CLI::Range(1U, largestSamples));
    command->add_option("--noise", options->noise, "Stop when the noise falls below this (0.01: 1 %)")
        ->type_name("X")
        ->check(CLI::Range(0.0F, 10.0F));
    command
        ->add_option("--filter", options->filter,
                     "Pixel filter. box: samples spread over the pixel; center: at its centre only, with aliased edges "
                     "as in a rasterizer")
        ->check(CLI::IsMember({"box", "center"}))
        ->capture_default_str();
    command
        ->add_option("--sampling", options->sampling,
                     "Distribution of diffuse rays: changes the noise, not the expected image")
        ->check(CLI::IsMember({"cosine", "uniform"}))
        ->capture_default_str();
    command->add_flag("--visible-only", options->visibleOnly,
                      "Scattered rays return light only from points that the camera sees and from the environment: "
                      "the best that any screen-space method can reach");
    command->add_flag("--pinhole", options->pinhole,
                      "Ignore the camera's lens (aperture_radius or f_number of a view file): everything is sharp");
    command
        ->add_option(
            "--layers", options->layers,
            fmt::format("Layers to write, of {} [all but ambient_occlusion]; PNG: the first one. Without final "
                        "and indirect light, paths end at the first surface",
                        fmt::join(layerNames, ", ")))
        ->type_name("A,B,...")
        ->delimiter(',')
        ->allow_extra_args(false);
    command
        ->add_option("--ao-radius", options->aoRadius,
                     "Metres within which surfaces count in the layer ambient_occlusion [1], as ao.radius")
        ->type_name("R")
        ->check(CLI::Range(1e-6F, 1e9F));
    command
        ->add_option("--ao-falloff", options->aoFalloff,
                     "Share of that radius, at its end, over which they fade out [0], as ao.falloff")
        ->type_name("X")
        ->check(CLI::Range(0.0F, 1.0F));
    command->add_option("--threads", options->threads, "CPU threads, 0: one per core; the result does not depend on it")
        ->check(CLI::Range(0U, 4096U))
        ->capture_default_str();
    command->footer(referenceFooter);
    command->callback([options, sequenceOptions] {
        checkSequenceOptions(sequenceOptions, options->outputs);
        trace(*options);
    });
}

}  // namespace reflet
