// `reflet list`: lists scenes, presets, shows, settings, devices, material variants; list_passes.cpp lists passes.
#include "base/error.h"
#include "base/json_text.h"
#include "base/visible_text.h"
#include "base/wrap.h"
#include "capture/show.h"
#include "cli/commands.h"
#include "cli/list_passes.h"
#include "device/device.h"
#include "renderer/presets.h"
#include "scene/builtin.h"
#include "scene/gltf/gltf.h"

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include <memory>

namespace reflet {

namespace {

void listScenes() {
    for (const BuiltinScene& scene : builtinScenes()) {
        fmt::print("builtin:{:<14} {}\n", scene.name, scene.description);
    }
}

void listPresets() {
    fmt::print("# To render with\n");
    bool study = false;
    for (const Preset& preset : presets()) {
        if (preset.study && !study) {
            fmt::print("\n# To study single methods\n");
            study = true;
        }
        fmt::print("{:<18} {}\n                   {}\n", preset.name, preset.description, preset.json);
    }
}

void listShows() {
    for (const Show& show : shows()) {
        fmt::print("{:<22} {}\n", show.name, show.description);
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

constexpr size_t listWidth = 100;

bool isChosen(const SettingEntry& entry, const std::string& name) {
    return entry.name == name || entry.name.starts_with(name + ".");
}

// A line each: name, default, the start of the help.
void listSettings() {
    const Settings defaults;
    for (const SettingEntry& entry : settingEntries()) {
        const std::string head = fmt::format("{:<31} {:<14} ", entry.name, settingText(defaults, entry));
        fmt::print("{}{}\n", head, firstWordsOf(entry.info.help, listWidth - head.size()));
    }
    fmt::print("\nreflet list settings NAME shows range and full help of a setting, or of a group such as 'shadow'.\n");
}

void describeSettings(const std::string& name) {
    const Settings defaults;
    bool found = false;
    for (const SettingEntry& entry : settingEntries()) {
        if (!isChosen(entry, name)) {
            continue;
        }
        fmt::print("{}{}  {}, default {}, {}\n", found ? "\n" : "", entry.name, typeName(entry.info.type),
                   settingText(defaults, entry), rangeText(entry.info));
        for (const std::string& line : wrapped(entry.info.help, listWidth - 4)) {
            fmt::print("    {}\n", line);
        }
        found = true;
    }
    if (!found) {
        static_cast<void>(findSetting(name));  // throws, naming the nearest
    }
}

// For programs: what there is to set, and within which limits.
void listSettingsAsJson() {
    const Settings defaults;
    auto all = nlohmann::ordered_json::array();
    for (const SettingEntry& entry : settingEntries()) {
        nlohmann::ordered_json one{
            {"name", entry.name}, {"type", typeName(entry.info.type)}, {"default", settingText(defaults, entry)}};
        if (entry.info.type == SettingType::choice) {
            for (const SettingOption& option : entry.info.options) {
                one["choices"].push_back(option.name);
            }
        } else if (entry.info.type != SettingType::toggle) {
            one["minimum"] = entry.info.lowest;
            one["maximum"] = entry.info.highest;
        }
        one["help"] = entry.info.help;
        all.push_back(std::move(one));
    }
    fmt::print("{}\n", jsonText(all, 2));
}

// docs/settings.md. No help text has a vertical bar in it.
void listSettingsAsMarkdown() {
    fmt::print(
        "# Settings\n\nMade by `reflet list settings --markdown`. To change it, change the tables in `src/effects/` "
        "and `src/renderer/`.\n\n"
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

// Without the file's warnings: they are about what is drawn.
void listVariants(const std::string& file) {
    for (const std::string& name : loadGltf(file).variants) {
        fmt::print("{}\n", visibleText(name));
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
    CLI::App* command =
        app.add_subcommand("list", "List scenes, presets, shows, settings, devices, material variants or passes");
    const std::vector<std::pair<const char*, void (*)()>> lists{
        {"scenes", listScenes}, {"presets", listPresets}, {"shows", listShows}, {"devices", listDevices}};
    const char* descriptions[] = {"Built-in scenes", "Presets of settings", "Render targets for --show and --aov",
                                  "Vulkan devices for --device"};
    for (size_t i = 0; i < lists.size(); ++i) {
        command->add_subcommand(lists[i].first, descriptions[i])->callback(lists[i].second);
    }
    struct SettingsList {
        std::string name;
        bool markdown = false;
        bool json = false;
    };
    auto o = std::make_shared<SettingsList>();
    CLI::App* settings = command->add_subcommand("settings", "Settings for --set, with defaults and help");
    settings->add_option("NAME", o->name, "A setting or a group of settings to describe in full");
    auto* markdown = settings->add_flag("--markdown", o->markdown, "Print Markdown tables, as in docs/settings.md");
    settings->add_flag("--json", o->json, "Print JSON: names, types, defaults, ranges and help")->excludes(markdown);
    settings->callback([o] {
        if (!o->name.empty()) {
            describeSettings(o->name);
        } else {
            o->markdown ? listSettingsAsMarkdown() : o->json ? listSettingsAsJson() : listSettings();
        }
    });
    auto file = std::make_shared<std::string>();
    CLI::App* variants = command->add_subcommand("variants", "Material variants of a glTF file, for --variant");
    variants->add_option("FILE", *file, "A .gltf or .glb file")->required();
    variants->callback([file] { listVariants(*file); });
    addPassesList(*command);
    command->require_subcommand(1);
}

}  // namespace reflet
