// Smoothing of the light at hits that mirrors show: less noise in each frame, the same mean.
#include "pass/mirror_room.h"
#include "renderer/presets.h"

#include <cmath>

namespace reflet::test::smooth_hits_test {
namespace {

// What a mirror shows in each of 48 frames at rest, without antialiasing.
std::vector<std::vector<float>> framesOf(float radius) {
    static const Scene scene = makeMirrorRoom();
    Settings settings;
    applyPreset(settings, "still");
    settings.temporal.enabled = 0;
    settings.denoise.radius = radius;
    const std::vector<View> path(48, viewOfMirrorRoom());
    std::vector<std::vector<float>> frames;
    for (Pictures& p : renderPath(scene, path, {96, 54}, settings, {"indirect_specular"})) {
        frames.push_back(std::move(p.images.at("indirect_specular").data));
    }
    return frames;
}

std::vector<float> meanOf(const std::vector<std::vector<float>>& frames) {
    std::vector<float> mean(frames[0].size());
    for (const std::vector<float>& frame : frames) {
        for (size_t i = 0; i < mean.size(); ++i) {
            mean[i] += frame[i] / static_cast<float>(frames.size());
        }
    }
    return mean;
}

double differenceOf(const std::vector<float>& a, const std::vector<float>& b) {
    double sum = 0.0;
    for (size_t i = 0; i < a.size(); ++i) {
        sum += std::pow(a[i] - b[i], 2.0) / (std::pow(b[i], 2.0) + 0.01);
    }
    return sum / static_cast<double>(a.size());
}

double sumOf(const std::vector<float>& values) {
    double sum = 0.0;
    for (const float value : values) {
        sum += value;
    }
    return sum;
}

// Over 5 s on a cold cache: it compiles kernels that trace paths.
TEST(SmoothHits, AMirrorShowsLessNoiseAndTheSameMean) {
    const std::vector<std::vector<float>> noisy = framesOf(0.0F);
    const std::vector<std::vector<float>> smooth = framesOf(12.0F);
    const std::vector<float> mean = meanOf(noisy);
    const double noise = differenceOf(noisy[8], mean);
    const double rest = differenceOf(smooth[8], mean);
    printf("relative MSE of a frame: %.4f, smoothed %.4f\n", noise, rest);
    EXPECT_LT(rest, 0.25 * noise);
    EXPECT_NEAR(sumOf(meanOf(smooth)) / sumOf(mean), 1.0, 0.01);
    EXPECT_LT(differenceOf(meanOf(smooth), mean), 0.1 * noise);
}

}  // namespace
}  // namespace reflet::test::smooth_hits_test
