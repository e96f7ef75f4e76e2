// The sun's shadows against the path tracer: the same sun disk, rays through pixel centres. A pixel that is lit and
// should be dark counts a hundred times in a relative error of visibility.
//
// With 16 samples or more, the errors come from the texels of the shadow map and from the method, hardly from noise.
// Denoising removes only noise, so it is measured separately: against the mean of many frames of the same shadows.
#include "compare/compare.h"
#include "pass/harness.h"
#include "reference/reference.h"
#include "scene/builtin.h"

#include <fmt/format.h>

#include <cmath>
#include <string>

namespace reflet::test::shadow_truth_test {
namespace {

constexpr uvec2 size(160, 90);

struct SunCase {
    const char* scene;
    int hundredths;     ///< of a degree: the sun's angular diameter
    double errorLimit;  ///< relative MSE of pcss with 16 samples
    double biasLimit;

    [[nodiscard]] View view(const Scene& of) const {
        View view = defaultView(of);
        view.sun.angularDiameter = glm::radians(0.01F * static_cast<float>(hundredths));
        return view;
    }
};

constexpr SunCase colonnade{"colonnade", 53, 0.025,
                            0.0035};  // columns turn away from the sun: bias grows to cos 0.1 only
constexpr SunCase colonnadeWide{"colonnade", 500, 0.02, 0.002};
constexpr SunCase cubes{"cubes", 53, 0.0005, 0.0005};
constexpr SunCase cubesWide{"cubes", 500, 0.0006, 0.0005};

std::vector<std::string> with(std::vector<std::string> more) {
    more.insert(more.end(), {"diffuse.rays=0", "specular.rays=0"});
    return more;
}

struct Filtered {
    Difference raw;
    Difference cleaned;
};

double meanSquare(const FloatImage& a, const FloatImage& b) {
    double sum = 0.0;
    for (size_t i = 0; i < a.data.size(); ++i) {
        sum += std::pow(a.data[i] - b.data[i], 2.0);
    }
    return sum / static_cast<double>(a.data.size());
}

/// A scene under a sun, and its truth.
struct Sunlit {
    Scene scene;
    View view;
    FloatImage truth;

    explicit Sunlit(const SunCase& c)
        : scene(findBuiltinScene(c.scene)->make()),
          view(c.view(scene)),
          truth(traceReference(scene, view, size, {.bounces = 0, .samples = 256, .filter = PixelFilter::center})
                    .sunVisibility) {}

    [[nodiscard]] Pictures pictures(const std::vector<std::string>& settings) const {
        return render(scene, view, size, settingsOf(with(settings)), {"sun_visibility_raw", "sun_visibility"});
    }
    [[nodiscard]] Filtered errors(const std::vector<std::string>& settings) const {
        const Pictures p = pictures(settings);
        return {compareImages(p.images.at("sun_visibility_raw"), truth, {}).difference,
                compareImages(p.images.at("sun_visibility"), truth, {}).difference};
    }
    [[nodiscard]] Filtered errors(const std::string& filter, unsigned samples) const {
        return errors({"shadow.filter=" + filter, fmt::format("shadow.samples={}", samples)});
    }
};

void record(const std::string& name, const Filtered& f) {
    for (const auto& [which, d] : {std::pair("raw", &f.raw), std::pair("cleaned", &f.cleaned)}) {
        testing::Test::RecordProperty(fmt::format("{}_{}_relative_mse", name, which),
                                      fmt::format("{:.6f}", d->relativeMse));
        testing::Test::RecordProperty(fmt::format("{}_{}_flip", name, which), fmt::format("{:.5f}", d->flip));
        testing::Test::RecordProperty(fmt::format("{}_{}_bias", name, which), fmt::format("{:.5f}", d->bias));
    }
}

std::string nameOf(const testing::TestParamInfo<SunCase>& c) {
    return fmt::format("{}UnderASunOf{}HundredthsOfADegree", c.param.scene, c.param.hundredths);
}

class ShadowTruth : public testing::TestWithParam<SunCase> {};

TEST_P(ShadowTruth, PcssIsNearerThanHardShadowsAndPcfWhateverTheSamplesAndDenoisingCostsNoAccuracy) {
    const Sunlit sunlit(GetParam());
    const Filtered hard = sunlit.errors("hard", 1);
    record("hard", hard);
    for (const unsigned samples : {8U, 16U, 32U, 64U}) {
        const Filtered pcf = sunlit.errors("pcf", samples);
        const Filtered pcss = sunlit.errors("pcss", samples);
        record(fmt::format("pcf_{}", samples), pcf);
        record(fmt::format("pcss_{}", samples), pcss);
        for (const auto& [soft, fixed] : {std::pair(pcss.raw, pcf.raw), std::pair(pcss.cleaned, pcf.cleaned)}) {
            EXPECT_LT(soft.relativeMse, 0.9 * hard.raw.relativeMse) << samples;
            EXPECT_LT(soft.relativeMse, 0.55 * fixed.relativeMse) << samples;
            EXPECT_LT(soft.flip, 0.8 * hard.raw.flip) << samples;
            EXPECT_LT(soft.flip, 0.7 * fixed.flip) << samples;
        }
        // Raw visibility has little noise under so small a sun, and the blur costs a few percent.
        EXPECT_LT(pcss.cleaned.relativeMse, 1.1 * pcss.raw.relativeMse) << samples;
        if (samples == 16) {
            EXPECT_LT(pcss.raw.relativeMse, GetParam().errorLimit);
            EXPECT_NEAR(pcss.raw.bias, 0.0, GetParam().biasLimit);
            EXPECT_NEAR(pcss.cleaned.bias, 0.0, GetParam().biasLimit);
        }
    }
    expectSilentValidation("shadows of the sun");
}

INSTANTIATE_TEST_SUITE_P(Scenes, ShadowTruth, testing::Values(colonnade, colonnadeWide, cubes, cubesWide), nameOf);

// A small sun needs hardly any samples; the resolution of the map is what matters.
TEST(ShadowTruthOfAColonnade, IsLimitedByTexelsRatherThanBySamples) {
    const Sunlit sunlit(colonnade);
    const Filtered some = sunlit.errors("pcss", 16);
    const Filtered more = sunlit.errors("pcss", 64);
    const Filtered finer = sunlit.errors({"shadow.filter=pcss", "shadow.resolution=4096"});
    record("pcss_16_of_4096_texels", finer);
    EXPECT_GT(more.raw.relativeMse, 0.95 * some.raw.relativeMse);
    EXPECT_LT(finer.raw.relativeMse, 0.95 * some.raw.relativeMse);
}

class ShadowNoise : public testing::TestWithParam<SunCase> {};

TEST_P(ShadowNoise, OfSixteenSamplesIsLessWhenDenoisedAndOverFramesLessThanThatOfSixtyFour) {
    constexpr uvec2 large(320, 180);  // penumbras a few pixels wide have no neighbours to learn from
    const Scene scene = findBuiltinScene(GetParam().scene)->make();
    const View view = GetParam().view(scene);
    const std::string raw = "sun_visibility_raw";
    const Settings sixteen = settingsOf(with({"shadow.history=32"}));
    const Settings sixtyFour = settingsOf(with({"shadow.samples=64"}));
    const FloatImage limit = renderMean(scene, view, large, sixtyFour, {raw}, 16, /*seed=*/1).images.at(raw);
    const Pictures few = render(scene, view, large, sixteen, {raw, "sun_visibility"});
    const double fewRaw = meanSquare(few.images.at(raw), limit);
    const double fewCleaned = meanSquare(few.images.at("sun_visibility"), limit);
    const double many = meanSquare(render(scene, view, large, sixtyFour, {raw}).images.at(raw), limit);
    const double rested =
        meanSquare(render(scene, view, large, sixteen, {"sun_visibility"}, 16).images.at("sun_visibility"), limit);
    RecordProperty("raw_16", fmt::format("{:.3g}", fewRaw));
    RecordProperty("cleaned_16", fmt::format("{:.3g}", fewCleaned));
    RecordProperty("cleaned_16_over_16_frames", fmt::format("{:.3g}", rested));
    RecordProperty("raw_64", fmt::format("{:.3g}", many));
    EXPECT_LT(fewCleaned, 0.85 * fewRaw);
    EXPECT_LT(rested, many);
}

INSTANTIATE_TEST_SUITE_P(Scenes, ShadowNoise, testing::Values(colonnadeWide, cubesWide), nameOf);

}  // namespace
}  // namespace reflet::test::shadow_truth_test
