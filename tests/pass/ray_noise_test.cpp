// White and blue noise: both converge to the same image with many rays or frames, and blue noise has less error with
// few.
#include "pass/harness.h"
#include "scene/builtin.h"

#include <fmt/format.h>

#include <algorithm>

namespace reflet::test::ray_noise_test {
namespace {

constexpr uvec2 size(60, 34);
const std::vector<std::string> lobes{"indirect_diffuse", "indirect_specular"};

class NoiseOfRays : public testing::Test {
protected:
    static inline const Scene scene = findBuiltinScene("gloss")->make();
    static inline const View view = defaultView(scene);

    static Settings settingsFor(const char* noise, uint32_t rays) {
        return settingsOf({"shadow.resolution=256", fmt::format("diffuse.rays={}", rays),
                           fmt::format("specular.rays={}", rays), fmt::format("diffuse.noise={}", noise),
                           fmt::format("specular.noise={}", noise)});
    }

    static Pictures renderFrames(const char* noise, uint32_t rays, uint32_t frames, uint32_t seed = 0) {
        return renderMean(scene, view, size, settingsFor(noise, rays), lobes, frames, seed);
    }

    // Averaged over frames rather than rays: sums of many batches of rays lose energy to rounding.
    static const Pictures& converged() {
        static const Pictures pictures = [] {
            Pictures mean = renderFrames("white", 16, 24, 7);
            const Pictures blue = renderFrames("blue", 16, 24, 7);
            for (auto& [show, image] : mean.images) {
                std::ranges::transform(image.data, blue.images.at(show).data, image.data.begin(),
                                       [](float a, float b) { return 0.5F * (a + b); });
            }
            return mean;
        }();
        return pictures;
    }
};

double meanOf(const FloatImage& image) {
    double sum = 0.0;
    for (const float v : image.data) {
        sum += v;
    }
    return sum / static_cast<double>(image.data.size());
}

// Means of side · side pixels, where all of them are in the picture.
FloatImage boxBlurred(const FloatImage& image, uint32_t side) {
    const auto channels = static_cast<uint32_t>(image.channels.size());
    FloatImage blurred{image.width - side + 1, image.height - side + 1, image.channels, {}};
    for (uint32_t y = 0; y < blurred.height; ++y) {
        for (uint32_t i = 0; i < blurred.width * channels; ++i) {
            float sum = 0.0F;
            for (uint32_t j = 0; j < side * side; ++j) {
                sum += image.data[size_t(y + j / side) * image.width * channels + i + size_t(j % side) * channels];
            }
            blurred.data.push_back(sum / static_cast<float>(side * side));
        }
    }
    return blurred;
}

double relativeMse(const FloatImage& a, const FloatImage& b) {
    double sum = 0.0;
    for (size_t i = 0; i < a.data.size(); ++i) {
        const double difference = a.data[i] - b.data[i];
        sum += difference * difference / (b.data[i] * b.data[i] + 0.01);
    }
    return sum / static_cast<double>(a.data.size());
}

TEST_F(NoiseOfRays, WhiteAndBlueConvergeToTheSamePictureOverRays) {
    const Pictures white = renderFrames("white", 256, 1);
    const Pictures blue = renderFrames("blue", 256, 1);
    for (const std::string& lobe : lobes) {
        const double mean = meanOf(white.images.at(lobe));
        EXPECT_GT(mean, 0.01);
        EXPECT_NEAR(meanOf(blue.images.at(lobe)), mean, 0.005 * mean) << lobe;
        EXPECT_LT(relativeMse(blue.images.at(lobe), white.images.at(lobe)), 0.0015) << lobe;
    }
    expectSilentValidation("noise");
}

// Over 5 s: means of many frames.
TEST_F(NoiseOfRays, WhiteAndBlueConvergeToTheSamePictureOverFrames) {
    const Pictures white = renderFrames("white", 3, 64);  // twice through the mask
    const Pictures blue = renderFrames("blue", 3, 64);
    for (const std::string& lobe : lobes) {
        const FloatImage& truth = converged().images.at(lobe);
        EXPECT_NEAR(meanOf(white.images.at(lobe)), meanOf(truth), 0.005 * meanOf(truth)) << lobe;
        EXPECT_NEAR(meanOf(blue.images.at(lobe)), meanOf(truth), 0.005 * meanOf(truth)) << lobe;
        EXPECT_LT(relativeMse(white.images.at(lobe), truth), 0.001) << lobe;
        EXPECT_LT(relativeMse(blue.images.at(lobe), truth), 0.8 * relativeMse(white.images.at(lobe), truth)) << lobe;
    }
}

// Over 5 s: means of many frames.
TEST_F(NoiseOfRays, FramesAfterTheMasksLastSliceStillBringSomethingNew) {
    const Pictures once = renderFrames("blue", 1, 32);
    const Pictures threeTimes = renderFrames("blue", 1, 96);
    for (const std::string& lobe : lobes) {
        const FloatImage& truth = converged().images.at(lobe);
        EXPECT_LT(relativeMse(threeTimes.images.at(lobe), truth), 0.55 * relativeMse(once.images.at(lobe), truth))
            << lobe;  // 1/3 were frames independent
    }
}

// Over 5 s: means of many frames.
TEST_F(NoiseOfRays, BlueIsNearerToTheTruthAndStaysSoInABlur) {
    // Errors of a frame, summed over some: one frame's depend much on whether a ray happens to meet a lamp.
    std::map<std::string, double> errors;
    for (uint32_t seed = 0; seed < 8; ++seed) {
        for (const char* noise : {"white", "blue"}) {
            const Pictures p = renderFrames(noise, 4, 1, seed);
            for (const std::string& lobe : lobes) {
                const FloatImage& truth = converged().images.at(lobe);
                errors[lobe + noise] += relativeMse(p.images.at(lobe), truth);
                errors[lobe + noise + "blurred"] += relativeMse(boxBlurred(p.images.at(lobe), 5), boxBlurred(truth, 5));
            }
        }
    }
    for (const std::string& lobe : lobes) {
        EXPECT_LT(errors[lobe + "blue"], 0.8 * errors[lobe + "white"]) << lobe;
        EXPECT_LT(errors[lobe + "blueblurred"], 0.8 * errors[lobe + "whiteblurred"]) << lobe;
    }
}

TEST_F(NoiseOfRays, OfAFrameIsTheSameEveryTimeAndAnotherInTheNext) {
    for (const char* noise : {"white", "blue"}) {
        const auto frame = [&](uint32_t number) {
            return render(scene, view, size, settingsFor(noise, 1), lobes, number).images.at(lobes[1]).data;
        };
        EXPECT_EQ(frame(2), frame(2)) << noise;
        EXPECT_NE(frame(2), frame(3)) << noise;
    }
}

}  // namespace
}  // namespace reflet::test::ray_noise_test
