// `reflet list passes`: the passes of a scene's frame, and what they hand to each other.
#include "cli/list_passes.h"

#include "cli/device_options.h"
#include "cli/pass_listing.h"
#include "cli/scene_arguments.h"
#include "renderer/renderer.h"

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <memory>
#include <string>

namespace reflet {

namespace {

struct PassesCommand {
    SceneOptions scene;
    std::string device;
    std::string format = "markdown";
};

void listPasses(const PassesCommand& command) {
    constexpr int frames = 3;  // the first ones make what is kept, and have no history
    const uvec2 size = parseSize(command.scene.size);
    const Settings settings = loadSettings(command.scene);
    const Scene scene = loadScene(command.scene);
    const View view = loadView(command.scene, scene);
    gpu::Device device(programDevice(command.device));
    requireSize(device, size);
    Renderer renderer(device, scene, printWarning);
    renderer.listPasses();
    for (int i = 0; i < frames; ++i) {
        renderer.render(view, size, command.scene.seed, settings);
    }
    const gpu::PassListing& listing = renderer.frame().listing();
    const std::string text = command.format == "mermaid" ? passesAsMermaid(listing)
                             : command.format == "dot"   ? passesAsDot(listing)
                                                         : passesAsMarkdown(listing);
    fmt::print("{}", text);
}

}  // namespace

void addPassesList(CLI::App& list) {
    auto options = std::make_shared<PassesCommand>();
    options->scene.size = "320x180";
    CLI::App* command =
        list.add_subcommand("passes", "Passes of a scene's frame: what they read and write, and memory");
    addSceneOptions(*command, options->scene);
    addDeviceOption(*command, options->device);
    command
        ->add_option(
            "--format", options->format,
            "markdown: tables of passes and of resources; mermaid: a diagram of the frame's steps, a box for each "
            "effect; dot: a diagram of all passes, for Graphviz")
        ->check(CLI::IsMember({"markdown", "mermaid", "dot"}))
        ->capture_default_str();
    command->footer("Example: reflet list passes builtin:cubes --preset fast --format dot | dot -Tsvg > passes.svg");
    command->callback([options] { listPasses(*options); });
}

}  // namespace reflet
