#include "measure/motions/work.h"

#include "base/error.h"
#include "base/progress.h"
#include "compare/compare.h"
#include "effects/tonemap/tone_map_image.h"
#include "measure/bench/displayed_flip.h"
#include "measure/bench/motion.h"
#include "measure/bench/subject.h"
#include "renderer/scene_exposure/scene_exposure.h"
#include "scene/builtin.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>
#include <numeric>

namespace reflet {

namespace {

const std::string finalName = "final";
const std::string indirectName = "indirect_diffuse";

// What the same settings show of a pose at rest.
struct Settled {
    FloatImage mean;      // of settledFrames frames
    FloatImage indirect;  // likewise; empty if not asked for
    FloatImage frame;     // the last of these frames
    double flicker = 0.0;
};

struct Frame {
    View view;
    Layers layers;
    const Settled* settled = nullptr;
};

// One case with one variant.
class Motion {
public:
    Motion(const MotionsPlan& plan, const MotionCase& which, const BenchScene& scene, const Variant& variant)
        : plan_(plan), which_(which), scene_(scene), variant_(variant) {}

    void render(gpu::Device& device);
    MotionsRun compare(const std::vector<Truth>& truths) const;

private:
    Settled settle(Subject& subject, Progress& progress) const;
    [[nodiscard]] std::vector<std::string> layerNames() const;
    void addErrors(MotionErrors& errors, const FloatImage& picture, const Frame& frame, const Truth& truth) const;
    void addLag(MotionsRun& run) const;
    void addPictures(MotionsRun& run, const std::vector<Truth>& truths) const;

    const MotionsPlan& plan_;
    const MotionCase& which_;
    const BenchScene& scene_;
    const Variant& variant_;
    std::vector<Frame> frames_;  // the first is at rest, before the motion
    std::vector<std::unique_ptr<Settled>> settled_;
};

std::vector<std::string> Motion::layerNames() const {
    std::vector<std::string> names{finalName, "motion", "depth"};
    if (which_.lag == MotionCase::Lag::light) {
        names.push_back(indirectName);
    }
    return names;
}

void addTo(FloatImage& sum, const FloatImage& image) {
    if (sum.data.empty()) {
        sum = image;
    } else {
        std::ranges::transform(sum.data, image.data, sum.data.begin(), std::plus());
    }
}

Settled Motion::settle(Subject& subject, Progress& progress) const {
    subject.forgetHistory();
    for (uint32_t i = 0; i < plan_.settle; ++i) {
        subject.render();
        progress.advance();
    }
    Settled settled;
    for (uint32_t i = 0; i < settledFrames; ++i) {
        Layers layers = subject.picture(layerNames());
        progress.advance();
        FloatImage& frame = layers.at(finalName);
        if (i > 0) {
            const FloatImage now = compressed(frame);
            const FloatImage before = compressed(settled.frame);
            const double change =
                std::transform_reduce(now.data.begin(), now.data.end(), before.data.begin(), 0.0, std::plus(),
                                      [](double a, double b) { return std::abs(a - b); });
            settled.flicker += change / static_cast<double>(now.data.size() * (settledFrames - 1));
        }
        addTo(settled.mean, frame);
        if (layers.contains(indirectName)) {
            addTo(settled.indirect, layers.at(indirectName));
        }
        settled.frame = std::move(frame);
    }
    for (FloatImage* mean : {&settled.mean, &settled.indirect}) {
        for (float& value : mean->data) {
            value /= settledFrames;
        }
    }
    return settled;
}

void Motion::render(gpu::Device& device) {
    std::vector<View> poses;
    for (uint32_t i = 0; i <= which_.frames; ++i) {
        frames_.push_back({which_.view(scene_.view, i), {}, nullptr});
        if (poses.empty() || poses.back() != frames_.back().view) {
            poses.push_back(frames_.back().view);
        }
    }
    const uint64_t each = plan_.settle + settledFrames;
    Progress progress(fmt::format("{}, {}: frame", which_.name, variant_.name),
                      each * (poses.size() + 1) + which_.frames);
    Subject subject(device, scene_, plan_.size, variant_.settings);
    for (Frame& frame : frames_) {
        const bool same = &frame != &frames_.front() && frame.view == (&frame - 1)->view;
        if (!same) {
            subject.setView(frame.view);
            settled_.push_back(std::make_unique<Settled>(settle(subject, progress)));
        }
        frame.settled = settled_.back().get();
    }
    subject.setView(frames_.front().view);
    subject.forgetHistory();
    for (uint32_t i = 0; i + 1 < each; ++i) {
        subject.render();
        progress.advance();
    }
    for (Frame& frame : frames_) {
        subject.setView(frame.view);
        frame.layers = subject.picture(layerNames());
        progress.advance();
    }
}

void Motion::addErrors(MotionErrors& errors, const FloatImage& picture, const Frame& frame, const Truth& truth) const {
    const CompareOptions options;
    const FloatImage& to = truth.layers.at(finalName);
    errors.relativeMse.push_back(compareImages(picture, to, options).difference.relativeMse);
    errors.flip.push_back(displayedFlip(picture, to, frame.layers.at("depth"), variant_.settings.tonemap, scene_.scene,
                                        options.pixelsPerDegree));
}

void Motion::addLag(MotionsRun& run) const {
    for (size_t i = which_.event; i < frames_.size(); ++i) {
        if (which_.lag == MotionCase::Lag::rest) {
            run.left.push_back(run.moving.flip[i - 1] / run.rest.flip[i - 1]);
        } else if (which_.lag == MotionCase::Lag::light) {
            const Settled& before = *frames_[which_.event - 1].settled;
            const Settled& after = *frames_[i].settled;
            const Layers& layers = frames_[i].layers;
            run.left.push_back(stepLeft(layers.at(finalName), before.mean, after.mean));
            run.indirectLeft.push_back(stepLeft(layers.at(indirectName), before.indirect, after.indirect));
        }
    }
}

Bitmap displayed(const FloatImage& picture, const TonemapSettings& tonemap, const Scene& scene, const FloatImage& truth,
                 const FloatImage& depth) {
    return toneMapped(picture, exposedAs(tonemap, scene, truth, depth));
}

void Motion::addPictures(MotionsRun& run, const std::vector<Truth>& truths) const {
    for (const uint32_t after : stripFrames) {
        const size_t i = std::min<size_t>(which_.event + after, which_.frames);
        run.pictures.push_back(displayed(frames_[i].layers.at(finalName), variant_.settings.tonemap, scene_.scene,
                                         truths[i - 1].layers.at(finalName), frames_[i].layers.at("depth")));
    }
}

MotionsRun Motion::compare(const std::vector<Truth>& truths) const {
    MotionsRun run;
    run.motion = which_;
    run.variant = variant_.name;
    run.settings = changedSettings(variant_.settings);
    std::vector<MotionFrame> sequence;
    for (size_t i = 0; i < frames_.size(); ++i) {
        const Frame& frame = frames_[i];
        sequence.push_back({frame.layers.at(finalName), frame.settled->mean, frame.layers.at("motion")});
        if (i > 0) {
            addErrors(run.moving, frame.layers.at(finalName), frame, truths[i - 1]);
            addErrors(run.rest, frame.settled->frame, frame, truths[i - 1]);
        }
    }
    run.ghosts = ghostsOf(sequence, oldestGhost);
    run.flicker = flickerOf(sequence);
    for (const auto& settled : settled_) {
        run.restFlicker += settled->flicker / static_cast<double>(settled_.size());
    }
    addLag(run);
    if (plan_.strips) {
        addPictures(run, truths);
    }
    return run;
}

// The references of all frames but the one at rest before the motion.
std::vector<Truth> truthsOf(const MotionsPlan& plan, const MotionCase& which, const BenchScene& scene,
                            const Settings& settings, gpu::Device& device) {
    std::vector<Truth> truths;
    BenchScene now = scene;
    for (uint32_t i = 1; i <= which.frames; ++i) {
        const View view = which.view(scene.view, i);
        if (!truths.empty() && view == now.view) {
            truths.push_back(truths.back());
            continue;
        }
        now.view = view;
        truths.push_back(getTruth(device, now, plan.size, settings, plan.truth));
    }
    return truths;
}

std::vector<Bitmap> truthPictures(const MotionCase& which, const std::vector<Truth>& truths) {
    std::vector<Bitmap> pictures;
    for (const uint32_t after : stripFrames) {
        const size_t i = std::min<size_t>(which.event + after, which.frames);
        pictures.push_back(toneMapped(truths[i - 1].layers.at(finalName), {}));
    }
    return pictures;
}

double mean(const std::vector<double>& values) {
    return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

}  // namespace

double errorRatio(const MotionsRun& run) {
    return mean(run.moving.flip) / mean(run.rest.flip);
}

double flickerRatio(const MotionsRun& run) {
    return run.flicker.frames / (run.flicker.settled + run.restFlicker);
}

std::optional<uint32_t> lagOf(const MotionsRun& run, const std::vector<double>& left) {
    std::vector<double> off = left;
    if (run.motion.lag == MotionCase::Lag::light) {
        std::ranges::transform(left, off.begin(), [](double value) { return std::abs(value); });
    }
    return framesUntil(off, run.motion.lag == MotionCase::Lag::light ? 0.1 : 1.1);
}

MotionsResult measureMotions(const MotionsPlan& plan, gpu::Device& device) {
    MotionsResult result;
    for (const MotionCase& which : plan.cases) {
        std::optional<Scene> scene = makeBuiltinScene(which.scene);
        REFLET_CHECK(scene.has_value(), "no scene {}", which.scene);
        BenchScene bench{std::string(which.scene), std::move(*scene), {}, plan.seed};
        bench.view = defaultView(bench.scene);
        for (const Variant& variant : plan.variants) {
            Motion motion(plan, which, bench, variant);
            motion.render(device);
            const std::vector<Truth> truths = truthsOf(plan, which, bench, variant.settings, device);
            result.runs.push_back(motion.compare(truths));
            if (plan.strips && &variant == &plan.variants.front()) {
                result.truths.push_back(truthPictures(which, truths));
            }
        }
    }
    return result;
}

}  // namespace reflet
