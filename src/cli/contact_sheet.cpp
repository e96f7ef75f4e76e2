// `reflet contact-sheet`: many pictures on one, with their names. Scenes are rendered.
#include "job/contact_sheet.h"
#include "base/error.h"
#include "base/progress.h"
#include "cli/commands.h"
#include "cli/device_options.h"
#include "cli/in_range.h"
#include "cli/output_files.h"
#include "cli/script_arguments.h"
#include "compare/picture_input.h"
#include "device/device.h"
#include "effects/tonemap/tone_map_image.h"
#include "job/still.h"
#include "renderer/renderer.h"

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <map>
#include <memory>

namespace reflet {

namespace {

namespace fs = std::filesystem;

constexpr size_t mostPictures = 10000;

struct SheetCommand {
    std::vector<std::string> files;
    std::string output;
    std::string cell = "320x240";
    SheetOptions sheet;
    std::string names = "file";
    std::string environment;
    std::string effort = "draft";
    std::string device;
    ScriptOptions script;
};

bool isScene(const std::string& file) {
    const std::string ending = fs::path(file).extension().string();
    return file.starts_with("builtin:") || ending == ".gltf" || ending == ".glb";
}

/// Renders scenes, on one device.
class SceneRenderer {
public:
    explicit SceneRenderer(const SheetCommand& command) : command_(command) {}

    Bitmap render(const std::string& scene, uvec2 size) {
        if (!device_) {
            device_ = std::make_unique<gpu::Device>(programDevice(command_.device, false));
            requireSize(*device_, size);
        }
        RenderOptions options;
        options.effort = command_.effort;
        options.scene.scene = scene;
        options.scene.size = fmt::format("{}x{}", size.x, size.y);
        options.scene.environment = command_.environment;
        options.scene.preset = stillPreset(options);
        Settings settings = loadSettings(options.scene);
        Pictures pictures(options.show, {});
        pictures.prepare(settings);
        const Scene loaded = loadScene(options.scene);
        const View view = loadView(options.scene, loaded);
        Renderer renderer(*device_, loaded, printWarning);
        Timings timings(false);
        renderStill({options, loaded, view, settings, size, *device_, renderer, pictures, timings},
                    std::chrono::steady_clock::now());
        return pictures.bitmap(renderer.frame(), makeViewParams(view.camera, size, 0, options.scene.seed));
    }

private:
    const SheetCommand& command_;
    std::unique_ptr<gpu::Device> device_;
};

// RGB or RGBA: what libraries of pictures hold besides is grey.
Bitmap inColor(const Bitmap& bitmap) {
    if (bitmap.channels >= 3) {
        return bitmap;
    }
    Bitmap colors{bitmap.width, bitmap.height, bitmap.channels + 2, {}};
    for (size_t i = 0; i < bitmap.data.size(); i += bitmap.channels) {
        colors.data.insert(colors.data.end(), 3, bitmap.data[i]);
        if (bitmap.channels == 2) {
            colors.data.push_back(bitmap.data[i + 1]);
        }
    }
    return colors;
}

// What is no colour, depth for instance, is grey.
FloatImage asColors(const FloatImage& image, const std::string& name) {
    const size_t channels = image.channels.size();
    if (channels == 3) {
        return image;
    }
    if (channels != 1) {
        failUsage("{}: has {} channels; a contact sheet shows 1 or 3", name, channels);
    }
    FloatImage colors{image.width, image.height, {"R", "G", "B"}, {}};
    for (const float value : image.data) {
        colors.data.insert(colors.data.end(), 3, value);
    }
    return colors;
}

Bitmap readAny(const std::string& file) {
    const PictureName name = parsePictureName(file);
    if (name.kind == ImageKind::linear) {
        return toneMapped(asColors(readPicture(name), file), TonemapSettings{});
    }
    return inColor(readBitmap(file));
}

// "a.png"; of several files of that name "first/a.png" and so on.
std::vector<std::string> namesOf(const SheetCommand& command) {
    std::map<std::string, int> times;
    for (const std::string& file : command.files) {
        ++times[fs::path(file).filename().string()];
    }
    std::vector<std::string> names;
    for (const std::string& file : command.files) {
        const fs::path path(file);
        const std::string last = path.filename().string();
        const bool alone = times[last] == 1 || !path.has_parent_path();
        names.push_back(command.names == "none"                    ? ""
                        : command.names == "path" || isScene(file) ? file
                        : alone                                    ? last
                                                                   : (path.parent_path().filename() / last).string());
    }
    return names;
}

void contactSheet(const SheetCommand& command) {
    const auto start = std::chrono::steady_clock::now();
    if (command.files.size() > mostPictures) {
        failUsage("{} files; a contact sheet can have {}", command.files.size(), mostPictures);
    }
    if (fs::path(command.output).extension() != ".png") {
        failUsage("-o {}: the name must end in .png", command.output);
    }
    SheetOptions options = command.sheet;
    options.cell = parseSize(command.cell);
    tryOutputs({command.output}, {command.files, {}});
    SceneRenderer renderer(command);
    const std::vector<std::string> names = namesOf(command);
    std::vector<SheetPicture> pictures;
    Progress progress("picture", command.files.size());
    for (size_t i = 0; i < command.files.size(); ++i) {
        const std::string& file = command.files[i];
        pictures.push_back(
            {names[i], isScene(file) ? renderer.render(file, options.cell) : fitted(readAny(file), options.cell)});
        progress.advance();
    }
    const Bitmap sheet = contactSheet(pictures, options);
    writePng(command.output, sheet);
    tellWritten(fmt::format("{} ({} pictures)", command.output, pictures.size()));
    printResult(command.script,
                {{"outputs", {command.output}},
                 {"size", {sheet.width, sheet.height}},
                 {"pictures", pictures.size()},
                 {"columns", sheetColumns(options, pictures.size())},
                 {"seconds", std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count()}});
}

}  // namespace

void addContactSheetCommand(CLI::App& app) {
    auto options = std::make_shared<SheetCommand>();
    CLI::App* command =
        app.add_subcommand("contact-sheet", "Put many pictures on one sheet, with their names; scenes are rendered");
    command
        ->add_option(
            "FILES", options->files,
            "Pictures, .png, .jpg, .hdr, .exr or a layer, FILE.exr:LAYER; or scenes, .gltf, .glb, builtin:NAME")
        ->required();
    command->add_option("-o,--output", options->output, "The sheet, .png")->required()->type_name("FILE.png");
    command->add_option("--cell", options->cell, "Pixels for each picture, which is scaled down to fit")
        ->type_name("WxH")
        ->capture_default_str();
    command->add_option("--columns", options->sheet.columns, "Pictures in a row, 1 to 1000 [for a sheet of about 16:9]")
        ->check(inRange(1U, 1000U))
        ->type_name("N");
    command->add_option("--gap", options->sheet.gap, "Pixels between the pictures, 0 to 200")
        ->check(inRange(0U, 200U))
        ->type_name("PIXELS")
        ->capture_default_str();
    command->add_option("--names", options->names, "What stands below each picture")
        ->check(CLI::IsMember({"file", "path", "none"}))
        ->type_name("file|path|none")
        ->capture_default_str();
    command
        ->add_option("--environment", options->environment,
                     "Of scenes: sky, studio, none or an equirectangular image [their own, or sky]")
        ->type_name("sky|studio|none|FILE");
    command
        ->add_option("--effort", options->effort, "Of scenes: draft (up to 8 s each), normal (30 s) or high (10 min)")
        ->check(CLI::IsMember({"draft", "normal", "high"}))
        ->type_name("draft|normal|high")
        ->capture_default_str();
    addDeviceOption(*command, options->device);
    addScriptOptions(*command, options->script);
    command->footer(
        "Linear pictures (.exr, .hdr) are tone mapped as by reflet render, without exposure.\n"
        "Example: reflet contact-sheet a.png b.png c.exr:albedo -o sheet.png\n"
        "reflet contact-sheet assets/*.glb --cell 480x360 --columns 4 -o assets.png");
    command->callback([options] { contactSheet(*options); });
}

}  // namespace reflet
