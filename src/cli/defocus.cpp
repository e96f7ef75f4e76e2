// `reflet defocus`: depth of field on a picture that was made elsewhere, or by the reference without a lens.
#include "base/error.h"
#include "capture/texels.h"
#include "cli/commands.h"
#include "cli/device_options.h"
#include "cli/output_files.h"
#include "cli/scene_arguments.h"
#include "cli/sharp_picture.h"
#include "device/device.h"
#include "device/frame.h"
#include "effects/depth_of_field/depth_of_field.h"
#include "renderer/scene_exposure/scene_exposure.h"
#include "renderer/view_params.h"
#include "scene/pose.h"

#include <CLI/CLI.hpp>

#include <memory>

namespace reflet {

namespace {

struct DefocusCommand {
    SceneOptions scene;
    std::string picture;
    std::vector<std::string> outputs;
    std::string device;
};

// Runs the effect, and returns its radiance.
FloatImage blurred(gpu::Device& device, const SharpPicture& sharp, const Camera& camera, const DofSettings& settings) {
    const uvec2 size(sharp.radiance.width, sharp.radiance.height);
    const ViewParams view = makeViewParams(camera, size, 0, 0);
    gpu::Frame f(device);
    gpu::HistoryImage coc("circle_of_confusion");
    f.begin();
    const SharpImages images = uploadSharp(f, sharp, view);
    const Lens lens{camera.apertureRadius, camera.focusDistance, camera.blades, camera.bladeRotation};
    const gpu::Image out = depthOfField(f, coc, {images.radiance, images.depth, {}, view, lens, settings}).radiance;
    const gpu::Readback copy = f.readback(out);
    f.submit();
    f.wait();
    return colorImage(decodeTexels(out.format, f.bytes(copy)), size);
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
    writeEffect(command.outputs, image, sharp, exposedAs(settings.tonemap, scene, sharp.radiance, sharp.depth));
}

}  // namespace

void addDefocusCommand(CLI::App& app) {
    auto options = std::make_shared<DefocusCommand>();
    CLI::App* command =
        app.add_subcommand("defocus", "Apply depth of field to a sharp picture with depth, by the effect of `render`");
    addSceneOptions(*command, options->scene);
    addSharpPictureOptions(*command, options->picture, options->outputs);
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
