// `reflet reference`: path traces a reference image on the CPU.
#include "base/error.h"
#include "base/interrupt.h"
#include "base/progress.h"
#include "capture/pictures.h"
#include "capture/show.h"
#include "cli/commands.h"
#include "cli/output_files.h"
#include "cli/reference_options.h"
#include "cli/scene_arguments.h"
#include "cli/sequence_arguments.h"
#include "effects/exposure/exposure.h"
#include "job/film.h"
#include "job/sequence_files.h"
#include "job/sequence_plan.h"
#include "job/sequence_record.h"
#include "job/sequence_views.h"
#include "reference/sample_progress.h"
#include "reference/shutter.h"
#include "renderer/background/background.h"
#include "renderer/scene_exposure/scene_exposure.h"
#include "scene/image_camera.h"
#include "scene/pose.h"

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <functional>
#include <memory>
#include <new>

namespace reflet {

namespace {

/// What is traced, and how.
struct TraceJob {
    const ReferenceCommand& command;
    const Settings& settings;
    const ReferenceOptions& options;
    const Scene& scene;
    const View& view;
    uvec2 size;
    const Films& films;
};

ReferencePicture tracePicture(const TraceJob& job, const SequenceViews& views, uint32_t frame, uint32_t seed,
                              const std::function<void(const ReferenceProgress&)>& show) {
    ReferenceOptions options = job.options;
    options.seed = seed;
    const auto proceed = [&](const ReferenceProgress& now) {
        show(now);
        return !InterruptNote::arrived();
    };
    const double open = job.command.shutter;
    const auto during = [&](double share) { return views.at(frame + open * (share - 0.5)); };
    try {
        return open > 0.0 ? traceShutter(job.scene, during, job.size, options, proceed)
                          : traceReference(job.scene, views.of(frame), job.size, options, proceed);
    } catch (const std::bad_alloc&) {
        fail("not enough memory for an image of {}x{} pixels: choose a smaller --size", job.size.x, job.size.y);
    }
}

bool wasInterrupted(const TraceJob& job, const ReferencePicture& picture) {
    return !picture.complete && picture.samples < job.options.samples;
}

// Those that are asked for, in that order, and first an unnamed copy of the first, which every viewer shows.
std::vector<ImageLayer> chosenLayers(const ReferencePicture& picture, const ReferenceCommand& command) {
    std::vector<ImageLayer> all = picture.layers();
    if (command.layers.empty()) {
        return all;
    }
    std::vector<ImageLayer> chosen;
    for (const std::string& name : command.layers) {
        const auto found = std::ranges::find(all, name, &ImageLayer::name);
        if (chosen.empty()) {
            chosen.push_back({"", found->image});
        }
        chosen.push_back(*found);
    }
    return chosen;
}

std::vector<ImageLayer> layersOf(const ReferencePicture& picture, const ReferenceCommand& command,
                                 const Background& background) {
    std::vector<ImageLayer> layers = chosenLayers(picture, command);
    const bool showsFinal = command.layers.empty() || command.layers.front() == "final";
    for (ImageLayer& layer : layers) {
        if (background.needsCoverage() && ((layer.name.empty() && showsFinal) || layer.name == "final")) {
            layer.image = withAlpha(layer.image, picture.coverage);
        }
    }
    return layers;
}

void writePicture(const TraceJob& job, const View& view, const std::string& file, const ReferencePicture& picture,
                  const TonemapSettings& tonemap) {
    const Background& background = view.background;
    const std::vector<std::string>& layers = job.command.layers;
    if (isExr(file)) {
        writeExr(file, layersOf(picture, job.command, background), imageCamera(posed(view, job.scene), job.size));
    } else if (!layers.empty() && layers.front() != "final") {
        writePng(file, makePicture(findShow(layers.front()), chosenLayers(picture, job.command).front().image));
    } else {
        writePng(file, displayedOver(picture.final, picture.coverage, background, tonemap));
    }
}

std::string raysText(uint64_t rays, double seconds) {
    constexpr double million = 1e6;
    const double millions = static_cast<double>(rays) / million;
    return fmt::format("{:.2f} million rays in {:.2f} s: {:.2f} million rays per second", millions, seconds,
                       millions / std::max(seconds, 1.0 / million));
}

std::string summary(const ReferencePicture& picture) {
    return fmt::format(
        "{}, noise {}; {}",
        picture.samples == 1 ? "1 sample per pixel" : fmt::format("{} samples per pixel", picture.samples),
        picture.samples == 1 ? "unknown" : fmt::format("{:.3g}", picture.noise),
        raysText(picture.rays, picture.seconds));
}

// The summary, unless a script wants none.
void tellTraced(const TraceJob& job, const std::string& text) {
    if (!job.command.script.quiet && !job.command.script.json) {
        fmt::print("{}\n", text);
    }
}

void traceOne(const TraceJob& job) {
    const InterruptNote note;
    SampleProgress progress("tracing", job.options, job.size);
    const ReferencePicture picture =
        tracePicture(job, SequenceViews(job.view, job.scene, job.command.sequence, 1), 0, job.options.seed,
                     [&](const ReferenceProgress& now) { progress.set(now); });
    const TonemapSettings tonemap = exposedAs(job.settings.tonemap, job.scene, picture.final, picture.depth);
    for (const std::string& file : job.command.outputs) {
        writePicture(job, job.view, file, picture, tonemap);
    }
    if (wasInterrupted(job, picture)) {
        fail("interrupted after {} of {} samples per pixel; {} {} the samples so far", picture.samples,
             job.options.samples, fmt::join(job.command.outputs, ", "),
             job.command.outputs.size() == 1 ? "holds" : "hold");
    }
    tellTraced(job, fmt::format("{}{}", summary(picture),
                                exposesAutomatically(job.settings.tonemap, job.scene)
                                    ? fmt::format("; exposure {:+.2f} stops", tonemap.exposure)
                                    : ""));
    printResult(job.command.script, {{"outputs", job.command.outputs},
                                     {"size", {job.size.x, job.size.y}},
                                     {"samples", picture.samples},
                                     {"noise", picture.noise},
                                     {"rays", picture.rays},
                                     {"seconds", picture.seconds}});
}

// Everything that the images depend on: equal in all shares and, except for an orbit, for any number of frames.
nlohmann::ordered_json makeRecord(const TraceJob& job, const FrameNames& names) {
    const ReferenceCommand& c = job.command;
    const ReferenceOptions& o = job.options;
    nlohmann::ordered_json record = commonRecord(c.scene, c.sequence, c.frames, job.view);
    record["reference"] = {{"samples", o.samples},   {"noise", o.noise},
                           {"bounces", o.bounces},   {"filter", c.filter},
                           {"sampling", c.sampling}, {"visible_only", o.visibleOnly},
                           {"pinhole", o.pinhole},   {"lambert_only", o.lambertOnly},
                           {"layers", c.layers}};
    if (o.clamp > 0.0F) {
        record["reference"]["clamp"] = o.clamp;
    }
    if (c.shutter > 0.0F) {
        record["reference"]["shutter"] = c.shutter;
    }
    if (o.ambientOcclusion) {
        record["reference"]["ao"] = {o.aoRadius, o.aoFalloff};
    }
    if (!isExr(names.pattern())) {
        for (const SettingEntry& entry : settingEntries()) {
            if (entry.name.starts_with("tonemap.")) {
                record["settings"][entry.name] = settingText(job.settings, entry);
            }
        }
    }
    return record;
}

// Every frame has other noise, which depends on its number alone; the first has that of a single image.
uint32_t frameSeed(uint32_t seed, uint32_t frame) {
    return seed + frame * 0x9E3779B9U;  // odd: no two frames share a seed
}

void traceSequence(const TraceJob& job) {
    const InterruptNote note;
    const ReferenceCommand& c = job.command;
    const SequenceViews views(job.view, job.scene, c.sequence, c.frames);
    const SequenceFiles files(c.outputs, c.sequence.firstFrame);
    for (const FrameNames& names : files.names()) {
        beginSequence(names, makeRecord(job, names), c.sequence.overwrite, printWarning);
    }
    const SequencePlan plan{.frames = c.frames};
    const Share share = parseShare(c.sequence.share);
    noteEmptyShare(plan, share);
    const auto runs = plan.runs(share, [&](uint32_t frame) { return files.isMissing(frame); });
    Progress progress("tracing frame", plan.work(runs), "frames an hour");
    uint32_t traced = 0;
    uint64_t rays = 0;
    double seconds = 0.0;
    for (const SequencePlan::Run& run : runs) {
        const auto missing = files.missing(run.begin);  // another process may have made some in the meantime
        if (!missing.empty()) {
            const View view = views.of(run.begin);
            const ReferencePicture picture =
                tracePicture(job, views, run.begin, frameSeed(job.options.seed, run.begin), [](const auto&) {});
            if (wasInterrupted(job, picture)) {
                fail("interrupted after {} frames; run the same command again to continue", traced);
            }
            const TonemapSettings tonemap = exposedAs(job.settings.tonemap, job.scene, picture.final, picture.depth);
            for (const auto& file : missing) {
                writePicture(job, view, file.string(), picture, tonemap);
            }
            ++traced;
            rays += picture.rays;
            seconds += picture.seconds;
        }
        progress.advance();
    }
    tellTraced(job, fmt::format("{} of {} frames traced; {}", traced, c.frames, raysText(rays, seconds)));
    std::vector<std::string> written = job.films.write(c.sequence.fps, c.sequence.firstFrame, c.frames);
    std::ranges::copy_if(c.outputs, std::back_inserter(written),
                         [&](const std::string& file) { return !job.films.hasFrames(file); });
    printResult(c.script, {{"outputs", written},
                           {"size", {job.size.x, job.size.y}},
                           {"frames", c.frames},
                           {"rendered", traced},
                           {"rays", rays},
                           {"seconds", seconds}});
}

void trace(const ReferenceCommand& asked) {
    const uvec2 size = parseSize(asked.scene.size);
    checkReferenceCommand(asked, size);
    ReferenceCommand command = asked;
    const Films films(command.outputs, size.x, size.y);
    const Settings settings = loadSettings(command.scene);
    const ReferenceOptions options = referenceOptions(command, settings);
    std::vector<std::string> outputs = films.names();
    outputs.push_back(command.scene.saveView);
    tryOutputs(outputs, inputFiles(command.scene));
    checkOutputs(command.outputs, inputFiles(command.scene, {command.sequence.path}), "reference");
    const bool sequence = isSequence(command.outputs, command.sequence, command.frames);
    const Scene scene = loadScene(command.scene);
    const View view = loadView(command.scene, scene);
    const TraceJob job{command, settings, options, scene, view, size, films};
    if (sequence) {
        traceSequence(job);
    } else {
        traceOne(job);
    }
}

}  // namespace

void addReferenceCommand(CLI::App& app) {
    auto options = std::make_shared<ReferenceCommand>();
    CLI::App* command = app.add_subcommand("reference", "Path trace a scene on the CPU: the ground truth");
    const std::vector<const CLI::Option*> sequenceOptions = addReferenceOptions(*command, *options);
    command->callback([options, sequenceOptions] {
        std::vector<const CLI::Option*> forSequences = sequenceOptions;
        if (options->shutter > 0.0F) {  // of --fps' frames
            std::erase_if(forSequences, [](const CLI::Option* o) { return o->get_name() == "--fps"; });
        }
        checkSequenceOptions(forSequences, options->outputs);
        trace(*options);
    });
}

}  // namespace reflet
