// `reflet view`: the same frame as `render`, in a window.
#include "view/view_command.h"

#include "apps/device_options.h"
#include "view/viewer.h"

#include <CLI/CLI.hpp>

#include <memory>

namespace reflet {

void addViewCommand(CLI::App& app) {
    auto options = std::make_shared<ViewerOptions>();
    CLI::App* command = app.add_subcommand("view", "Look at a scene in a window, change all settings, see why");
    addSceneOptions(*command, options->scene);
    addDeviceOption(*command, options->device);
    command->add_flag(
        "--fresh", options->fresh,
        "Begin as if the scene had never been opened; else camera, light, settings and panels are as they "
        "were left, but for what is given here");
    command
        ->add_option("--status", options->status,
                     "Writes what the window shows, and where its controls are, whenever it is drawn: for scripts")
        ->type_name("F.json");
    command->add_option("--pick", options->pick, "Picks this pixel of the picture once it is at rest")
        ->type_name("X,Y");
    command
        ->add_option("--window-picture", options->windowPicture,
                     "Writes a picture of the whole window once it is at rest, and ends")
        ->type_name("F.png");
    command
        ->add_option(
            "--shaders", options->shaders,
            "The folder src of a source tree, whose shaders are compiled anew when they are edited [that of the "
            "program, where it is there]")
        ->type_name("FOLDER");
    command->add_flag("--validate", options->validate,
                      "Run under the Vulkan validation layers; any message is a failure");
    command->footer(
        "--size is that of the picture, without the panels. In the window, F1 lists the keys.\n"
        "Example: reflet view builtin:cave\nreflet view scene.glb --preset quality --set tonemap.exposure=1");
    command->callback([options] {
        parseSize(options->scene.size);
        Viewer viewer(*options);
        viewer.run();
    });
}

}  // namespace reflet
