// Makes the frames of a data set.
#include "dataset/dataset.h"

#include "base/error.h"
#include "base/interrupt.h"
#include "base/progress.h"
#include "dataset/files.h"
#include "dataset/manifest.h"
#include "dataset/preset_frames.h"
#include "dataset/views.h"
#include "job/sequence_files.h"
#include "reference/shutter.h"
#include "renderer/scene_exposure/scene_exposure.h"
#include "scene/image_camera.h"
#include "scene/pose.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <chrono>
#include <cmath>

namespace reflet {

namespace {

using Clock = std::chrono::steady_clock;

double secondsSince(Clock::time_point start) {
    return std::chrono::duration<double>(Clock::now() - start).count();
}

/// Seconds by what they were spent on.
struct Spent {
    double loading = 0.0;
    double cameras = 0.0;  ///< with building hierarchies
    double clean = 0.0;
    double noisy = 0.0;
    double writing = 0.0;  ///< with features
};

/// Adds the time of its life.
class Timed {
public:
    explicit Timed(double& sum) : sum_(sum) {}
    ~Timed() { sum_ += secondsSince(start_); }
    Timed(const Timed&) = delete;
    Timed& operator=(const Timed&) = delete;

private:
    double& sum_;
    Clock::time_point start_ = Clock::now();
};

class Maker {
public:
    Maker(const DatasetOptions& options, const DatasetPlan& plan, const std::function<gpu::Device&()>& device)
        : options_(options),
          plan_(plan),
          device_(device),
          size_(parseSize(options.view.size)),
          draw_(parseViewDraw(options)),
          environments_(options.environments),
          files_(options, plan.sceneNames()) {
        std::ranges::copy_if(options.noisy, std::back_inserter(presets_),
                             [](const std::string& name) { return samplesOf(name) == 0; });
    }

    [[nodiscard]] const DatasetFiles& files() const { return files_; }
    [[nodiscard]] const EnvironmentPool& environments() const { return environments_; }
    [[nodiscard]] uint32_t made() const { return made_; }
    [[nodiscard]] const Spent& spent() const { return spent_; }

    void makeScene(uint32_t index, const std::vector<SequencePlan::Run>& runs, Progress& progress) {
        if (runs.empty()) {
            return;
        }
        const DatasetScene scene = load(index);
        TimedScene timed(scene.scene);
        SequenceOptions path;
        path.fps = options_.fps;
        path.path = options_.cameras == "orbit" ? "orbit" : options_.path;
        const SequenceViews views(scene.view, scene.scene, path, plan_.burstsOfScene(index));
        std::optional<PresetFrames> rendered;
        if (!presets_.empty()) {
            rendered.emplace(device_(), scene, presets_);
        }
        for (const SequencePlan::Run& run : runs) {
            const uint32_t burst = run.begin / options_.burst;
            std::optional<Shot> shot;
            for (uint32_t frame = run.begin; frame < run.end; ++frame, progress.advance()) {
                if (files_.isWhole(index, frame)) {
                    continue;
                }
                if (!shot) {
                    const Timed spending(spent_.cameras);
                    shot.emplace(options_, draw_, scene, timed, environments_, burst, plan_.indexInScene(burst), views);
                }
                make({index, frame, scene, timed, *shot}, rendered ? &*rendered : nullptr);
            }
        }
    }

private:
    struct Job {
        uint32_t sceneIndex;
        uint32_t frame;
        const DatasetScene& scene;
        TimedScene& timed;
        const Shot& shot;
    };

    DatasetScene load(uint32_t index) {
        const Timed spending(spent_.loading);
        DatasetScene scene{plan_.sceneNames()[index], options_.view, {}, {}};
        scene.options.scene = options_.scenes[index];
        scene.scene = loadScene(scene.options);
        scene.view = loadView(scene.options, scene.scene);
        if (scene.scene.instances.empty()) {
            failUsage("{}: the scene is empty", scene.options.scene);
        }
        if (options_.cameras == "random") {  // the features are those of a pinhole
            scene.view.camera.apertureRadius = 0.0F;
            scene.view.camera.focus.clear();
        }
        return scene;
    }

    [[nodiscard]] ReferencePicture trace(const Job& job, uint32_t samples, uint32_t version) const {
        const View view = job.shot.at(inBurst(job.frame));
        ReferenceOptions options;
        options.samples = samples;
        options.noise = version == 0 ? options_.noise : 0.0F;
        options.clamp = options_.clamp;
        options.seed = traceSeed(options_.view.seed, job.frame, version);
        options.threads = options_.threads;
        const auto proceed = [](const ReferenceProgress&) { return !InterruptNote::arrived(); };
        const double open = options_.shutter;
        const auto during = [&](double share) { return job.shot.at(inBurst(job.frame) + open * (share - 0.5)); };
        ReferencePicture picture =
            open > 0.0 ? traceShutter(job.scene.scene, during, size_, options, proceed)
                       : traceReference(job.timed.at(view.time), posed(view, job.scene.scene), size_, options, proceed);
        if (!picture.complete && picture.samples < samples) {
            fail("interrupted after {} frames; run the same command again to continue", made_);
        }
        return picture;
    }

    [[nodiscard]] std::vector<NoisyImages> traceNoisy(const Job& job) const {
        std::vector<NoisyImages> all;
        for (const std::string& name : options_.noisy) {
            if (const uint32_t samples = samplesOf(name); samples > 0) {
                const auto version = static_cast<uint32_t>(all.size()) + 1;
                all.push_back({"spp" + name, samples, tracedLayers(trace(job, samples, version))});
            }
        }
        return all;
    }

    [[nodiscard]] int inBurst(uint32_t frame) const { return static_cast<int>(frame % options_.burst); }

    void make(const Job& job, PresetFrames* rendered) {
        const View view = job.shot.at(inBurst(job.frame));
        const View before = job.shot.at(inBurst(job.frame) - 1);
        const View now = posed(view, job.scene.scene);
        const View was = posed(before, job.scene.scene);
        FrameImagesOut images;
        {
            const Timed spending(spent_.cameras);
            (void)job.timed.at(before.time);
            (void)job.timed.at(view.time);
        }
        {
            const Timed spending(spent_.clean);
            images.clean = trace(job, options_.samples, 0);
        }
        {
            const Timed spending(spent_.noisy);
            images.noisy = traceNoisy(job);
            if (rendered != nullptr) {
                std::ranges::move(rendered->render(job.shot, inBurst(job.frame), job.frame),
                                  std::back_inserter(images.noisy));
            }
        }
        const Timed spending(spent_.writing);
        images.motion = traceMotion(job.timed.at(view.time), now, job.timed.at(before.time), was, size_);
        images.camera = imageCamera(now, size_);
        TonemapSettings tonemap = loadSettings(job.scene.options).tonemap;
        if (tonemap.autoExposure == AutoExposure::files) {
            tonemap.autoExposure = AutoExposure::on;  // random views may be dark also in scenes that suit 0
        }
        images.exposure = static_cast<float>(
            exposedAs(tonemap, job.scene.scene, images.clean.final, images.clean.depth).exposure + job.shot.exposure());
        files_.write(job.sceneIndex, job.frame, images, recordFor(job, now, was, images));
        ++made_;
    }

    [[nodiscard]] nlohmann::ordered_json recordFor(const Job& job, const View& now, const View& was,
                                                   const FrameImagesOut& images) const {
        nlohmann::ordered_json record{{"frame", job.frame},
                                      {"name", files_.stem(job.sceneIndex, job.frame)},
                                      {"scene", job.scene.name},
                                      {"burst", job.frame / options_.burst},
                                      {"frame_in_burst", inBurst(job.frame)},
                                      {"animated", !job.scene.scene.nodes.empty()}};
        record["previous"] = inBurst(job.frame) > 0 ? nlohmann::ordered_json(files_.stem(job.sceneIndex, job.frame - 1))
                                                    : nlohmann::ordered_json();
        addView(record, now, was, size_);
        record["camera_tries"] = job.shot.tries();
        record["environment"] = std::filesystem::path(job.shot.environment()).filename().string();
        record["exposure"] = std::exp2(images.exposure);  // the tools of Open Image Denoise read this key as a factor
        record["exposure_stops"] = images.exposure;
        record["clean"] = {{"spp", images.clean.samples},
                           {"noise", images.clean.noise},
                           {"clamp", options_.clamp},
                           {"shutter", options_.shutter},
                           {"seed", traceSeed(options_.view.seed, job.frame, 0)}};
        record["noisy"] = nlohmann::ordered_json::array();
        for (uint32_t i = 0; i < images.noisy.size(); ++i) {
            const NoisyImages& noisy = images.noisy[i];
            nlohmann::ordered_json one{{"name", noisy.name}};
            if (noisy.samples > 0) {
                one["spp"] = noisy.samples;
                one["seed"] = traceSeed(options_.view.seed, job.frame, i + 1);
            } else {
                one["preset"] = noisy.name;
            }
            record["noisy"].push_back(std::move(one));
        }
        return record;
    }

    const DatasetOptions& options_;
    const DatasetPlan& plan_;
    const std::function<gpu::Device&()>& device_;
    uvec2 size_;
    ViewDraw draw_;
    EnvironmentPool environments_;
    DatasetFiles files_;
    std::vector<std::string> presets_;
    Spent spent_;
    uint32_t made_ = 0;
};

void tellThroughput(const DatasetOptions& options, const Maker& maker, double seconds) {
    if (maker.made() == 0) {
        fmt::print("0 of {} frames made: those of this share exist\n", options.frames);
        return;
    }
    const Spent& s = maker.spent();
    fmt::print(
        "{} of {} frames made in {:.1f} s: {:.0f} frames per hour; loading {:.1f} s, cameras {:.1f} s, clean {:.1f} s, "
        "noisy {:.1f} s, features and files {:.1f} s\n",
        maker.made(), options.frames, seconds, 3600.0 * maker.made() / seconds, s.loading, s.cameras, s.clean, s.noisy,
        s.writing);
}

}  // namespace

void makeDataset(const DatasetOptions& options, const std::function<gpu::Device&()>& device) {
    const auto start = Clock::now();
    const InterruptNote note;
    const Share share = parseShare(options.share);  // before the manifest, which would refuse the corrected options
    const DatasetPlan plan(options);
    Maker maker(options, plan, device);
    beginDataset(options, plan, maker.environments().names());
    const SequencePlan segments{.frames = options.frames, .segment = options.burst, .warmUp = 0, .cuts = {}};
    noteEmptyShare(segments, share);
    const auto runs =
        segments.runs(share, [&](uint32_t frame) { return !maker.files().isWhole(plan.sceneOf(frame), frame); });
    Progress progress("making frame", segments.work(runs));
    for (uint32_t scene = 0; scene < plan.sceneNames().size(); ++scene) {
        std::vector<SequencePlan::Run> own;
        std::ranges::copy_if(runs, std::back_inserter(own),
                             [&](const SequencePlan::Run& run) { return plan.sceneOf(run.begin) == scene; });
        maker.makeScene(scene, own, progress);
    }
    tellThroughput(options, maker, secondsSince(start));
    const uint32_t missing = maker.files().writeIndex(plan.sceneOfFrames());
    fmt::print("{}\n", missing == 0 ? fmt::format("{}/frames.jsonl: {} frames", options.folder, options.frames)
                                    : fmt::format("{} frames are missing: other shares make them", missing));
}

}  // namespace reflet
