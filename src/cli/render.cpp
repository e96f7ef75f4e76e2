// `reflet render`: renders a scene to image files.
#include "base/error.h"
#include "base/file.h"
#include "base/json_text.h"
#include "base/progress.h"
#include "cli/commands.h"
#include "cli/device_options.h"
#include "cli/in_range.h"
#include "cli/option_hints.h"
#include "cli/output_files.h"
#include "cli/scene_arguments.h"
#include "cli/script_arguments.h"
#include "cli/sequence_arguments.h"
#include "device/device.h"
#include "job/film.h"
#include "job/sequence.h"
#include "job/still.h"
#include "renderer/history.h"
#include "renderer/renderer.h"
#include "scene/pose.h"

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <memory>

namespace reflet {

namespace {

namespace fs = std::filesystem;

struct RenderCommand {
    RenderOptions options;
    ScriptOptions script;
};

double secondsSince(std::chrono::steady_clock::time_point start) {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

void checkOutputs(const RenderOptions& options, const Films& films) {
    if (films.any() && options.frames == 0) {
        failUsage("-o {}: a film has several frames: add --frames N, or make a turntable (reflet turntable --help)",
                  films.names().front());
    }
    if (options.outputs.empty() && options.timings.empty() && !options.validate) {
        failUsage("nothing to write: add -o FILE.png or -o FILE.exr (see reflet render --help)");
    }
    for (const std::string& file : options.outputs) {
        if (const auto extension = fs::path(file).extension(); extension != ".png" && extension != ".exr") {
            failUsage("-o {}: the name must end in .png or .exr, of a film in .webp, .mp4 or .webm{}", file,
                      endingHint(extension.string()));
        }
    }
    if (!options.aovs.empty() && std::ranges::none_of(options.outputs, isExr)) {
        failUsage("--aov needs an EXR output: add -o FILE.exr");
    }
    std::vector<std::string> outputs = options.outputs;
    outputs.insert(outputs.end(), {options.timings, options.scene.saveView});
    std::ranges::copy(films.names(), std::back_inserter(outputs));
    tryOutputs(outputs, inputFiles(options.scene, {options.sequence.path}));
}

// Writes the last frame.
void writePictures(const RenderJob& job) {
    for (const std::string& file : job.options.outputs) {
        job.pictures.write(file, job.renderer.frame(), posed(job.view, job.scene), job.size);
    }
}

// Renders the frames of one view and writes the last one.
void renderOne(const RenderJob& job) {
    const RenderOptions& options = job.options;
    Progress progress("rendering", options.frames);
    for (uint32_t i = 0; i < options.frames; ++i) {
        const bool last = i + 1 == options.frames;
        job.renderer.render(job.view, job.size, options.scene.seed, job.settings,
                            [&](gpu::Frame& f, const FrameImages& images) {
                                if (last) {
                                    job.pictures.request(f, images, job.settings.traceScreen.countSteps != 0);
                                }
                            });
        job.timings.add(job.renderer.frame().passTimes());
        progress.advance();
    }
    writePictures(job);
}

void writeTimings(const RenderJob& job) {
    nlohmann::ordered_json json = job.timings.json(job.device.description().name, job.size);
    if (job.settings.traceScreen.countSteps != 0) {
        const ViewParams params = makeViewParams(job.view.camera, job.size, 0, job.options.scene.seed);
        json["rays"] = job.pictures.rayStatistics(job.renderer.frame(), params);
    }
    if (const auto stops = job.pictures.autoExposure(job.renderer.frame())) {
        json["exposure"] = *stops + job.settings.tonemap.exposure;
    }
    writeFileAtomically(job.options.timings, jsonText(json, 2) + "\n");
}

uint32_t framesFor(const RenderOptions& options, const Settings& settings, const Scene& scene) {
    if (options.frames > 0) {
        return options.frames;
    }
    return isSequence(options.outputs, options.sequence, options.frames)
               ? 1
               : framesToSettle(historyUse(settings, scene), settings);
}

// What stills are lit by, and when they end.
std::string stillNote(const RenderOptions& options, const Settings& settings) {
    const bool paths = settings.traceScene.enabled != 0 && settings.traceScene.light == SceneHitLight::path;
    return fmt::format("a still, {}; {} (frames of a preset: --preset; see reflet render --help)",
                       paths ? "lit by rays through the scene, with all bounces" : "lit by the screen and probes",
                       stillLimits(options));
}

// Renders what the options ask for. Returns the number of files or frames that were written.
uint32_t renderJob(const RenderJob& job, bool sequence, bool still, std::chrono::steady_clock::time_point start) {
    if (sequence) {
        return renderSequence(job);
    }
    if (still) {
        printNote(stillNote(job.options, job.settings));
        renderStill(job, start);
        writePictures(job);
    } else {
        renderOne(job);
    }
    return 1;
}

// Names of what is written: films by their own name, not by that of their frames.
std::vector<std::string> writtenNames(const RenderOptions& options, const Films& films, uint32_t frames) {
    std::vector<std::string> names;
    for (const std::string& file : options.outputs) {
        if (!films.hasFrames(file)) {
            names.push_back(file);
        }
    }
    std::ranges::copy(films.write(options.sequence.fps, options.sequence.firstFrame, frames),
                      std::back_inserter(names));
    return names;
}

void render(const RenderCommand& command) {
    const auto start = std::chrono::steady_clock::now();
    RenderOptions options = command.options;
    const uvec2 size = parseSize(options.scene.size);
    const Films films(options.outputs, size.x, size.y);
    const bool still = isStill(options);
    if (still && options.scene.preset.empty()) {
        options.scene.preset = stillPreset(options);
    }
    Settings settings = loadSettings(options.scene);
    Pictures pictures(options.show, options.aovs);
    pictures.prepare(settings);
    checkOutputs(options, films);
    const bool sequence = isSequence(options.outputs, options.sequence, options.frames);
    const Scene scene = loadScene(options.scene);
    options.frames = still ? 0 : framesFor(options, settings, scene);
    const View view = loadView(options.scene, scene);

    gpu::Device device(programDevice(options.device, options.validate));
    requireSize(device, size);
    Renderer renderer(device, scene, printWarning);
    Timings timings(!sequence);
    const RenderJob job{options, scene, view, settings, size, device, renderer, pictures, timings};
    const uint32_t rendered = renderJob(job, sequence, still, start);
    if (!options.timings.empty() && rendered > 0) {
        writeTimings(job);
    } else if (!options.timings.empty()) {
        printWarning(fmt::format("{}: not written: all frames exist already, so none was rendered", options.timings));
    }
    const std::vector<std::string> written = writtenNames(options, films, options.frames);
    for (const std::string& file : written) {
        tellWritten(sequence ? fmt::format("{} ({} frames)", file, options.frames) : file);
    }
    printResult(command.script, {{"outputs", written},
                                 {"size", {size.x, size.y}},
                                 {"frames", sequence ? options.frames : 1},
                                 {"rendered", rendered},
                                 {"seconds", secondsSince(start)},
                                 {"device", device.description().name}});
    if (options.validate && !device.validationMessages().empty()) {
        fail("the validation layers reported {} messages", device.validationMessages().size());
    }
}

}  // namespace

void addRenderCommand(CLI::App& app) {
    auto all = std::make_shared<RenderCommand>();
    RenderOptions* options = &all->options;
    CLI::App* command = app.add_subcommand("render", "Render a scene to PNG, EXR or a film");
    addSceneOptions(*command, options->scene);
    command
        ->add_option("-o,--output", options->outputs,
                     "Output image, .png or .exr, or film of --frames, .webp, .mp4 or .webm (by ffmpeg); may be "
                     "repeated. With a run of #, as in picture_####.png, every frame is written to the file of its "
                     "number, and existing files are kept")
        ->type_name("FILE")
        ->allow_extra_args(false);
    command
        ->add_option("--frames", options->frames,
                     "Frames to render; the last one is written, or, with # in the name, all of them [1; for a single "
                     "image of a preset as many as its histories need to settle]")
        ->check(inRange(1U, 1000000U));
    command
        ->add_option(
            "--effort", options->effort,
            "Stills, pictures without --preset or --frames: draft (up to 8 s, by the preset balanced), normal (up to "
            "30 s) or high (up to 10 minutes); the end comes earlier if little noise is left [normal]")
        ->type_name("draft|normal|high");
    command->add_option("--seconds", options->seconds, "Stills: time for the picture, from the start of the program")
        ->check(inRange(0.1, 1e6))
        ->type_name("N");
    const auto sequenceOptions = addSequenceOptions(*command, options->sequence, true);
    command->add_option("--show", options->show, "Render target to write (see reflet list shows)")
        ->type_name("NAME")
        ->capture_default_str();
    command->add_option("--aov", options->aovs, "Additional render targets, as named layers of the EXR files")
        ->type_name("A,B,...")
        ->allow_extra_args(false)
        ->delimiter(',');
    addDeviceOption(*command, options->device);
    command
        ->add_option(
            "--timings", options->timings,
            "Device time of every pass: medians over the frames after the first, or over all written frames of "
            "a sequence; with trace_screen.count_steps also mean steps and hit rate of the last frame's rays")
        ->type_name("F.json");
    addScriptOptions(*command, all->script);
    command->add_flag("--validate", options->validate, "Enable the Vulkan validation layers; any message is a failure");
    command->footer(
        "Example: reflet render scene.glb --size 640x360 --set diffuse.rays=16 -o picture.png -o values.exr --aov "
        "direct,normal\nreflet render scene.glb --orbit 40,15 --fov 35 --sun -60,40 --save-view view.json -o "
        "picture.png\n"
        "reflet render scene.glb --frames 96 --path orbit -o round_####.png");
    command->callback([all, sequenceOptions] {
        checkSequenceOptions(sequenceOptions, all->options.outputs);
        render(*all);
    });
}

}  // namespace reflet
