// `reflet defocus`: depth of field on a picture that was made elsewhere, or by the reference without a lens.
#include "base/error.h"
#include "base/progress.h"
#include "capture/pictures.h"
#include "capture/texels.h"
#include "cli/commands.h"
#include "cli/device_options.h"
#include "cli/output_files.h"
#include "cli/scene_arguments.h"
#include "device/device.h"
#include "device/frame.h"
#include "effects/depth_of_field/depth_of_field.h"
#include "effects/tonemap/tone_map_image.h"
#include "renderer/scene_exposure/scene_exposure.h"
#include "renderer/view_params.h"
#include "scene/pose.h"

#include <CLI/CLI.hpp>
#include <glm/gtc/packing.hpp>

#include <algorithm>
#include <memory>

namespace reflet {

namespace {

struct DefocusCommand {
    SceneOptions scene;
    std::string picture;
    std::vector<std::string> outputs;
    std::string device;
};

struct SharpPicture {
    FloatImage radiance;
    FloatImage depth;  ///< metres along the view axis; 0: infinitely far
};

const FloatImage& layerOf(const std::vector<ImageLayer>& layers, const std::string& name, size_t channels,
                          const std::string& file) {
    const auto found = std::ranges::find(layers, name, &ImageLayer::name);
    if (found == layers.end() || found->image.channels.size() < channels) {
        fail(
            "{}: there is no layer {} of {} channels; write it with reflet reference --pinhole, or with reflet render "
            "--aov depth",
            file, name.empty() ? "without a name" : name, channels);
    }
    return found->image;
}

SharpPicture readSharp(const std::string& file) {
    if (!isExr(file)) {
        failUsage("{}: the picture must be an .exr file with the radiance and the layer depth", file);
    }
    const std::vector<ImageLayer> layers = readExr(file);
    return {layerOf(layers, "", 3, file), layerOf(layers, "depth", 1, file)};
}

// The depth that the view's projection gives a distance.
float reversedDepth(float z, const vec4& d) {
    return z > 0.0F ? (d.x - d.z * z) / (d.w * z - d.y) : 0.0F;
}

// Runs the effect, and returns its radiance.
FloatImage blurred(gpu::Device& device, const SharpPicture& sharp, const Camera& camera, const DofSettings& settings) {
    const uvec2 size(sharp.radiance.width, sharp.radiance.height);
    const ViewParams view = makeViewParams(camera, size, 0, 0);
    const size_t channels = sharp.radiance.channels.size();
    std::vector<vec4> radiance;
    std::vector<float> depth;
    for (size_t i = 0; i < size_t(size.x) * size.y; ++i) {
        const float* c = &sharp.radiance.data[channels * i];
        radiance.emplace_back(c[0], c[1], c[2], 1.0F);
        depth.push_back(reversedDepth(sharp.depth.data[i], view.depthToDistance));
    }
    gpu::Frame f(device);
    gpu::HistoryImage coc("circle_of_confusion");
    f.begin();
    const gpu::Image light = f.image("radiance", VK_FORMAT_R32G32B32A32_SFLOAT, size);
    const gpu::Image depths = f.image("depth", VK_FORMAT_R32_SFLOAT, size);
    f.upload(light, std::as_bytes(std::span(radiance)));
    f.upload(depths, std::as_bytes(std::span(depth)));
    const Lens lens{camera.apertureRadius, camera.focusDistance, camera.blades, camera.bladeRotation};
    const gpu::Image out = depthOfField(f, coc, {light, depths, {}, view, lens, settings}).radiance;
    const gpu::Readback copy = f.readback(out);
    f.submit();
    f.wait();
    FloatImage image{size.x, size.y, {"R", "G", "B"}, {}};
    for (const vec4& texel : decodeTexels(out.format, f.bytes(copy))) {
        image.data.insert(image.data.end(), {texel.x, texel.y, texel.z});
    }
    return image;
}

void defocus(const DefocusCommand& command) {
    const Settings settings = loadSettings(command.scene);
    checkOutputs(command.outputs, inputFiles(command.scene, {command.picture}), "defocus");
    const SharpPicture sharp = readSharp(command.picture);
    const Scene scene = loadScene(command.scene);
    const View view = posed(loadView(command.scene, scene), scene);
    if (!(view.camera.apertureRadius > 0.0F)) {
        failUsage(
            "the camera is a pinhole: give it an aperture in a view file, such as {{\"camera\": "
            "{{\"aperture_radius\": 0.01, \"focus_distance\": 4}}}} (--view-file)");
    }
    gpu::Device device(programDevice(command.device));
    requireSize(device, {sharp.radiance.width, sharp.radiance.height});
    const FloatImage image = blurred(device, sharp, view.camera, settings.dof);
    const TonemapSettings tonemap = exposedAs(settings.tonemap, scene, sharp.radiance, sharp.depth);
    for (const std::string& file : command.outputs) {
        if (isExr(file)) {
            writeExr(file, std::vector<ImageLayer>{{"", image}, {"depth", sharp.depth}});
        } else {
            writePng(file, toneMapped(image, tonemap));
        }
        tellWritten(file);
    }
}

}  // namespace

void addDefocusCommand(CLI::App& app) {
    auto options = std::make_shared<DefocusCommand>();
    CLI::App* command =
        app.add_subcommand("defocus", "Apply depth of field to a sharp picture with depth, by the effect of `render`");
    addSceneOptions(*command, options->scene);
    command
        ->add_option("--picture", options->picture,
                     "Sharp picture: an .exr file with radiance and the layer depth [m], as reflet reference --pinhole "
                     "and reflet render --aov depth write it")
        ->type_name("F.exr")
        ->required();
    command->add_option("-o,--output", options->outputs, "Output image, .exr or .png; may be repeated")
        ->type_name("FILE")
        ->allow_extra_args(false);
    addDeviceOption(*command, options->device);
    command->footer(
        "The size is the picture's; the scene's camera, or that of --view-file, has the lens. Tells the error of the "
        "effect apart from that of the light:\n"
        "  reflet reference builtin:lens --pinhole -o sharp.exr\n"
        "  reflet reference builtin:lens -o lens.exr\n"
        "  reflet defocus builtin:lens --picture sharp.exr -o blurred.exr\n"
        "  reflet compare blurred.exr lens.exr");
    command->callback([options] { defocus(*options); });
}

}  // namespace reflet
