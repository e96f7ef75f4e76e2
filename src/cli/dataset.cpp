// `reflet dataset`: makes noisy and clean images with features, to train and test denoisers.
#include "dataset/dataset.h"
#include "cli/in_range.h"

#include "base/error.h"
#include "cli/commands.h"
#include "cli/device_options.h"
#include "cli/scene_arguments.h"
#include "dataset/draws.h"

#include <CLI/CLI.hpp>

#include <memory>
#include <optional>

namespace reflet {

namespace {

constexpr const char* footer =
    "Writes DIR/manifest.json, DIR/frames.jsonl (a line for each frame, once all are there) and a folder for each\n"
    "scene. A frame depends on the seed and its number alone: the same command resumes, and shares may be made on\n"
    "many machines and their folders copied together; then the same command without --share writes frames.jsonl.\n"
    "The layers and their sum, the layout of the files and the manifest are described in docs/datasets.md.\n"
    "Noisy images by samples per pixel are path traced and unbiased: their mean is the clean image.\n"
    "Example: reflet dataset builtin:cubes builtin:cave scene.glb -o data --frames 1000 --noisy 1,4,16";

void addCameraOptions(CLI::App& command, DatasetOptions& o) {
    command
        .add_option("--cameras", o.cameras,
                    "random: in the scene's free space, looking at something; path: along --path; orbit: once around "
                    "the target of the scene's camera")
        ->check(CLI::IsMember({"random", "path", "orbit"}))
        ->capture_default_str();
    command.add_option("--path", o.path, "Keyframes for --cameras path (docs/view-files.md)")->type_name("FILE.json");
    command.add_option("--burst", o.burst, "Consecutive frames of each random camera, 1/fps apart: for motion")
        ->check(inRange(1U, 10000U))
        ->capture_default_str();
    command.add_option("--fps", o.fps, "Frames per second: the time to the frame before, for motion vectors")
        ->capture_default_str();
    command.add_option("--speed", o.speed, "Factor on the speed of random cameras; 0: they stand still")
        ->check(inRange(0.0, 1000.0))
        ->capture_default_str();
    command
        .add_option("--height", o.height,
                    fmt::format("Height of random cameras above the floor: a range in metres, or {}",
                                listed(heightDistributions())))
        ->type_name("NAME|A..B")
        ->capture_default_str();
    command
        .add_option("--fov", o.fov,
                    fmt::format("Vertical field of view of random cameras: a range in degrees, or {}",
                                listed(fovDistributions())))
        ->type_name("NAME|A..B")
        ->capture_default_str();
}

void addLightOptions(CLI::App& command, DatasetOptions& o) {
    command.add_option("--sun", o.sun, "The scene's sun, or one from a random direction above the horizon")
        ->check(CLI::IsMember({"scene", "random"}))
        ->capture_default_str();
    command
        .add_option("--environments", o.environments,
                    "Environments to draw from: sky, studio, none, files, and folders of .hdr and .exr files, which "
                    "are turned at random [the scene's]")
        ->type_name("A,B,...")
        ->delimiter(',')
        ->allow_extra_args(false);
    command
        .add_option("--exposure", o.exposure,
                    "Stops, drawn for each camera and added to the exposure in the manifest; radiance does not change")
        ->type_name("A..B")
        ->capture_default_str();
}

void addImageOptions(CLI::App& command, DatasetOptions& o) {
    command
        .add_option("--noisy", o.noisy,
                    "Noisy versions: samples per pixel of the path tracer, or presets of the renderer")
        ->type_name("N,PRESET,...")
        ->delimiter(',')
        ->allow_extra_args(false)
        ->capture_default_str();
    command.add_option("--spp", o.samples, "Samples per pixel of clean images, at most")
        ->check(inRange(1U, 1U << 20U))
        ->capture_default_str();
    command.add_option("--noise", o.noise, "Clean images end when their noise falls below this (0.01: 1 %)")
        ->check(inRange(0.0F, 10.0F))
        ->capture_default_str();
    command
        .add_option("--clamp", o.clamp,
                    "Largest luminance of a sample's indirect light, in noisy and clean images alike; 0: none")
        ->check(inRange(0.0F, 1e6F))
        ->capture_default_str();
    command
        .add_option("--shutter", o.shutter,
                    "Motion blur of traced images, noisy and clean alike: share of the time between frames that the "
                    "shutter is open, around the frame's time. Features stay sharp")
        ->check(inRange(0.0F, 1.0F))
        ->capture_default_str();
    command
        .add_option("--layout", o.layout,
                    "exr: one file of all layers for each frame; oidn: files named as the training tools of Intel Open "
                    "Image Denoise read them")
        ->check(CLI::IsMember({"exr", "oidn"}))
        ->capture_default_str();
    command.add_flag("--ldr", o.displayed, "Layout oidn: also tone-mapped images (.ldr.exr), linear from 0 to 1");
    command.add_flag("--float", o.floats, "Radiance, albedo and normals as 32-bit floats instead of half floats");
}

}  // namespace

void addDatasetCommand(CLI::App& app) {
    auto options = std::make_shared<DatasetOptions>();
    auto device = std::make_shared<std::string>();
    options->view.size = "160x90";
    CLI::App* command = app.add_subcommand("dataset", "Make noisy and clean images with features, to train denoisers");
    command->add_option("SCENES", options->scenes, "glTF files, or builtin:NAME; frames are dealt to them in turns")
        ->required();
    command->add_option("-o,--output", options->folder, "Folder")->type_name("DIR")->required();
    command->add_option("--frames", options->frames, "Number of frames, over all scenes")
        ->check(inRange(1U, 10000000U))
        ->required();
    addCameraOptions(*command, *options);
    addLightOptions(*command, *options);
    addImageOptions(*command, *options);
    command
        ->add_option("--share", options->share,
                     "Make only every Nth burst, for N processes, as in 3/16; auto: K and N from the environment of a "
                     "Slurm job array; auto/N: K from a PBS array or GNU parallel (docs/many-machines.md)")
        ->type_name("K/N|auto|auto/N");
    command->add_option("--threads", options->threads, "CPU threads, 0: one per core; the result does not depend on it")
        ->check(inRange(0U, 4096U))
        ->capture_default_str();
    addDeviceOption(*command, *device);
    addViewOptions(*command, options->view);
    command->footer(footer);
    command->callback([options, device] {
        std::optional<gpu::Device> opened;
        makeDataset(*options, [&]() -> gpu::Device& {
            if (!opened) {
                opened.emplace(programDevice(*device));
                requireSize(*opened, parseSize(options->view.size));
            }
            return *opened;
        });
    });
}

}  // namespace reflet
