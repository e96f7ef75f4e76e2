// Makes the right side of the comparison.
#include "view/compare_view.h"

#include "base/error.h"
#include "compare/heat_map.h"
#include "renderer/background/background.h"
#include "renderer/presets.h"

#include <algorithm>
#include <thread>

namespace reflet {

namespace {

bool sameTone(const TonemapSettings& a, const TonemapSettings& b) {
    return a.exposure == b.exposure && a.curve == b.curve;
}

ViewerState withPreset(const ViewerState& state) {
    ViewerState other = state;
    other.settings = Settings{};
    applyPreset(other.settings, state.compare.preset);
    other.settings.tonemap = state.settings.tonemap;  // compares radiance, not tone mapping
    return other;
}

}  // namespace

void CompareView::cancel() {
    truth_.cancel();
    errorWork_.cancel();
    fileWork_.cancel();
}

void CompareView::forget() {
    cancel();
    truth_.discard();
    errorWork_.discard();
    fileWork_.discard();
    file_.clear();
    layers_.clear();
    asked_.reset();
    samples_ = 0;
    values_ = nullptr;
    pictureOf_ = nullptr;
    picture_ = nullptr;
    forgetError();
    message_.clear();
    failed_ = false;
}

// With the result of a computation that is not finished.
void CompareView::forgetError() {
    error_.reset();
    errorSamples_ = 0;
    errorLeft_ = nullptr;
    errorRight_ = nullptr;
    errorMap_ = nullptr;
}

void CompareView::setProblem(const std::string& text) {
    message_ = text;
    failed_ = true;
}

std::optional<ViewerState> CompareView::rendered(const ViewerState& state) {
    return state.compare.with == CompareWith::preset ? std::optional(withPreset(state)) : std::nullopt;
}

void CompareView::updatePreset(const Inputs& in) {
    if (in.right == nullptr) {
        message_ = fmt::format("rendering {}", in.state.compare.preset);
        values_ = nullptr;
        return;
    }
    values_ = in.right->values;
    if (!in.right->problem.empty()) {
        setProblem(in.right->problem);
        return;
    }
    message_ = fmt::format("{} after {} frames", in.state.compare.preset, in.right->frames);
}

void CompareView::updateFile(const ViewerState& state) {
    if (state.compare.file != file_ && !fileWork_.busy()) {
        file_ = state.compare.file;
        layers_.clear();
        layerShow_.clear();
        fileProblem_.clear();
        values_ = nullptr;
        if (!file_.empty()) {
            fileWork_.start([file = file_](const std::atomic<bool>&) { return readExr(file); });
        }
    }
    try {
        if (auto layers = fileWork_.take()) {
            layers_ = std::move(*layers);
        }
    } catch (const Error& error) {
        fileProblem_ = error.what();
    }
    if (fileWork_.busy()) {
        message_ = fmt::format("reading {}", file_);
        return;
    }
    if (!fileProblem_.empty()) {
        setProblem(fileProblem_);
        values_ = nullptr;
        return;
    }
    if (file_.empty()) {
        message_ = "Choose an EXR file below Files, type its name, or drag one onto the window.";
        values_ = nullptr;
        return;
    }
    chooseLayer(state);
}

// Selects the layer named as the show; for `final`, the unnamed layer will do.
void CompareView::chooseLayer(const ViewerState& state) {
    if (layerShow_ == state.show && values_) {
        return;
    }
    layerShow_ = state.show;
    values_ = nullptr;
    auto found = std::ranges::find(layers_, state.show, &ImageLayer::name);
    if (found == layers_.end() && state.show == "final") {
        found = std::ranges::find(layers_, std::string(), &ImageLayer::name);
    }
    const size_t wanted = findShow(state.show).channels.size();
    if (found == layers_.end() || found->image.channels.size() < wanted) {
        setProblem(fmt::format("The right side has no layer '{}' to compare with.", state.show));
        return;
    }
    auto image = std::make_shared<FloatImage>(found->image);
    if (const size_t has = image->channels.size(); has > wanted) {  // drops alpha
        std::vector<float> fewer;
        for (size_t i = 0; i < image->data.size(); i += has) {
            fewer.insert(fewer.end(), image->data.begin() + static_cast<std::ptrdiff_t>(i),
                         image->data.begin() + static_cast<std::ptrdiff_t>(i + wanted));
        }
        image->data = std::move(fewer);
        image->channels.resize(wanted);
    }
    values_ = std::move(image);
    message_.clear();
}

void CompareView::startTruth(const Inputs& in) {
    const ViewerState& state = in.state;
    ReferenceOptions options;
    options.samples = nextSamples(samples_, state.compare.samples);
    options.filter = asked_->filter;
    options.lambertOnly = asked_->lambertOnly;
    options.seed = state.source.seed;
    options.threads = std::max(1U, std::thread::hardware_concurrency() - 1U);  // one core is left for the window
    progress_ = 0.0F;
    truth_.start([this, scene = in.opened.scene, asked = *asked_, options](const std::atomic<bool>& cancelled) {
        return traceReference(*scene, asked.view, asked.size, options, [&](const ReferenceProgress& now) {
            const float done = static_cast<float>(double(now.done) / double(std::max<uint64_t>(now.total, 1)));
            if (done > progress_ + 0.02F) {
                progress_ = done;
                Window::wake();
            }
            return !cancelled;
        });
    });
}

void CompareView::updateTruth(const Inputs& in) {
    const ViewerState& state = in.state;
    const TruthRequest asked{state.view, in.size, state.settings.materials.lambertOnly != 0,
                             state.settings.temporal.enabled != 0 ? PixelFilter::box : PixelFilter::center};
    if (!asked_ || !(*asked_ == asked)) {
        asked_ = asked;
        truth_.cancel();
        samples_ = 0;
        layers_.clear();
        values_ = nullptr;
        forgetError();
    }
    if (!in.mayTrace) {
        truth_.cancel();
    }
    const bool unwanted = truth_.cancelled();
    if (auto picture = truth_.take(); picture && !unwanted) {
        samples_ = picture->samples;
        layers_ = picture->layers();
        coverage_ = std::move(picture->coverage);
        layerShow_.clear();
    }
    if (in.mayTrace && !truth_.busy() && samples_ < state.compare.samples) {
        startTruth(in);
    }
    if (samples_ == 0) {
        message_ = "path tracing";
        return;
    }
    chooseLayer(state);
    if (values_) {
        message_ = fmt::format("path traced, {} of {} samples per pixel", samples_, state.compare.samples);
        name_ = fmt::format("path traced, {}", sampleText(samples_));
    }
}

void CompareView::updateError(const RenderedImage& live) {
    if (const auto comparison = errorWork_.take(); comparison && errorRight_) {
        error_ = comparison->difference;
        errorSamples_ = errorRightSamples_;
        errorMap_ = std::make_shared<const FloatImage>(comparison->flip);
    }
    const std::shared_ptr<const FloatImage>& left = live.values;
    if (!left || !values_ || errorWork_.busy() || (left == errorLeft_ && values_ == errorRight_)) {
        return;
    }
    if (left->channels.size() != 1 && left->channels.size() != 3) {
        return;
    }
    errorLeft_ = left;
    errorRight_ = values_;
    errorRightSamples_ = samples_;
    errorWork_.start([left, right = values_](const std::atomic<bool>&) {
        CompareOptions options;
        options.imageName = "the left side";
        options.referenceName = "the right side";
        return compareImages(*left, *right, options);
    });
}

void CompareView::updatePicture(const ViewerState& state, const TonemapSettings& tonemap) {
    const bool asError = state.compare.errorImage && errorMap_;
    const std::shared_ptr<const FloatImage>& of = asError ? errorMap_ : values_;
    const vec2 range(state.low, state.high);
    if (!of) {
        picture_ = nullptr;
        pictureOf_ = nullptr;
        return;
    }
    if (of == pictureOf_ && pictureTone_ && sameTone(*pictureTone_, tonemap) && pictureIsError_ == asError &&
        pictureFalse_ == state.falseColor && pictureRange_ == range) {
        return;
    }
    pictureOf_ = of;
    pictureTone_ = tonemap;
    pictureIsError_ = asError;
    pictureFalse_ = state.falseColor;
    pictureRange_ = range;
    const bool overBackground = with_ == CompareWith::truth && state.show == "final" && !state.falseColor;
    picture_ = std::make_shared<const Bitmap>(asError ? heatMap(*of)
                                              : overBackground
                                                  ? displayedOver(*of, coverage_, asked_->view.background, tonemap)
                                                  : shownPicture(state, tonemap, *of));
}

void CompareView::update(const Inputs& in) {
    const ViewerState& state = in.state;
    if (state.compare.with != with_) {
        forget();
        with_ = state.compare.with;
    }
    if (with_ == CompareWith::nothing) {
        return;
    }
    failed_ = false;
    try {
        if (with_ == CompareWith::preset) {
            updatePreset(in);
        } else if (with_ == CompareWith::file) {
            updateFile(state);
        } else {
            updateTruth(in);
        }
        updateError(in.live);
        updatePicture(state, in.live.tonemap);
    } catch (const Error& error) {
        setProblem(error.what());
        values_ = nullptr;
        picture_ = nullptr;
    }
}

}  // namespace reflet
