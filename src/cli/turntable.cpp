// `reflet turntable`: a film of a whole turn around a scene.
#include "job/turntable.h"
#include "base/error.h"
#include "base/progress.h"
#include "cli/commands.h"
#include "cli/device_options.h"
#include "cli/in_range.h"
#include "cli/option_hints.h"
#include "cli/output_files.h"
#include "cli/scene_arguments.h"
#include "cli/script_arguments.h"
#include "device/device.h"
#include "job/film.h"
#include "renderer/renderer.h"

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <memory>

namespace reflet {

namespace {

constexpr double secondsPerHour = 3600.0;

struct TurntableCommand {
    TurntableOptions turntable;
    ScriptOptions script;
};

void checkTurntableOutputs(const RenderOptions& options, const Films& films) {
    if (options.outputs.empty()) {
        failUsage("nothing to write: add -o FILM.webp, -o FILM.mp4 or -o FRAME_####.png (see reflet turntable --help)");
    }
    for (const std::string& file : options.outputs) {
        const std::string ending = std::filesystem::path(file).extension().string();
        if (!FrameNames::isPattern(file) || (ending != ".png" && ending != ".exr")) {
            failUsage("-o {}: a turntable is a film, .webp, .mp4 or .webm, or frames, as in frame_####.png{}", file,
                      endingHint(ending));
        }
    }
    std::vector<std::string> outputs = options.outputs;
    outputs.push_back(options.scene.saveView);
    std::ranges::copy(films.names(), std::back_inserter(outputs));
    tryOutputs(outputs, inputFiles(options.scene));
    (void)isSequence(options.outputs, options.sequence, options.frames);
}

void tellResult(const TurntableCommand& command, const RenderJob& job, uint32_t rendered, double seconds,
                std::vector<std::string> written) {
    const double perHour = seconds > 0.0 ? rendered / seconds * secondsPerHour : 0.0;
    for (const std::string& file : written) {
        tellWritten(
            fmt::format("{} ({} frames; {} rendered, {:.0f} an hour)", file, job.options.frames, rendered, perHour));
    }
    printResult(command.script, {{"outputs", std::move(written)},
                                 {"size", {job.size.x, job.size.y}},
                                 {"frames", job.options.frames},
                                 {"fps", job.options.sequence.fps},
                                 {"rendered", rendered},
                                 {"seconds", seconds},
                                 {"frames_per_hour", perHour},
                                 {"device", job.device.description().name}});
}

void turntable(const TurntableCommand& command) {
    TurntableOptions options = command.turntable;
    RenderOptions& render = options.render;
    const uvec2 size = parseSize(render.scene.size);
    render.frames = turntableFrames(options);
    if (render.scene.preset.empty()) {
        render.scene.preset = turntablePreset(options.effort);
    }
    const Films films(render.outputs, size.x, size.y);
    Settings settings = loadSettings(render.scene);
    Pictures pictures(render.show, {});
    pictures.prepare(settings);
    checkTurntableOutputs(render, films);
    const Scene scene = loadScene(render.scene);
    const Turntable turn = makeTurntable(options, scene);

    gpu::Device device(programDevice(render.device, false));
    requireSize(device, size);
    Renderer renderer(device, scene, printWarning);
    Timings timings(false);
    const RenderJob asked{render, scene, turn.first, settings, size, device, renderer, pictures, timings};
    const Settings exposed = exposedForAll(asked, turn);
    const RenderJob job{render, scene, turn.first, exposed, size, device, renderer, pictures, timings};
    const auto start = std::chrono::steady_clock::now();
    const uint32_t rendered = renderTurntable(job, turn, options.effort);
    const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    std::vector<std::string> written = films.write(render.sequence.fps, render.sequence.firstFrame, render.frames);
    std::ranges::copy_if(render.outputs, std::back_inserter(written),
                         [&](const std::string& file) { return !films.hasFrames(file); });
    tellResult(command, job, rendered, seconds, std::move(written));
}

void addFilmOptions(CLI::App& command, TurntableOptions& options) {
    RenderOptions& render = options.render;
    command
        .add_option("-o,--output", render.outputs,
                    "Film, .webp, .mp4 or .webm (the last two by ffmpeg), or its frames, as in frame_####.png; may be "
                    "repeated. Frames are kept until the film is whole: run the same command again to continue")
        ->type_name("FILE")
        ->allow_extra_args(false);
    command.add_option("--seconds", options.seconds, "Length of the film, one turn, 0.1 to 3600")
        ->check(inRange(0.1, 3600.0))
        ->type_name("N")
        ->capture_default_str();
    command.add_option("--fps", render.sequence.fps, "Frames per second, 1 to 240")
        ->check(inRange(1.0, 240.0))
        ->type_name("F")
        ->capture_default_str();
    command
        .add_option("--effort", options.effort,
                    "Of each frame: draft (the preset balanced at rest), normal or high (as stills, until little noise "
                    "is left)")
        ->type_name("draft|normal|high")
        ->capture_default_str();
    command
        .add_option("--light", options.light,
                    "What sun and environment stay with: camera, as if the object turned on a table, or scene "
                    "[camera for sky and studio, scene for a sun and an environment of its own]")
        ->check(CLI::IsMember({"camera", "scene"}))
        ->type_name("camera|scene");
    command.add_flag("--animate", options.animated,
                     "Play the scene's animations, a whole number of times during the turn, so that the film loops");
    command.add_option("--show", render.show, "Render target to write (see reflet list shows)")
        ->type_name("NAME")
        ->capture_default_str();
    command
        .add_option("--share", render.sequence.share,
                    "Make only every Nth frame, for N processes, as in 3/16; auto, auto/N: from a job array "
                    "(docs/many-machines.md)")
        ->type_name("K/N|auto|auto/N");
    command.add_flag("--overwrite", render.sequence.overwrite,
                     "Remove existing frames first, also those of other settings");
}

}  // namespace

void addTurntableCommand(CLI::App& app) {
    auto all = std::make_shared<TurntableCommand>();
    RenderOptions& render = all->turntable.render;
    render.scene.size = "640x640";
    CLI::App* command = app.add_subcommand("turntable", "Make a film of a whole turn around a scene, which loops");
    addSceneOptions(*command, render.scene);
    addFilmOptions(*command, all->turntable);
    addDeviceOption(*command, render.device);
    addScriptOptions(*command, all->script);
    command->footer(
        "The scene is framed from all sides; --orbit sets the first frame's direction. Each frame is a finished "
        "still.\n"
        "Animations stand still at --time; --animate plays them.\n"
        "Example: reflet turntable scene.glb -o scene.webp\n"
        "reflet turntable scene.glb --orbit 0,15,120% --seconds 6 --fps 30 --size 1080x1080 -o scene.mp4");
    command->callback([all] { turntable(*all); });
}

}  // namespace reflet
