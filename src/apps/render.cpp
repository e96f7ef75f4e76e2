// `reflet render`: pictures of a scene.
#include "apps/commands.h"
#include "apps/device_options.h"
#include "apps/progress.h"
#include "apps/scene_options.h"
#include "apps/show.h"
#include "apps/timings.h"
#include "base/error.h"
#include "base/file.h"
#include "gpu/device.h"
#include "render/renderer.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <memory>

namespace reflet {

namespace {

namespace fs = std::filesystem;

struct RenderOptions {
    SceneOptions scene;
    std::vector<std::string> outputs;
    uint32_t frames = 1;
    std::string show = "final";
    std::vector<std::string> aovs;
    std::string device;
    std::string timings;
    bool validate = false;
};

bool isExr(const std::string& file) {
    return fs::path(file).extension() == ".exr";
}

void checkOutputs(const RenderOptions& options) {
    if (options.outputs.empty() && options.timings.empty() && !options.validate) {
        failUsage("nothing to write: add -o FILE.png or -o FILE.exr (reflet render --help says more)");
    }
    for (const std::string& file : options.outputs) {
        if (const auto extension = fs::path(file).extension(); extension != ".png" && extension != ".exr") {
            failUsage("-o {}: the name must end in .png or .exr", file);
        }
    }
    if (!options.aovs.empty() && std::ranges::none_of(options.outputs, isExr)) {
        failUsage("--aov needs an EXR file to go to: add -o FILE.exr");
    }
    std::vector<fs::path> all(options.outputs.begin(), options.outputs.end());
    if (!options.timings.empty()) {
        all.emplace_back(options.timings);
    }
    for (const fs::path& path : all) {  // better now than after minutes of work
        const AtomicFile trial(path);
    }
}

// What the last frame's images are copied into, and the files that are made of it.
struct Pictures {
    const Show* main = nullptr;
    std::vector<const Show*> aovs;
    std::map<const Show*, ShowReadback> readbacks;
    gpu::Readback display;

    [[nodiscard]] bool countsSteps() const {
        return reflet::countsSteps(*main) ||
               std::ranges::any_of(aovs, [](const Show* s) { return reflet::countsSteps(*s); });
    }

    void request(gpu::Frame& f, const FrameImages& images, bool rays) {
        std::vector<const Show*> wanted = aovs;
        wanted.push_back(main);
        if (rays) {
            for (const char* name : {"diffuse_steps", "specular_steps", "diffuse_confidence", "specular_confidence"}) {
                wanted.push_back(&findShow(name));
            }
        }
        for (const Show* show : wanted) {
            if (!readbacks.contains(show)) {
                readbacks.emplace(show, requestShow(f, images, *show));
            }
        }
        display = f.readback(images.display);
    }

    // Of the rays of each lobe: mean depth samples, and the share that the screen answered.
    [[nodiscard]] nlohmann::ordered_json rayStatistics(const gpu::Frame& f, const ViewParams& view) const {
        nlohmann::ordered_json json;
        for (const std::string lobe : {"diffuse", "specular"}) {
            const FloatImage steps = fetchValues(f, readbacks.at(&findShow(lobe + "_steps")), view);
            const FloatImage hits = fetchValues(f, readbacks.at(&findShow(lobe + "_confidence")), view);
            double pixels = 0.0;
            double stepSum = 0.0;
            double hitSum = 0.0;
            for (size_t i = 0; i < steps.data.size(); ++i) {
                pixels += steps.data[i] > 0.0F ? 1.0 : 0.0;  // others have no rays
                stepSum += steps.data[i];
                hitSum += hits.data[i];
            }
            json[lobe] = {{"steps", stepSum / std::max(pixels, 1.0)}, {"hits", hitSum / std::max(pixels, 1.0)}};
        }
        return json;
    }

    void writePngFile(const std::string& file, const gpu::Frame& f, const ViewParams& view, uvec2 size) const {
        writePng(file, main->picture == nullptr ? fetchDisplay(f, display, size)
                                                : makePicture(*main, fetchValues(f, readbacks.at(main), view)));
    }

    // The --show image under plain channel names, so that every viewer opens it; then a named layer for each AOV.
    void writeExrFile(const std::string& file, const gpu::Frame& f, const ViewParams& view) const {
        std::vector<ImageLayer> layers{{"", fetchValues(f, readbacks.at(main), view), PixelType::float32}};
        for (const Show* aov : aovs) {
            layers.push_back({std::string(aov->name), fetchValues(f, readbacks.at(aov), view), PixelType::float32});
        }
        writeExr(file, layers);
    }
};

Pictures choosePictures(const RenderOptions& options) {
    Pictures pictures;
    pictures.main = &findShow(options.show);
    for (const std::string& name : options.aovs) {
        const Show* aov = &findShow(name);
        if (std::ranges::find(pictures.aovs, aov) == pictures.aovs.end()) {
            pictures.aovs.push_back(aov);
        }
    }
    const auto ownSize = [](const Show* s) { return hasOwnSize(*s); };
    if (const auto found = std::ranges::find_if(pictures.aovs, ownSize); found != pictures.aovs.end()) {
        failUsage("--aov {0}: it has a size of its own; render it alone with --show {0}", (*found)->name);
    }
    if (hasOwnSize(*pictures.main) && !pictures.aovs.empty()) {
        failUsage("--show {} has a size of its own and cannot share a file with --aov", pictures.main->name);
    }
    return pictures;
}

void render(const RenderOptions& options) {
    const uvec2 size = parseSize(options.scene.size);
    Settings settings = loadSettings(options.scene);
    Pictures pictures = choosePictures(options);
    if (pictures.countsSteps()) {
        settings.traceScreen.countSteps = 1;
    }
    checkOutputs(options);
    const Scene scene = loadScene(options.scene);
    const View view = loadView(options.scene, scene);

    gpu::Device device({.select = options.device, .validation = options.validate, .onMessage = printWarning});
    requireSize(device, size);
    Renderer renderer(device, scene, printWarning);
    Timings timings;
    Progress progress("rendering", options.frames);
    for (uint32_t i = 0; i < options.frames; ++i) {
        const bool last = i + 1 == options.frames;
        renderer.render(view, size, options.scene.seed, settings, [&](gpu::Frame& f, const FrameImages& images) {
            if (last) {
                pictures.request(f, images, settings.traceScreen.countSteps != 0);
            }
        });
        timings.add(renderer.frame().passTimes());
        progress.advance();
    }
    const ViewParams params = makeViewParams(view.camera, size, 0, options.scene.seed);
    for (const std::string& file : options.outputs) {
        if (isExr(file)) {
            pictures.writeExrFile(file, renderer.frame(), params);
        } else {
            pictures.writePngFile(file, renderer.frame(), params, size);
        }
    }
    if (!options.timings.empty()) {
        nlohmann::ordered_json json = timings.json(device.description().name, size);
        if (settings.traceScreen.countSteps != 0) {
            json["rays"] = pictures.rayStatistics(renderer.frame(), params);
        }
        writeFileAtomically(options.timings, json.dump(2) + "\n");
    }
    if (options.validate && !device.validationMessages().empty()) {
        fail("the validation layers had {} messages", device.validationMessages().size());
    }
}

}  // namespace

void addRenderCommand(CLI::App& app) {
    auto options = std::make_shared<RenderOptions>();
    CLI::App* command = app.add_subcommand("render", "Render a scene to PNG or EXR");
    addSceneOptions(*command, options->scene);
    command->add_option("-o,--output", options->outputs, "Where the picture goes, .png or .exr; may be repeated")
        ->type_name("FILE")
        ->allow_extra_args(false);
    command->add_option("--frames", options->frames, "Frames to render; the last one is written")
        ->check(CLI::Range(1U, 1000000U))
        ->capture_default_str();
    command->add_option("--show", options->show, "Which image of the frame (reflet list shows)")
        ->type_name("NAME")
        ->capture_default_str();
    command->add_option("--aov", options->aovs, "More images, as named layers of the EXR files")
        ->type_name("A,B,...")
        ->allow_extra_args(false)
        ->delimiter(',');
    addDeviceOption(*command, options->device);
    command
        ->add_option(
            "--timings", options->timings,
            "Device time of every pass: medians over the frames after the first; with trace_screen.countSteps also "
            "mean steps and share of hits of the last frame's rays")
        ->type_name("F.json");
    command->add_flag("--validate", options->validate,
                      "Run under the Vulkan validation layers; any message is a failure");
    command->footer(
        "Example: reflet render scene.glb --size 640x360 --set diffuse.rays=16 -o picture.png -o values.exr --aov "
        "direct,normal");
    command->callback([options] { render(*options); });
}

}  // namespace reflet
