// The options of `reflet reference`.
#include "cli/reference_options.h"
#include "cli/in_range.h"

#include "base/error.h"
#include "base/text.h"
#include "cli/scene_arguments.h"
#include "cli/sequence_arguments.h"
#include "reference/sample_progress.h"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <array>
#include <cmath>

namespace reflet {

namespace {

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
    if (std::isnan(command.noise) || std::isnan(command.clamp) || std::isnan(command.shutter)) {
        failUsage("{} must be a number, is 'nan'", std::isnan(command.noise)   ? "--noise"
                                                   : std::isnan(command.clamp) ? "--clamp"
                                                                               : "--shutter");
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

void addSamplingOptions(CLI::App& command, ReferenceCommand& options) {
    command.add_option("--bounces", options.bounces, "Scattered rays per path; 0: only direct light [unlimited]")
        ->type_name("N");
    command
        .add_option("--spp", options.samples,
                    fmt::format("Maximum samples per pixel [{}; with --noise {}]", standardSamples, largestSamples))
        ->type_name("N")
        ->check(inRange(1U, largestSamples));
    command.add_option("--noise", options.noise, "Stop when the noise falls below this (0.01: 1 %)")
        ->type_name("X")
        ->check(inRange(0.0F, 10.0F));
    command
        .add_option("--clamp", options.clamp,
                    "Largest luminance of a sample's indirect light; 0: none. Removes fireflies, and makes the image "
                    "darker where they were")
        ->type_name("X")
        ->check(inRange(0.0F, 1e6F))
        ->capture_default_str();
    command
        .add_option("--filter", options.filter,
                    "Pixel filter. box: samples spread over the pixel; center: at its centre only, with aliased edges "
                    "as in a rasterizer")
        ->check(CLI::IsMember({"box", "center"}))
        ->capture_default_str();
    command
        .add_option("--sampling", options.sampling,
                    "Distribution of diffuse rays: changes the noise, not the expected image")
        ->check(CLI::IsMember({"cosine", "uniform"}))
        ->capture_default_str();
}

void addLightOptions(CLI::App& command, ReferenceCommand& options) {
    command.add_flag("--visible-only", options.visibleOnly,
                     "Scattered rays return light only from points that the camera sees and from the environment: "
                     "the best that any screen-space method can reach");
    command.add_flag("--pinhole", options.pinhole,
                     "Ignore the camera's lens (aperture_radius or f_number of a view file): everything is sharp");
    command
        .add_option("--shutter", options.shutter,
                    "Motion blur: share of the time between frames (--fps) that the shutter is open, around the "
                    "frame's time; 0: none. Camera, nodes, skins and morph targets move")
        ->type_name("X")
        ->check(inRange(0.0F, 1.0F))
        ->capture_default_str();
}

void addLayerOptions(CLI::App& command, ReferenceCommand& options) {
    command
        .add_option("--layers", options.layers,
                    fmt::format("Layers to write, of {} [all but ambient_occlusion]; PNG: the first one. Without final "
                                "and indirect light, paths end at the first surface",
                                fmt::join(layerNames, ", ")))
        ->type_name("A,B,...")
        ->delimiter(',')
        ->allow_extra_args(false);
    command
        .add_option("--ao-radius", options.aoRadius,
                    "Metres within which surfaces count in the layer ambient_occlusion [1], as ao.radius")
        ->type_name("R")
        ->check(inRange(1e-6F, 1e9F));
    command
        .add_option("--ao-falloff", options.aoFalloff,
                    "Share of that radius, at its end, over which they fade out [0], as ao.falloff")
        ->type_name("X")
        ->check(inRange(0.0F, 1.0F));
}

}  // namespace

std::vector<const CLI::Option*> addReferenceOptions(CLI::App& command, ReferenceCommand& options) {
    addSceneOptions(command, options.scene);
    command
        .add_option(
            "-o,--output", options.outputs,
            "Output image, .exr or .png, or film of --frames, .webp, .mp4 or .webm (by ffmpeg); may be repeated. With "
            "a "
            "run of #, as in clean_####.exr, every frame is written to the file of its number, and existing files are "
            "kept")
        ->type_name("FILE")
        ->allow_extra_args(false);
    std::vector<const CLI::Option*> sequenceOptions = addSequenceOptions(command, options.sequence, false);
    sequenceOptions.push_back(command.add_option("--frames", options.frames, "Sequences: number of frames")
                                  ->check(inRange(1U, 1000000U))
                                  ->capture_default_str());
    addSamplingOptions(command, options);
    addLightOptions(command, options);
    addLayerOptions(command, options);
    command.add_option("--threads", options.threads, "CPU threads, 0: one per core; the result does not depend on it")
        ->check(inRange(0U, 4096U))
        ->capture_default_str();
    addScriptOptions(command, options.script);
    command.footer(referenceFooter);
    return sequenceOptions;
}

void checkReferenceCommand(const ReferenceCommand& command, uvec2 size) {
    checkNumbers(command, size);
    checkLayers(command);
}

ReferenceOptions referenceOptions(const ReferenceCommand& command, const Settings& settings) {
    ReferenceOptions options;
    options.bounces = command.bounces.value_or(ReferenceOptions::unlimited);
    options.samples = command.samples.value_or(command.noise > 0.0F ? largestSamples : standardSamples);
    options.noise = command.noise;
    options.clamp = command.clamp;
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

}  // namespace reflet
