// `reflet view`: the same frame as `render`, in a window.
#include "view/view_command.h"

#include "cli/device_options.h"
#include "cli/scene_arguments.h"
#include "view/viewer.h"

#include <CLI/CLI.hpp>

#include <memory>

namespace reflet {

void addViewCommand(CLI::App& app) {
    auto options = std::make_shared<ViewerOptions>();
    CLI::App* command =
        app.add_subcommand("view", "View a scene in a window, change all settings, inspect pixels and rays");
    addSceneOptions(*command, options->scene);
    addDeviceOption(*command, options->device);
    command->add_flag("--fresh", options->fresh,
                      "Start as if the scene had never been opened. Otherwise camera, light, settings and panels are "
                      "restored, except for those given here");
    command
        ->add_option("--status", options->status,
                     "For scripts: write the window's content and the positions of its controls after every redraw")
        ->type_name("F.json");
    command->add_option("--pick", options->pick, "Pick this pixel once the image has converged")->type_name("X,Y");
    command
        ->add_option("--window-picture", options->windowPicture,
                     "Write an image of the whole window once it has converged, and exit")
        ->type_name("F.png");
    command
        ->add_option(
            "--shaders", options->shaders,
            "Folder src of a source tree, whose shaders are reloaded when edited [that of the program's build, "
            "if it exists]")
        ->type_name("FOLDER");
    command->add_flag("--validate", options->validate, "Enable the Vulkan validation layers; any message is a failure");
    command->footer(
        "--size is the size of the image, without the panels. In the window, F1 lists the keys.\n"
        "Example: reflet view builtin:cave\nreflet view scene.glb --preset quality --set tonemap.exposure=1");
    command->callback([options] {
        parseSize(options->scene.size);
        Viewer viewer(*options);
        viewer.run();
    });
}

}  // namespace reflet
