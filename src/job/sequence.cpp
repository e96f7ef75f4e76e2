// Renders sequences.
#include "job/sequence.h"

#include "base/error.h"
#include "base/interrupt.h"
#include "base/progress.h"
#include "job/sequence_files.h"
#include "job/sequence_plan.h"
#include "job/sequence_record.h"
#include "job/sequence_views.h"
#include "renderer/history.h"
#include "scene/pose.h"

#include <algorithm>
#include <filesystem>

namespace reflet {

namespace {

SequencePlan makePlan(const RenderJob& job, const SequenceViews& views) {
    const SequenceOptions& o = job.options.sequence;
    const bool history = historyUse(job.settings, job.scene).any();
    const bool motion = job.pictures.contains("motion");  // relative to the previous frame
    SequencePlan plan{.frames = job.options.frames};
    if (history || motion) {
        plan.segment = o.segment == 0 ? plan.frames : o.segment;
        plan.warmUp = std::max(history ? o.warmUp : 0, motion ? 1U : 0U);
        plan.cuts = views.cuts(job.scene);
    }
    return plan;
}

// Everything that the images depend on: equal in all shares and, except for an orbit, for any number of frames.
nlohmann::ordered_json makeRecord(const RenderJob& job, const SequencePlan& plan, const FrameNames& names) {
    const RenderOptions& o = job.options;
    nlohmann::ordered_json record = commonRecord(o.scene, o.sequence, o.frames, job.view);
    record["device"] = job.device.description().name;
    record["segment"] = plan.segment;
    record["warm_up"] = plan.warmUp;
    record["show"] = o.show;
    if (isExr(names.pattern())) {
        record["aov"] = o.aovs;
    }
    nlohmann::ordered_json& settings = record["settings"];
    for (const SettingEntry& entry : settingEntries()) {
        settings[entry.name] = settingText(job.settings, entry);
    }
    return record;
}

/// Renders frames consecutively and writes those that are missing.
class Writer {
public:
    Writer(const RenderJob& job, const SequenceFiles& files, const SequenceViews& views)
        : job_(job), files_(files), views_(views) {}

    // The noise depends on the frame's number in the sequence, so that shares and resumed runs give the same images.
    void render(const SequencePlan& plan, const SequencePlan::Run& run, Progress& progress) {
        job_.renderer.restart(run.begin);
        const uint32_t known = run.begin - plan.shotOf(run.begin);
        for (uint32_t i = 0; i < plan.warmUp; ++i) {
            const uint32_t before = plan.warmUp - i;
            tryTo([&] {
                job_.renderer.render(views_.of(run.begin - std::min(before, known)), job_.size, seed(), job_.settings);
            });
            stopIfAsked();
            progress.advance();
        }
        for (uint32_t frame = run.begin; frame < run.end; ++frame) {
            tryTo([&] { renderFrame(frame); });
            stopIfAsked();
            progress.advance();
        }
    }

    [[nodiscard]] uint32_t written() const { return written_; }

private:
    [[nodiscard]] uint32_t seed() const { return job_.options.scene.seed; }

    void renderFrame(uint32_t frame) {
        const std::vector<std::filesystem::path> files = files_.missing(frame);
        const View view = views_.of(frame);
        job_.renderer.render(view, job_.size, seed(), job_.settings, [&](gpu::Frame& f, const FrameImages& images) {
            if (!files.empty()) {
                job_.pictures.request(f, images, job_.settings.traceScreen.countSteps != 0);
            }
        });
        if (files.empty()) {
            return;
        }
        for (const std::filesystem::path& file : files) {
            job_.pictures.write(file.string(), job_.renderer.frame(), posed(view, job_.scene), job_.size);
        }
        job_.timings.add(job_.renderer.frame().passTimes());
        ++written_;
    }

    // A device that is lost, or a disk that is full, ends the run; what is written stays.
    template <class F>
    void tryTo(const F& draw) const {
        try {
            draw();
        } catch (const UsageError&) {
            throw;
        } catch (const Error& error) {
            fail("{}; {} frames are written: run the same command again to continue", error.what(), written_);
        }
    }

    void stopIfAsked() const {
        if (InterruptNote::arrived()) {
            fail("interrupted after {} frames; run the same command again to continue", written_);
        }
    }

    const RenderJob& job_;
    const SequenceFiles& files_;
    const SequenceViews& views_;
    uint32_t written_ = 0;
};

}  // namespace

uint32_t renderSequence(const RenderJob& job) {
    const InterruptNote note;
    const SequenceViews views(job.view, job.scene, job.options.sequence, job.options.frames);
    const SequencePlan plan = makePlan(job, views);
    const SequenceFiles files(job.options.outputs, job.options.sequence.firstFrame);
    Writer writer(job, files, views);
    for (const FrameNames& names : files.names()) {
        beginSequence(names, makeRecord(job, plan, names), job.options.sequence.overwrite, printWarning);
    }
    const auto isMissing = [&](uint32_t frame) { return files.isMissing(frame); };
    const Share share = parseShare(job.options.sequence.share);
    noteEmptyShare(plan, share);
    const auto runs = plan.runs(share, isMissing);
    Progress progress("rendering frame", plan.work(runs), "frames an hour");
    for (const SequencePlan::Run& run : runs) {
        writer.render(plan, run, progress);
    }
    return writer.written();
}

}  // namespace reflet
