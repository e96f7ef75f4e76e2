// The right side of the divider: another preset, a file, or the path-traced ground truth; and the left side's error
// against it.
#pragma once

#include "compare/compare.h"
#include "gpu/resource.h"
#include "reference/reference.h"
#include "view/background.h"
#include "view/session.h"
#include "view/viewer_state.h"

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace reflet {

class CompareView {
public:
    explicit CompareView(gpu::Device& device) : device_(device) {}

    /// Drops everything, for another scene.
    void forget();

    /// Whether update() would render a frame.
    [[nodiscard]] bool wantsFrame(const ViewerState& state, uvec2 size) const;
    /// Brings the right side up to date with the state, the last frame of the live side and the background work.
    /// mayRender: false while paused.
    void update(const ViewerState& state, const Session& live, uvec2 size, bool mayRender);

    /// Whether the error needs the live side's values.
    [[nodiscard]] static bool wantsValues(const ViewerState& state) {
        return state.compare.with != CompareWith::nothing;
    }

    [[nodiscard]] gpu::Image picture() const { return picture_; }
    /// Error of the left side against the right one.
    [[nodiscard]] const std::optional<Difference>& error() const { return error_; }
    /// Progress, or the reason why nothing is shown.
    [[nodiscard]] const std::string& message() const { return message_; }
    [[nodiscard]] bool failed() const { return failed_; }
    /// Samples per pixel of the displayed ground truth, and progress of the next, better one (0 to 1).
    [[nodiscard]] uint32_t samples() const { return samples_; }
    [[nodiscard]] float progress() const { return progress_; }

private:
    struct Asked {
        View view;
        uvec2 size{0};
        bool lambertOnly = false;
        PixelFilter filter = PixelFilter::box;

        bool operator==(const Asked&) const = default;
    };

    void updatePreset(const ViewerState& state, const Session& live, uvec2 size);
    void updateFile(const ViewerState& state);
    void updateTruth(const ViewerState& state, const Session& live, uvec2 size, bool mayRender);
    void startTruth(const ViewerState& state, const Session& live);
    void chooseLayer(const ViewerState& state);
    void updateError(const Session& live);
    /// tonemap: of the left side, whose exposure both have.
    void updatePicture(const ViewerState& state, const TonemapSettings& tonemap);
    void setProblem(const std::string& text);

    gpu::Device& device_;
    CompareWith with_ = CompareWith::nothing;
    std::unique_ptr<Session> other_;
    std::string file_;
    std::string fileProblem_;
    std::vector<ImageLayer> layers_;
    std::optional<Asked> asked_;
    BackgroundTask<ReferencePicture> truth_;
    std::atomic<float> progress_ = 0.0F;
    uint32_t samples_ = 0;
    FloatImage coverage_;                       ///< of the ground truth
    std::string layerShow_;                     ///< the show that values_ belong to
    std::shared_ptr<const FloatImage> values_;  ///< of the right side
    std::shared_ptr<const FloatImage> pictureOf_;
    std::optional<TonemapSettings> pictureTone_;
    bool pictureFalse_ = false;
    vec2 pictureRange_{0.0F};
    gpu::Texture texture_;
    gpu::Image picture_;
    BackgroundTask<Comparison> errorWork_;
    std::shared_ptr<const FloatImage> errorLeft_;  ///< inputs of the last or current error computation
    std::shared_ptr<const FloatImage> errorRight_;
    std::optional<Difference> error_;
    std::shared_ptr<const FloatImage> errorMap_;
    bool pictureIsError_ = false;
    std::string message_;
    bool failed_ = false;
};

}  // namespace reflet
