// Runs the measurements.
#include "measure/bench/work.h"

#include "base/progress.h"
#include "measure/bench/displayed_flip.h"

#include <fmt/format.h>

#include <deque>

namespace reflet {

namespace {

uint64_t countTriangles(const Scene& scene) {
    uint64_t indices = 0;
    for (const Instance& instance : scene.instances) {
        indices += scene.meshes[instance.mesh].indices.size();
    }
    return indices / 3;
}

// Variants measured alternately, on one scene at one size.
class Turns {
public:
    Turns(const BenchPlan& plan, const BenchScene& scene, uvec2 size, std::vector<const Variant*> variants)
        : plan_(plan), scene_(scene), size_(size), variants_(std::move(variants)) {}

    std::vector<BenchRun> measure(gpu::Device& device);

private:
    void makeSubjects(gpu::Device& device);
    void measureFirst();
    void measureSteady();
    void compareTo(const Truth& truth, const Layers& picture, BenchState& state, const Variant& variant) const;

    // Alternates variants frame by frame.
    template <class Action>
    void forEach(Action action) {
        for (size_t i = 0; i < subjects_.size(); ++i) {
            action(i, subjects_[i]);
            progress_->advance();
        }
    }

    [[nodiscard]] bool comparesPictures() const { return plan_.truth.kind != TruthKind::none; }

    const BenchPlan& plan_;
    const BenchScene& scene_;
    uvec2 size_;
    std::vector<const Variant*> variants_;
    std::deque<Subject> subjects_;
    std::vector<BenchRun> runs_;
    std::vector<Layers> firstPictures_;
    std::vector<Layers> steadyPictures_;
    std::optional<Progress> progress_;
};

void Turns::makeSubjects(gpu::Device& device) {
    for (const Variant* variant : variants_) {
        const Subject& subject = subjects_.emplace_back(device, scene_, size_, variant->settings);
        BenchRun run;
        run.scene = scene_.name;
        run.variant = variant->name;
        run.settings = changedSettings(variant->settings);
        run.size = size_;
        run.triangles = countTriangles(scene_.scene);
        run.memory = subject.memory();
        runs_.push_back(std::move(run));
    }
    firstPictures_.resize(runs_.size());
    steadyPictures_.resize(runs_.size());
}

void Turns::measureFirst() {
    for (uint32_t i = 0; i < plan_.firstFrames; ++i) {
        forEach([&](size_t v, Subject& subject) {
            subject.forgetHistory();
            subject.render(runs_[v].first.samples);
        });
    }
    // Reading an image back takes time, so it is done in a frame that is not measured.
    if (comparesPictures()) {
        forEach([&](size_t v, Subject& subject) {
            subject.forgetHistory();
            firstPictures_[v] = subject.picture({plan_.layer, "depth"});
        });
    }
}

void Turns::measureSteady() {
    for (Subject& subject : subjects_) {
        subject.forgetHistory();
    }
    for (uint32_t i = 0; i < plan_.warmup; ++i) {
        forEach([](size_t, Subject& subject) { subject.render(); });
    }
    for (uint32_t i = 0; i < plan_.frames; ++i) {
        forEach([&](size_t v, Subject& subject) { subject.render(runs_[v].steady.samples); });
    }
    if (comparesPictures()) {
        forEach([&](size_t v, Subject& subject) { steadyPictures_[v] = subject.picture({plan_.layer, "depth"}); });
    }
}

void Turns::compareTo(const Truth& truth, const Layers& picture, BenchState& state, const Variant& variant) const {
    CompareOptions options;
    options.pixelsPerDegree = plan_.pixelsPerDegree;
    options.imageName = fmt::format("{} of {}", plan_.layer, variant.name);
    options.referenceName = truth.file;
    const FloatImage& of = picture.at(plan_.layer);
    const FloatImage& to = truth.layers.at(plan_.layer);
    state.error = compareImages(of, to, options).difference;
    state.displayedFlip =
        displayedFlip(of, to, picture.at("depth"), variant.settings.tonemap, scene_.scene, plan_.pixelsPerDegree);
}

std::vector<BenchRun> Turns::measure(gpu::Device& device) {
    const uint64_t frames = plan_.firstFrames + plan_.warmup + plan_.frames + (comparesPictures() ? 2U : 0U);
    std::string names;
    for (const Variant* variant : variants_) {
        names += (names.empty() ? "" : " and ") + variant->name;
    }
    progress_.emplace(fmt::format("{} {}x{}, {}: frame", scene_.name, size_.x, size_.y, names),
                      frames * variants_.size());
    makeSubjects(device);
    measureFirst();
    measureSteady();
    progress_.reset();
    subjects_.clear();  // their memory may be needed for the ground truth
    for (size_t v = 0; v < runs_.size() && comparesPictures(); ++v) {
        BenchRun& run = runs_[v];
        const Truth truth = getTruth(device, scene_, size_, variants_[v]->settings, plan_.truth);
        compareTo(truth, firstPictures_[v], run.first, *variants_[v]);
        compareTo(truth, steadyPictures_[v], run.steady, *variants_[v]);
        run.truthFile = truth.file;
        run.truthNoise = truth.noise;
        run.truthSamples = truth.samples;
        run.still = measureConvergence(device, scene_, size_, variants_[v]->settings, truth,
                                       {plan_.stillFrames, plan_.layer, plan_.pixelsPerDegree});
        if (plan_.motion.frames > 0) {
            MotionPlan motion = plan_.motion;
            motion.warmup = plan_.warmup;
            run.motion = measureMotion(device, scene_, size_, variants_[v]->settings, plan_.truth, motion);
        }
    }
    return std::move(runs_);
}

}  // namespace

BenchResult measure(const BenchPlan& plan, gpu::Device& device) {
    BenchResult result;
    for (const BenchScene& scene : plan.scenes) {
        for (const uvec2& size : plan.sizes) {
            for (const Variant& variant : plan.variants) {
                result.runs.push_back(Turns(plan, scene, size, {&variant}).measure(device).front());
            }
            for (const auto& [a, b] : plan.pairs) {
                std::vector<BenchRun> both = Turns(plan, scene, size, {&a, &b}).measure(device);
                result.pairs.push_back({result.runs.size(), result.runs.size() + 1});
                result.runs.push_back(std::move(both[0]));
                result.runs.push_back(std::move(both[1]));
            }
        }
    }
    return result;
}

}  // namespace reflet
