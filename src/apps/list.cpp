// `reflet list`: lists scenes, presets, shows, settings and devices.
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
        fmt::print("{:<18} {}\n                   {}\n", preset.name, preset.description, preset.json);
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

const char* typeName(SettingType type) {
    switch (type) {
        case SettingType::real:
            return "number";
        case SettingType::integer:
            return "whole number";
        case SettingType::toggle:
            return "switch";
        default:
            return "choice";
    }
}

// docs/settings.md. No help text has a vertical bar in it.
void listSettingsAsMarkdown() {
    fmt::print(
        "# Settings\n\nMade by `reflet list settings --markdown`. To change it, change the tables in `src/render/`.\n\n"
        "On the command line: `--set EFFECT.NAME=VALUE`. In a file for `--settings`:\n"
        "`{{ \"EFFECT\": {{ \"NAME\": VALUE }} }}`, a choice as text, a switch as `true` or `false`.\n");
    const Settings defaults;
    std::string lastEffect;
    for (const SettingEntry& entry : settingEntries()) {
        if (const std::string effect = entry.name.substr(0, entry.name.find('.')); effect != lastEffect) {
            fmt::print("\n## {}\n\n| name | type | default | range | what it is |\n|---|---|---|---|---|\n", effect);
            lastEffect = effect;
        }
        fmt::print("| `{}` | {} | {} | {} | {} |\n", entry.name, typeName(entry.info.type),
                   settingText(defaults, entry), rangeText(entry.info), entry.info.help);
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
        fmt::print("   {}\n", d.missing.empty() ? "supported"
                                                : fmt::format("not supported, lacks: {}", fmt::join(d.missing, ", ")));
        fmt::print("   optional features: {}\n",
                   d.extras.empty() ? "none" : fmt::format("{}", fmt::join(d.extras, ", ")));
    }
}

}  // namespace

void addListCommand(CLI::App& app) {
    CLI::App* command = app.add_subcommand("list", "List scenes, presets, shows, settings or devices");
    const std::vector<std::pair<const char*, void (*)()>> lists{
        {"scenes", listScenes}, {"presets", listPresets}, {"shows", listShows}, {"devices", listDevices}};
    const char* descriptions[] = {"Built-in scenes", "Presets of settings", "Render targets for --show and --aov",
                                  "Vulkan devices for --device"};
    for (size_t i = 0; i < lists.size(); ++i) {
        command->add_subcommand(lists[i].first, descriptions[i])->callback(lists[i].second);
    }
    auto markdown = std::make_shared<bool>(false);
    CLI::App* settings = command->add_subcommand("settings", "Settings for --set, with range and default");
    settings->add_flag("--markdown", *markdown, "Print Markdown tables, as in docs/settings.md");
    settings->callback([markdown] { *markdown ? listSettingsAsMarkdown() : listSettings(); });
    command->require_subcommand(1);
}

}  // namespace reflet
