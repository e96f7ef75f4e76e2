// Renders sequences.
#include "capture/sequence.h"

#include "base/error.h"
#include "base/interrupt.h"
#include "base/json.h"
#include "base/progress.h"
#include "capture/sequence_names.h"
#include "capture/sequence_plan.h"
#include "capture/sequence_record.h"
#include "renderer/history.h"
#include "scene/camera_path.h"
#include "scene/pose.h"
#include "version.h"

#include <algorithm>
#include <filesystem>
#include <limits>
#include <optional>

namespace reflet {

namespace {

namespace fs = std::filesystem;
constexpr std::string_view orbitPath = "orbit";

SequencePlan makePlan(const RenderJob& job) {
    const SequenceOptions& o = job.options.sequence;
    const bool history = historyUse(job.settings, job.scene).any();
    const bool motion = job.pictures.contains("motion");  // relative to the previous frame
    SequencePlan plan{.frames = job.options.frames};
    if (history || motion) {
        plan.segment = o.segment == 0 ? plan.frames : o.segment;
        plan.warmUp = std::max(history ? o.warmUp : 0, motion ? 1U : 0U);
    }
    return plan;
}

/// The views of a sequence's frames.
class Views {
public:
    explicit Views(const RenderJob& job) : first_(job.view), options_(job.options) {
        if (options_.sequence.path == orbitPath) {
            first_.camera = posed(first_, job.scene).camera;
            pivot_ = job.scene.nodes.empty() ? orbitPivot(first_.camera, job.scene)
                                             : orbitPivot(first_.camera, frozen(job.scene, first_.time));
        } else if (!options_.sequence.path.empty()) {
            path_ = loadCameraPath(options_.sequence.path, first_.camera);
            path_->checkFocus(job.scene, options_.sequence.path);
        }
        const double last = first_.time + (options_.frames - 1) / options_.sequence.fps;
        if (last > View::largestTime) {
            failUsage("the last frame is at {:g} seconds; the largest time is {:g}", last, View::largestTime);
        }
    }

    /// frame: counted from 0.
    [[nodiscard]] View of(uint32_t frame) const {
        View view = first_;
        view.time += frame / options_.sequence.fps;
        if (pivot_) {
            view.camera = orbit(view.camera, *pivot_, static_cast<double>(frame) / options_.frames);
        } else if (path_) {
            view.camera = path_->at(view.time);
        }
        return view;
    }

private:
    View first_;
    const RenderOptions& options_;
    std::optional<vec3> pivot_;
    std::optional<CameraPath> path_;
};

nlohmann::ordered_json pathRecord(const RenderOptions& options) {
    if (options.sequence.path == orbitPath) {
        return {{"orbit_frames", options.frames}};
    }
    return options.sequence.path.empty() ? nlohmann::json() : parseJsonFile(options.sequence.path);
}

// Everything that the images depend on: equal in all shares and, except for an orbit, for any number of frames.
nlohmann::ordered_json makeRecord(const RenderJob& job, const SequencePlan& plan, const FrameNames& names) {
    const RenderOptions& o = job.options;
    nlohmann::ordered_json settings;
    for (const SettingEntry& entry : settingEntries()) {
        settings[entry.name] = settingText(job.settings, entry);
    }
    nlohmann::ordered_json record{{"reflet", versionText},
                                  {"device", job.device.description().name},
                                  {"scene", fs::path(o.scene.scene).filename().string()},
                                  {"scene_fingerprint", sceneFingerprint(o.scene.scene)},
                                  {"scene_index", o.scene.sceneIndex.value_or(-1)},
                                  {"variant", o.scene.variant},
                                  {"size", {job.size.x, job.size.y}},
                                  {"seed", o.scene.seed},
                                  {"first_frame", o.sequence.firstFrame},
                                  {"fps", o.sequence.fps},
                                  {"segment", plan.segment},
                                  {"warm_up", plan.warmUp},
                                  {"show", o.show},
                                  {"view", recordOf(job.view)},
                                  {"path", pathRecord(o)}};
    if (isExr(names.pattern())) {
        record["aov"] = o.aovs;
    }
    record["settings"] = settings;
    return record;
}

/// Renders frames consecutively and writes those that are missing.
class Writer {
public:
    Writer(const RenderJob& job, const std::vector<FrameNames>& outputs) : job_(job), outputs_(outputs), views_(job) {}

    [[nodiscard]] bool isMissing(uint32_t frame) const { return !missing(frame).empty(); }

    // The noise depends on the frame's number in the sequence, so that shares and resumed runs give the same images.
    void render(const SequencePlan& plan, const SequencePlan::Run& run, Progress& progress) {
        job_.renderer.restart(run.begin);
        for (uint32_t i = 0; i < plan.warmUp; ++i) {
            const uint32_t before = plan.warmUp - i;
            job_.renderer.render(views_.of(run.begin - std::min(before, run.begin)), job_.size, seed(), job_.settings);
            stopIfAsked();
            progress.advance();
        }
        for (uint32_t frame = run.begin; frame < run.end; ++frame) {
            renderFrame(frame);
            stopIfAsked();
            progress.advance();
        }
    }

private:
    [[nodiscard]] uint32_t seed() const { return job_.options.scene.seed; }

    [[nodiscard]] std::vector<fs::path> missing(uint32_t frame) const {
        std::vector<fs::path> files;
        for (const FrameNames& names : outputs_) {
            fs::path file = names.file(job_.options.sequence.firstFrame + frame);
            // A folder of that name is none: writing the frame says that it is in the way.
            if (std::error_code ignored; !fs::is_regular_file(file, ignored)) {
                files.push_back(std::move(file));
            }
        }
        return files;
    }

    void renderFrame(uint32_t frame) {
        const std::vector<fs::path> files = missing(frame);
        const View view = views_.of(frame);
        job_.renderer.render(view, job_.size, seed(), job_.settings, [&](gpu::Frame& f, const FrameImages& images) {
            if (!files.empty()) {
                job_.pictures.request(f, images, job_.settings.traceScreen.countSteps != 0);
            }
        });
        if (files.empty()) {
            return;
        }
        const ViewParams params = makeViewParams(view.camera, job_.size, 0, seed());
        for (const fs::path& file : files) {
            job_.pictures.write(file.string(), job_.renderer.frame(), params);
        }
        job_.timings.add(job_.renderer.frame().passTimes());
        ++written_;
    }

    void stopIfAsked() const {
        if (InterruptNote::arrived()) {
            fail("interrupted after {} frames; run the same command again to continue", written_);
        }
    }

    const RenderJob& job_;
    const std::vector<FrameNames>& outputs_;
    Views views_;
    uint32_t written_ = 0;
};

void checkNumbers(const SequenceOptions& o, uint32_t frames) {
    if (!(o.fps > 0.0 && o.fps <= 1e6)) {
        failUsage("--fps must be more than 0 and at most 1e6, is {:g}", o.fps);
    }
    if (o.firstFrame > std::numeric_limits<uint32_t>::max() - frames) {
        failUsage("--first-frame {}: the numbers of {} frames do not fit in 32 bits", o.firstFrame, frames);
    }
    if (const Share share = parseShare(o.share); o.overwrite && share.count > 1) {
        failUsage(
            "--overwrite would remove the other shares' frames: remove all files by hand, or render without --share");
    }
}

}  // namespace

bool isSequence(const RenderOptions& options) {
    const auto single = std::ranges::find_if_not(options.outputs, FrameNames::isPattern);
    if (std::ranges::none_of(options.outputs, FrameNames::isPattern)) {
        return false;
    }
    if (single != options.outputs.end()) {
        failUsage("-o {}: either every name needs a run of # for the frame number, or none", *single);
    }
    checkNumbers(options.sequence, options.frames);
    return true;
}

bool renderSequence(const RenderJob& job) {
    const InterruptNote note;
    const SequencePlan plan = makePlan(job);
    const std::vector<FrameNames> outputs(job.options.outputs.begin(), job.options.outputs.end());
    Writer writer(job, outputs);
    for (const FrameNames& names : outputs) {
        beginSequence(names, makeRecord(job, plan, names), job.options.sequence.overwrite, printWarning);
    }
    const auto runs =
        plan.runs(parseShare(job.options.sequence.share), [&](uint32_t frame) { return writer.isMissing(frame); });
    Progress progress("rendering frame", plan.work(runs));
    for (const SequencePlan::Run& run : runs) {
        writer.render(plan, run, progress);
    }
    return !runs.empty();
}

}  // namespace reflet
