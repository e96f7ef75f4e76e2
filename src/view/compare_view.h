// The right side of the divider: another preset, a file, or the path-traced ground truth; and the left side's error
// against it.
#pragma once

#include "compare/compare.h"
#include "reference/reference.h"
#include "view/background.h"
#include "view/session.h"
#include "view/viewer_state.h"

#include <fmt/format.h>
#include <algorithm>

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace reflet {

class CompareView {
public:
    /// Drops everything, for another scene.
    void forget();
    /// Requests that background work end.
    void cancel();
    /// Waits for background work to end, until `end` at most. Returns whether it has ended.
    [[nodiscard]] bool endsBy(Clock::time_point end) const {
        return truth_.endsBy(end) && errorWork_.endsBy(end) && fileWork_.endsBy(end);
    }

    /// Inputs of update().
    struct Inputs {
        const ViewerState& state;
        const OpenScene& opened;
        const RenderedImage& live;   ///< the left side
        const RenderedImage* right;  ///< the right side, if it is rendered; null before its first frame
        uvec2 size{0};               ///< size of the image at rest, pixels
        bool mayTrace = true;        ///< false while paused and while the view moves
    };
    /// Brings the right side up to date with the state, the last frames of both sides and the background work.
    void update(const Inputs& in);
    /// The state that is rendered for the right side, if it is rendered.
    [[nodiscard]] static std::optional<ViewerState> rendered(const ViewerState& state);

    /// Whether the error needs the live side's values.
    [[nodiscard]] static bool wantsValues(const ViewerState& state) {
        return state.compare.with != CompareWith::nothing;
    }

    /// The right side's picture; null: none.
    [[nodiscard]] const std::shared_ptr<const Bitmap>& picture() const { return picture_; }
    /// Values of the right side's image; null: none.
    [[nodiscard]] const std::shared_ptr<const FloatImage>& values() const { return values_; }
    /// HDR-FLIP of each pixel; null: not computed yet.
    [[nodiscard]] const std::shared_ptr<const FloatImage>& errorMap() const { return errorMap_; }
    [[nodiscard]] bool busy() const { return errorWork_.busy() || fileWork_.busy(); }
    /// Error of the left side against the right one, which may have been replaced since: computing it takes a while.
    [[nodiscard]] const std::optional<Difference>& error() const { return error_; }
    /// Samples per pixel of the ground truth that the error is relative to; 0: relative to another image.
    [[nodiscard]] uint32_t errorSamples() const { return errorSamples_; }
    /// The error's name over the picture: "HDR-FLIP".
    [[nodiscard]] std::string errorName() const {
        return errorSamples_ > 0 ? fmt::format("HDR-FLIP, {}", sampleText(errorSamples_)) : "HDR-FLIP";
    }
    /// Progress, or the reason why nothing is shown.
    [[nodiscard]] const std::string& message() const { return message_; }
    /// Name of the right side, for display.
    [[nodiscard]] std::string name(const ViewerState& state) const {
        return state.compare.with == CompareWith::preset ? state.compare.preset
               : state.compare.errorImage && errorMap_   ? errorName()
               : state.compare.with == CompareWith::file ? std::filesystem::path(file_).filename().string()
               : samples_ > 0                            ? name_
                                                         : "path tracing";
    }
    [[nodiscard]] bool failed() const { return failed_; }
    /// Samples per pixel of the next ground truth after one with `samples` (0: none yet); all samples are traced anew.
    [[nodiscard]] static uint32_t nextSamples(uint32_t samples, uint32_t most) {
        return std::min(samples == 0 ? 1 : samples * 4, most);
    }
    /// "4 samples".
    [[nodiscard]] static std::string sampleText(uint32_t samples) {
        return fmt::format("{} {}", samples, samples == 1 ? "sample" : "samples");
    }
    /// Samples per pixel of the displayed ground truth, and progress of the next, better one (0 to 1).
    [[nodiscard]] uint32_t samples() const { return samples_; }
    [[nodiscard]] float progress() const { return progress_; }

private:
    struct TruthRequest {
        View view;
        uvec2 size{0};
        bool lambertOnly = false;
        PixelFilter filter = PixelFilter::box;

        bool operator==(const TruthRequest&) const = default;
    };

    void updatePreset(const Inputs& in);
    void updateFile(const ViewerState& state);
    void updateTruth(const Inputs& in);
    void startTruth(const Inputs& in);
    void chooseLayer(const ViewerState& state);
    void updateError(const RenderedImage& live);
    void forgetError();
    /// tonemap: of the left side; both sides use its exposure.
    void updatePicture(const ViewerState& state, const TonemapSettings& tonemap);
    void setProblem(const std::string& text);

    CompareWith with_ = CompareWith::nothing;
    std::string file_;
    std::string fileProblem_;
    BackgroundTask<std::vector<ImageLayer>> fileWork_;
    std::vector<ImageLayer> layers_;
    std::optional<TruthRequest> asked_;
    BackgroundTask<ReferencePicture> truth_;
    std::atomic<float> progress_ = 0.0F;
    uint32_t samples_ = 0;
    FloatImage coverage_;                       ///< coverage of the ground truth
    std::string layerShow_;                     ///< the show that values_ belong to
    std::shared_ptr<const FloatImage> values_;  ///< of the right side
    std::shared_ptr<const FloatImage> pictureOf_;
    std::optional<TonemapSettings> pictureTone_;
    bool pictureFalse_ = false;
    vec2 pictureRange_{0.0F};
    std::shared_ptr<const Bitmap> picture_;
    BackgroundTask<Comparison> errorWork_;
    std::shared_ptr<const FloatImage> errorLeft_;  ///< inputs of the last or current error computation; null: unwanted
    std::shared_ptr<const FloatImage> errorRight_;
    uint32_t errorRightSamples_ = 0;  ///< samples per pixel of errorRight_
    std::optional<Difference> error_;
    uint32_t errorSamples_ = 0;  ///< samples per pixel that error_ is relative to
    std::shared_ptr<const FloatImage> errorMap_;
    bool pictureIsError_ = false;
    std::string message_;
    std::string name_;
    bool failed_ = false;
};

}  // namespace reflet
