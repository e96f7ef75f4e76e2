// The command line's options for scene, view, size and settings.
#include "cli/scene_arguments.h"
#include "cli/in_range.h"

#include "base/error.h"
#include "base/visible_text.h"
#include "capture/pictures.h"
#include "cli/option_hints.h"
#include "cli/output_files.h"
#include "scene/gltf/gltf.h"

#include <CLI/CLI.hpp>

#include <filesystem>

namespace reflet {

namespace {

void addCameraArguments(CLI::App& command, SceneOptions& options) {
    CameraOptions& o = options.placing;
    command
        .add_option("--orbit", o.orbit,
                    "Camera around the scene: degrees from the front (+Z) to the right, degrees above the horizon, and "
                    "metres or percent of the usual distance [100%: the scene fills the image; cameras with a target "
                    "keep their distance]")
        ->type_name("AZ,EL[,DISTANCE]");
    command
        .add_option("--look-at", o.lookAt,
                    "What is in the middle of the image: a point in metres, or a node with a mesh, by name")
        ->type_name("X,Y,Z|NODE");
    command.add_option("--fov", o.fov, "Vertical field of view in degrees, 1 to 179")
        ->check(inRange(1.0, 179.0))
        ->type_name("DEGREES");
    command.add_option("--zoom", o.zoom, "Magnification, 0.01 to 100: 2 shows half of the image at twice the size")
        ->check(inRange(0.01, 100.0))
        ->type_name("FACTOR");
    command.add_option("--f-number", o.fNumber, "Depth of field of a full-frame lens, 0.01 to 1e6: 2.8 for f/2.8")
        ->check(inRange(0.01, 1e6))
        ->type_name("N");
    command
        .add_option("--focus", o.focus,
                    "What the lens focuses on: metres along the view, a point or a node [the camera's target]")
        ->type_name("METRES|X,Y,Z|NODE");
    command
        .add_option("--sun", o.sun,
                    "Where the sun is: degrees from the front (+Z) to the right, degrees above the horizon. A scene "
                    "without a sun gets one")
        ->type_name("AZ,EL");
    command.add_option("--exposure", options.exposure, "Exposure in stops, -24 to 24: setting tonemap.exposure")
        ->check(inRange(-24.0, 24.0))
        ->type_name("STOPS");
    command
        .add_option("--save-view", options.saveView,
                    "Write camera, light and time that these options give to a file for --view-file")
        ->type_name("V.json");
}

}  // namespace

void addSceneOptions(CLI::App& command, SceneOptions& options) {
    command.add_option("SCENE", options.scene, "A .gltf or .glb file, or builtin:NAME (see reflet list scenes)")
        ->required();
    command
        .add_option("--preset", options.preset,
                    "Preset of settings (see reflet list presets) [balanced; stills: see --effort]")
        ->type_name("P");
    command
        .add_option("--variant", options.variant,
                    "Material variant of the glTF file; list: prints the names of its variants and ends")
        ->type_name("NAME|list");
    command.add_option("--up", options.up, "Axis of the glTF file that points up; glTF says Y, some programs write Z")
        ->check(CLI::IsMember({"Y", "Z"}))
        ->type_name("Y|Z")
        ->capture_default_str();
    command.parse_complete_callback([&options] {
        if (options.variant == "list") {
            for (const std::string& name : loadGltf(options.scene).variants) {
                fmt::print("{}\n", oneLine(name));
            }
            throw CLI::Success();
        }
        if (options.animation == "list") {
            for (const AnimationClip& clip : loadGltf(options.scene).clips) {
                fmt::print("{}\n", oneLine(clip.name));
            }
            throw CLI::Success();
        }
    });
    addViewOptions(command, options);
    addCameraArguments(command, options);
}

void addViewOptions(CLI::App& command, SceneOptions& options) {
    command.add_option("--scene", options.sceneIndex, "Scene in the glTF file, by number from 0");
    command.add_flag("--strict", options.strict,
                     "Refuse a glTF file with any invalid part; otherwise warn, and draw the rest");
    command.add_option("--camera", options.camera, "Camera of the scene, by number from 0 or by name");
    command.add_option("--view-file", options.viewFile, "Camera, sun and environment from a JSON file")
        ->type_name("V.json");
    command
        .add_option(
            "--environment", options.environment,
            "Light from all around: a clear sky (with a sun, unless there is one), a studio of soft boxes, none, "
            "or an equirectangular image [the view file's or the scene's; for files without light: sky]")
        ->type_name("sky|studio|none|FILE");
    command
        .add_option("--background", options.background,
                    "What is seen where there is no surface; lighting and reflections do not change: environment, its "
                    "blur, transparent (PNG and EXR with alpha), a name or display values of 0 to 1 "
                    "[environment; for sky and studio: blur]")
        ->type_name("environment|blur|transparent|COLOR|R,G,B");
    command
        .add_option("--animation", options.animation,
                    "Animation of the glTF file, by name or by number from 0; all; none: the rest pose; list: prints "
                    "their names and ends [each that moves nothing of what an earlier one moves]")
        ->type_name("NAME|N|all|none|list");
    command.add_option("--time", options.time, "Time of the scene's animations, in seconds; they loop")
        ->type_name("SECONDS");
    command.add_option("--size", options.size, "Width and height in pixels")->type_name("WxH")->capture_default_str();
    // One value per occurrence: the next argument may be the scene.
    command.add_option("--settings", options.settingsFiles, "Settings from a JSON file, overriding the preset")
        ->type_name("F.json")
        ->allow_extra_args(false);
    command
        .add_option("--set", options.set,
                    "One setting, overriding all others (see reflet list settings); may be repeated")
        ->type_name("KEY=VALUE")
        ->allow_extra_args(false);
    command.add_option("--seed", options.seed, "Seed of the random numbers")->capture_default_str();
}

void checkOutputs(const std::vector<std::string>& outputs, const InputFiles& inputs, std::string_view command) {
    if (outputs.empty()) {
        failUsage("nothing to write: add -o FILE.exr or -o FILE.png (see reflet {} --help)", command);
    }
    for (const std::string& file : outputs) {
        if (!isExr(file) && std::filesystem::path(file).extension() != ".png") {
            failUsage("-o {}: the name must end in .exr or .png{}", file,
                      endingHint(std::filesystem::path(file).extension().string()));
        }
    }
    tryOutputs(outputs, inputs);
}

}  // namespace reflet
