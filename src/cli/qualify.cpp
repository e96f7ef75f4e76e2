// `reflet qualify`: one command for a device that nobody has tried; a page and a JSON file to attach to an issue.
#include "measure/qualify/qualify.h"
#include "base/error.h"
#include "base/file.h"
#include "cli/commands.h"
#include "cli/device_options.h"
#include "cli/in_range.h"
#include "cli/output_files.h"
#include "job/scene_options.h"
#include "scene/builtin.h"
#include "version.h"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <memory>

namespace reflet {

namespace {

struct QualifyCommand {
    std::vector<std::string> scenes;
    std::vector<std::string> presets{"fast", "balanced", "quality"};
    std::string device;
    std::string output = "qualify";
    std::string size;
    std::string grids;
    double seconds = 60.0;
};

QualifyPlan planOf(const QualifyCommand& command) {
    QualifyPlan plan;
    plan.presets = command.presets;
    plan.seconds = command.seconds;
    plan.references = !command.grids.empty();
    for (const std::string& name : command.scenes) {
        if (findBuiltinScene(name) == nullptr) {
            failUsage("--scenes: there is no built-in scene '{}' (all of them: reflet list scenes)", name);
        }
        plan.scenes.push_back(name);
    }
    for (const BuiltinScene& scene : builtinScenes()) {
        if (command.scenes.empty()) {
            plan.scenes.emplace_back(scene.name);
        }
    }
    for (const std::string& preset : plan.presets) {
        SceneOptions options;
        options.preset = preset;
        static_cast<void>(loadSettings(options));  // throws for an unknown one
    }
    return plan;
}

// With validation, if its layer is installed: nobody should have to install it for this.
std::unique_ptr<gpu::Device> openValidated(const QualifyCommand& command) {
    try {
        return std::make_unique<gpu::Device>(programDevice(command.device, true));
    } catch (const Error&) {
        return nullptr;
    }
}

void qualify(const QualifyCommand& command) {
    QualifyPlan plan = planOf(command);
    const std::string page = command.output + ".md";
    const std::string json = command.output + ".json";
    tryOutputs({page, json, command.grids}, {});
    Qualification q;
    q.version = versionText;
    if (const std::unique_ptr<gpu::Device> device = openValidated(command)) {
        q.validated = true;
        qualifyPictures(plan, *device, q);
        q.messages = device->validationMessages();
    }
    gpu::Device device(programDevice(command.device));
    q.device = device.description();
    // Frames of full size take a CPU seconds.
    plan.timedSize = !command.size.empty()    ? parseSize(command.size)
                     : q.device.kind == "CPU" ? qualifySize
                                              : uvec2(1920, 1080);
    requireSize(device, plan.timedSize);
    if (!q.validated) {
        qualifyPictures(plan, device, q);
    }
    qualifyTimes(plan, device, q);
    qualifyStability(plan, device, q);
    const std::vector<Section> document = qualificationDocument(q);
    writeFileAtomically(page, markdownOf(document));
    writeFileAtomically(json, qualificationJson(q));
    if (!command.grids.empty()) {
        writeFileAtomically(command.grids, gridsText(q));
    }
    fmt::print("{}", plainTextOf(document, 120));
    fmt::print("\nwritten: {} and {}; please attach both to an issue\n", page, json);
    if (!q.passes()) {
        fail("the device did not pass: see {}", page);
    }
}

}  // namespace

void addQualifyCommand(CLI::App& app) {
    auto options = std::make_shared<QualifyCommand>();
    CLI::App* command = app.add_subcommand(
        "qualify", "Try a device: built-in scenes against stored pictures, times, memory, stability");
    addDeviceOption(*command, options->device);
    command->add_option("-o,--output", options->output, "Files to write: NAME.md and NAME.json")
        ->type_name("NAME")
        ->capture_default_str();
    command
        ->add_option("--scenes", options->scenes,
                     "Built-in scenes for the pictures, such as cubes,cave; all by default")
        ->type_name("NAME,...")
        ->delimiter(',');
    command->add_option("--presets", options->presets, "Presets to try")
        ->type_name("NAME,...")
        ->delimiter(',')
        ->capture_default_str();
    command->add_option("--size", options->size, "Size of the timed frames; 1920x1080, on a CPU device 160x90")
        ->type_name("WxH");
    command->add_option("--seconds", options->seconds, "Length of the stability run, seconds")
        ->type_name("S")
        ->check(inRange(0.0, 86400.0))
        ->capture_default_str();
    command
        ->add_option("--write-grids", options->grids,
                     "Also write the pictures, and path-traced references, as the program stores them")
        ->type_name("FILE");
    command->footer(
        "The exit status is 0 only if everything passed. What is compared and allowed is in docs/devices.md.");
    command->callback([options] { qualify(*options); });
}

}  // namespace reflet
