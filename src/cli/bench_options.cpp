// The options of `reflet bench`.
#include "cli/bench_options.h"

#include "cli/device_options.h"
#include "cli/in_range.h"
#include "cli/scene_arguments.h"
#include "reference/sample_progress.h"

#include <CLI/CLI.hpp>

namespace reflet {

namespace {

constexpr const char* benchFooter =
    "Device time: from the device's timestamps, per pass; submitted: from submission to fence, by the host's clock; "
    "wall: the whole call. 'first': frames without history, with all shaders compiled; 'steady': frames after the "
    "warm-up, with the error of frame warmup + frames + 1.\n"
    "--compare takes lists of presets and settings, such as 'preset:fast,trace_screen.max_steps=32', and renders both "
    "with alternating frames. --against runs another build of this program and this one alternately.\n"
    "The bytes of a pass are those of all images and buffers that it binds, each counted once; floor: the time to "
    "transfer them at the measured bandwidth. See docs/bench.md\n"
    "--octaves and --convergence also split the relative MSE by wavelength: noise from pixel to pixel is in the octave "
    "of 2 to 4 pixels, mottling in the middle ones, bias in the coarsest. The parts sum to the relative MSE.\n"
    "--motions renders small sequences at 160x90 (--size): errors against those at rest, ghosts, lag, flicker.\n"
    "builtin:tessellated-N is a room of N triangles (100 times a square number: 100, 400, … 1000000).\n"
    "Example: reflet bench builtin:cubes builtin:cave --preset fast,quality --size 640x360 --json bench.json";

void addTimesOptions(CLI::App& command, BenchCommand& options) {
    command.add_option("--first", options.firstFrames, "Measured frames without history")
        ->check(inRange(0U, 100000U))
        ->capture_default_str();
    command
        .add_option("--warmup", options.warmup, "Unmeasured frames between those without history and the measured ones")
        ->check(inRange(0U, 1000000U))
        ->capture_default_str();
    command.add_option("--frames", options.frames, "Measured frames with history")
        ->check(inRange(1U, 1000000U))
        ->capture_default_str();
    command
        .add_option("--motion", options.motionFrames,
                    "Frames to compare while the camera orbits and animations play; 0: none")
        ->check(inRange(0U, 100000U))
        ->capture_default_str();
    command
        .add_option("--orbit", options.orbit,
                    "Degrees that the camera orbits around its target over all --motion frames")
        ->check(inRange(-360.0F, 360.0F))
        ->capture_default_str();
    command.add_option("--fps", options.fps, "Frames per second of the scene's animations during --motion")
        ->check(inRange(1.0F, 1000.0F))
        ->capture_default_str();
    command
        .add_option("--rest", options.restFrames,
                    "Frames at rest after the motion, whose reflections are compared with their final value; 0: none")
        ->check(inRange(0U, 1000U))
        ->capture_default_str();
    command.add_flag("--octaves", options.octaves,
                     "Errors of frames 1, 8, 32 and 128 of a still view, also by octave of spatial frequency");
    command
        .add_option("--convergence", options.convergence,
                    "The same of these frames, such as 32,128,512,2048, to see what error remains: the bias. --plot "
                    "draws them")
        ->type_name("N,M,...")
        ->allow_extra_args(false)
        ->delimiter(',')
        ->check(inRange(1U, 1000000U));
    command
        .add_option("--motions", options.motions,
                    "Measure hard motion instead of scenes: cases such as pan-5, rods, lamp-off, or all of them")
        ->type_name("all|NAME,...")
        ->allow_extra_args(false)
        ->delimiter(',');
    command.add_option("--rounds", options.rounds, "With --against: runs of each program")
        ->check(inRange(1U, 1000U))
        ->capture_default_str();
    command.add_flag("--no-bandwidth", options.noBandwidth, "Skip the bandwidth measurement; floors are left out");
}

void addTruthOptions(CLI::App& command, BenchCommand& options) {
    command
        .add_option(
            "--truth", options.truth,
            "Ground truth for errors: reference: the path tracer; chain: the same settings with RAYS rays per pixel, "
            "without denoising; none: no errors")
        ->type_name("reference|chain:RAYS|none")
        ->capture_default_str();
    command
        .add_option(
            "--truth-of", options.truthOf,
            "With --truth chain: presets and settings of one ground truth for all variants [each variant's own]")
        ->type_name("LIST");
    command.add_option("--truth-bounces", options.truthBounces, "Scattered rays per path of the path tracer")
        ->type_name("N|unlimited")
        ->capture_default_str();
    command.add_flag("--truth-visible-only,!--truth-all-light", options.truthVisibleOnly,
                     "Scattered rays return light only from points that the camera sees [off]");
    command.add_option("--truth-spp", options.truthSamples, "Samples per pixel of the path tracer")
        ->check(inRange(2U, largestSamples))
        ->capture_default_str();
    command
        .add_option("--truth-filter", options.truthFilter,
                    "Pixel filter of the path tracer (see reflet reference --help)")
        ->check(CLI::IsMember({"box", "center"}))
        ->capture_default_str();
    command
        .add_option("--truth-cache", options.truthCache,
                    "Folder where ground truth images are cached [~/.cache/reflet/truth]")
        ->type_name("DIR");
    command.add_option("--layer", options.layer, "Layer whose error is measured")
        ->type_name("NAME")
        ->capture_default_str();
}

void addOutputOptions(CLI::App& command, BenchCommand& options) {
    command.add_option("--json", options.json, "Write all numbers")->type_name("F.json");
    command.add_flag("--markdown", options.markdown, "Print the tables as Markdown, for a file");
    command.add_option("--plot", options.plot, "Write a plot of error against time; with --convergence, over frames")
        ->type_name("F.svg");
    command.add_option("--strips", options.strips, "With --motions: a folder for a picture of each case")
        ->type_name("DIR")
        ->check(CLI::ExistingDirectory);
    command.add_flag("--validate", options.validate,
                     "Enable the Vulkan validation layers; any message is a failure. Times are meaningless then");
}

}  // namespace

void addBenchOptions(CLI::App& command, BenchCommand& options) {
    command.add_option("SCENE", options.scenes, "A .gltf or .glb file, or builtin:NAME; may be several");
    command.add_option("--preset", options.presets, "Presets to measure (see reflet list presets)")
        ->type_name("P,Q,...")
        ->allow_extra_args(false)
        ->delimiter(',');
    command.add_option("--variant", options.variants, "Named list of settings to measure; may be repeated")
        ->type_name("NAME=[PRESET,]KEY=VALUE,...")
        ->allow_extra_args(false);
    command
        .add_option("--compare", options.pairs,
                    "Two lists of presets and settings to measure with alternating frames; may be repeated")
        ->type_name("A B")
        ->allow_extra_args(false);
    command
        .add_option("--against", options.against, "Another build of this program to measure alternately with this one")
        ->type_name("PROGRAM");
    addViewOptions(command, options.shared);
    command.add_option("--sizes", options.sizes, "Several sizes, for cost per pixel; replaces --size")
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
