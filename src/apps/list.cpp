// `reflet list`: what there is to choose from.
#include "apps/commands.h"
#include "apps/show.h"
#include "base/error.h"
#include "gpu/device.h"
#include "render/presets.h"
#include "scene/builtin.h"

#include <memory>

namespace reflet {

namespace {

void listScenes() {
    for (const BuiltinScene& scene : builtinScenes()) {
        fmt::print("builtin:{:<14} {}\n", scene.name, scene.description);
    }
}

void listPresets() {
    for (const Preset& preset : presets()) {
        fmt::print("{:<10} {}\n           {}\n", preset.name, preset.description, preset.json);
    }
}

void listShows() {
    for (const Show& show : shows()) {
        fmt::print("{:<22} {}\n", show.name, show.description);
    }
}

void listSettings() {
    const Settings defaults;
    for (const SettingEntry& entry : settingEntries()) {
        fmt::print("{:<24} {} ({}; default {})\n", entry.name, entry.info.help, rangeText(entry.info),
                   settingText(defaults, entry));
    }
}

void listDevices() {
    const auto devices = gpu::listDevices();
    if (devices.empty()) {
        fail("no Vulkan device: install a driver (Debian: mesa-vulkan-drivers; it renders on the CPU without a GPU)");
    }
    for (size_t i = 0; i < devices.size(); ++i) {
        const gpu::DeviceDescription& d = devices[i];
        fmt::print("{}  {} ({}), Vulkan {}, {}\n", i, d.name, d.kind, d.api, d.driver);
        fmt::print("   {}\n", d.missing.empty() ? "can be used" : fmt::format("lacks: {}", fmt::join(d.missing, ", ")));
        fmt::print("   beyond the floor: {}\n",
                   d.extras.empty() ? "nothing" : fmt::format("{}", fmt::join(d.extras, ", ")));
    }
}

}  // namespace

void addListCommand(CLI::App& app) {
    CLI::App* command = app.add_subcommand("list", "List scenes, presets, shows, settings or devices");
    const std::vector<std::pair<const char*, void (*)()>> lists{
        {"scenes", listScenes}, {"presets", listPresets},   {"shows", listShows},
        {"settings", listSettings}, {"devices", listDevices}};
    const char* descriptions[] = {"Built-in scenes", "Presets of settings", "Images of the frame for --show and --aov",
                                  "Settings for --set, with range and default", "Vulkan devices for --device"};
    for (size_t i = 0; i < lists.size(); ++i) {
        command->add_subcommand(lists[i].first, descriptions[i])->callback(lists[i].second);
    }
    command->require_subcommand(1);
}

}  // namespace reflet
