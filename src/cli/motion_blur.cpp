// `reflet motion-blur`: motion blur on a picture that was made elsewhere, or by the reference without a shutter.
#include "effects/motion_blur/motion_blur.h"
#include "cli/in_range.h"

#include "base/error.h"
#include "base/progress.h"
#include "capture/pictures.h"
#include "capture/texels.h"
#include "cli/commands.h"
#include "cli/device_options.h"
#include "cli/output_files.h"
#include "cli/scene_arguments.h"
#include "cli/sharp_picture.h"
#include "device/device.h"
#include "device/frame.h"
#include "effects/tonemap/tone_map_image.h"
#include "job/sequence_views.h"
#include "reference/motion.h"
#include "renderer/scene_exposure/scene_exposure.h"
#include "renderer/view_params.h"
#include "scene/pose.h"

#include <CLI/CLI.hpp>

#include <memory>

namespace reflet {

namespace {

struct MotionBlurCommand {
    SceneOptions scene;
    std::string picture;
    std::vector<std::string> outputs;
    SequenceOptions sequence;  ///< of which the path and fps are read
    uint32_t frames = 1;
    uint32_t frame = 0;
    std::string device;
};

// Of the frame, since the one before it.
struct Moved {
    ViewParams view;
    FloatImage motion;
};

Moved motionOf(const MotionBlurCommand& command, const Scene& scene, uvec2 size) {
    const SequenceViews views(loadView(command.scene, scene), scene, command.sequence, command.frames);
    const View now = posed(views.at(command.frame), scene);
    const View before = posed(views.at(command.frame - 1.0), scene);
    const bool stands = scene.nodes.empty();
    const Scene posedNow = stands ? Scene{} : frozen(scene, now.time);
    const Scene posedBefore = stands ? Scene{} : frozen(scene, before.time);
    const RayScene rays(stands ? scene : posedNow);
    const std::unique_ptr<RayScene> earlier = stands ? nullptr : std::make_unique<RayScene>(posedBefore);
    Moved moved{makeViewParams(now.camera, size, 0, command.scene.seed),
                traceMotion(rays, now, earlier ? *earlier : rays, before, size).motion};
    moved.view.previousWorldToClip = makeViewParams(before.camera, size, 0, 0).worldToClip;
    return moved;
}

FloatImage blurred(gpu::Device& device, const SharpPicture& sharp, const Moved& moved,
                   const MotionBlurSettings& settings) {
    const uvec2 size(sharp.radiance.width, sharp.radiance.height);
    std::vector<vec4> motion;
    for (size_t i = 0; i < size_t(size.x) * size.y; ++i) {
        motion.emplace_back(moved.motion.data[2 * i], moved.motion.data[2 * i + 1], 0.0F, 0.0F);
    }
    gpu::Frame f(device);
    f.begin();
    const SharpImages images = uploadSharp(f, sharp, moved.view);
    const gpu::Image vectors = f.image("motion", VK_FORMAT_R32G32B32A32_SFLOAT, size);
    f.upload(vectors, std::as_bytes(std::span(motion)));
    const gpu::Readback copy =
        f.readback(motionBlur(f, {images.radiance, images.depth, vectors, moved.view, settings}).radiance);
    f.submit();
    f.wait();
    return colorImage(decodeTexels(VK_FORMAT_R16G16B16A16_SFLOAT, f.bytes(copy)), size);
}

void blurByMotion(const MotionBlurCommand& command) {
    Settings settings = loadSettings(command.scene);
    settings.motionBlur.enabled = 1;
    checkOutputs(command.outputs, inputFiles(command.scene, {command.picture, command.sequence.path}), "motion-blur");
    if (command.frame >= command.frames) {
        failUsage("--frame {}: is counted from 0, of --frames {}", command.frame, command.frames);
    }
    if (!blurs(settings.motionBlur)) {
        failUsage("motion_blur.shutter: is 0, which blurs nothing");
    }
    const SharpPicture sharp = readSharp(command.picture);
    const uvec2 size(sharp.radiance.width, sharp.radiance.height);
    const Scene scene = loadScene(command.scene);
    const Moved moved = motionOf(command, scene, size);
    gpu::Device device(programDevice(command.device));
    requireSize(device, size);
    writeEffect(command.outputs, blurred(device, sharp, moved, settings.motionBlur), sharp,
                exposedAs(settings.tonemap, scene, sharp.radiance, sharp.depth));
}

}  // namespace

void addMotionBlurCommand(CLI::App& app) {
    auto options = std::make_shared<MotionBlurCommand>();
    CLI::App* command =
        app.add_subcommand("motion-blur", "Apply motion blur to a sharp picture with depth, by the effect of `render`");
    addSceneOptions(*command, options->scene);
    addSharpPictureOptions(*command, options->picture, options->outputs);
    command->add_option("--path", options->sequence.path, "Camera path, as of render: orbit, or a file of keyframes")
        ->type_name("orbit|FILE.json");
    command->add_option("--fps", options->sequence.fps, "Frames per second; frame 0 is at --time")
        ->type_name("F")
        ->check(inRange(0.001, 100000.0))
        ->capture_default_str();
    command->add_option("--frames", options->frames, "Number of frames of the sequence")
        ->check(inRange(1U, 1000000U))
        ->capture_default_str();
    command->add_option("--frame", options->frame, "The picture's frame in it, counted from 0")->capture_default_str();
    addDeviceOption(*command, options->device);
    command->footer(
        "The size is the picture's; motion is that of the scene since the frame before, found by rays. Tells the error "
        "of the effect apart from that of the light:\n"
        "  reflet reference builtin:moving --time 0.6 -o sharp.exr\n"
        "  reflet reference builtin:moving --time 0.6 --shutter 0.5 -o shutter.exr\n"
        "  reflet motion-blur builtin:moving --time 0.6 --picture sharp.exr -o blurred.exr\n"
        "  reflet compare blurred.exr shutter.exr");
    command->callback([options] { blurByMotion(*options); });
}

}  // namespace reflet
