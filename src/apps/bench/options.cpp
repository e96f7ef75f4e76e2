// The options of `reflet bench`.
#include "apps/bench/options.h"

#include "apps/device_options.h"
#include "apps/sample_progress.h"

#include <CLI/CLI.hpp>

namespace reflet {

namespace {

constexpr const char* benchFooter =
    "Device time is what the device's timestamps say, pass by pass; submitted: from submission to fence, by the host's "
    "clock; wall: the whole call. 'first': frames without history, with all shaders compiled; 'steady': frames after "
    "the warm-up, errors those of frame warmup + frames + 1.\n"
    "--compare takes lists of presets and settings, 'preset:fast,trace_screen.max_steps=32', and renders both frame by "
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
    command
        .add_option("--motion", options.motionFrames,
                    "Frames that are compared while the camera turns and things move; 0: none")
        ->check(CLI::Range(0U, 100000U))
        ->capture_default_str();
    command.add_option("--orbit", options.orbit, "Degrees that it turns round what it looks at, over all of them")
        ->check(CLI::Range(-360.0F, 360.0F))
        ->capture_default_str();
    command.add_option("--fps", options.fps, "Frames a second of the scene's animations, in motion")
        ->check(CLI::Range(1.0F, 1000.0F))
        ->capture_default_str();
    command
        .add_option("--rest", options.restFrames,
                    "Frames after the motion, all at rest, that are held against what reflections become; 0: none")
        ->check(CLI::Range(0U, 1000U))
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
    command
        .add_option(
            "--truth-of", options.truthOf,
            "With --truth chain: presets and settings whose picture it is, for all variants; not each its own's")
        ->type_name("LIST");
    command.add_option("--truth-bounces", options.truthBounces, "Scattered rays of the path tracer's paths")
        ->type_name("N|unlimited")
        ->capture_default_str();
    command.add_flag("--truth-visible-only,!--truth-all-light", options.truthVisibleOnly,
                     "Scattered rays bring light only from points that the camera sees [on]");
    command.add_option("--truth-spp", options.truthSamples, "The path tracer's samples per pixel")
        ->check(CLI::Range(2U, largestSamples))
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
    command.add_flag("--markdown", options.markdown, "Print the tables as Markdown, for a file");
    command.add_option("--plot", options.plot, "Error against time")->type_name("F.svg");
    command.add_flag("--validate", options.validate,
                     "Run under the Vulkan validation layers; any message is a failure. Times mean nothing then");
}

}  // namespace

void addBenchOptions(CLI::App& command, BenchCommand& options) {
    command.add_option("SCENE", options.scenes, "A .gltf or .glb file, or builtin:NAME; may be several")->required();
    command.add_option("--preset", options.presets, "Presets to measure (reflet list presets)")
        ->type_name("P,Q,...")
        ->allow_extra_args(false)
        ->delimiter(',');
    command.add_option("--variant", options.variants, "Settings to measure under a name; may be repeated")
        ->type_name("NAME=[PRESET,]KEY=VALUE,...")
        ->allow_extra_args(false);
    command.add_option("--compare", options.pairs, "Two lists of presets and settings, in turn; may be repeated")
        ->type_name("A B")
        ->allow_extra_args(false);
    command.add_option("--against", options.against, "Another build of this program, in turn with this one")
        ->type_name("PROGRAM");
    addViewOptions(command, options.shared);
    command.add_option("--sizes", options.sizes, "Several sizes, for cost per pixel; in the place of --size")
        ->type_name("WxH,WxH,...")
        ->allow_extra_args(false)
        ->delimiter(',');
    addTimesOptions(command, options);
    addTruthOptions(command, options);
    addDeviceOption(command, options.device);
    addOutputOptions(command, options);
    command.footer(benchFooter);
}

}  // namespace reflet
