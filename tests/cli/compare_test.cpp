// `reflet compare` end to end, on generated images and a rendered one.
#include "cli/program.h"

#include "base/image_file.h"
#include "base/json_text.h"
#include "base/math.h"

#include <nlohmann/json.hpp>

#include <cmath>
#include <limits>

namespace reflet::compare_test {
namespace {

constexpr uint32_t width = 8;
constexpr uint32_t height = 4;

using Layers = std::vector<ImageLayer>;

FloatImage filled(const std::vector<std::string>& channels, float value, uint32_t columns = width) {
    return {columns, height, channels, std::vector<float>(size_t{columns} * height * channels.size(), value)};
}

FloatImage rgb(float value) {
    return filled({"R", "G", "B"}, value);
}

/// 1 in the first `columns` columns, 0 elsewhere.
FloatImage leftColumns(const std::vector<std::string>& channels, uint32_t columns) {
    FloatImage image = filled(channels, 0.0F);
    for (size_t i = 0; i < image.data.size(); ++i) {
        image.data[i] = i / channels.size() % width < columns ? 1.0F : 0.0F;
    }
    return image;
}

class Compare : public ProgramTest {
protected:
    void writeLayers(std::string_view file, const Layers& layers) const { writeExr(path(file), layers); }
    void writeColor(std::string_view file, uint8_t value, uint32_t channels = 3) const {
        writePng(path(file),
                 Bitmap{width, height, channels, std::vector<uint8_t>(size_t{width} * height * channels, value)});
    }
    [[nodiscard]] Outcome compare(const Arguments& arguments) const {
        Arguments all{"compare"};
        all.insert(all.end(), arguments.begin(), arguments.end());
        return run(all);
    }
    /// The JSON output for these arguments.
    [[nodiscard]] nlohmann::json json(Arguments arguments) const {
        arguments.emplace_back("--json");
        const Outcome done = compare(arguments);
        EXPECT_TRUE(quietSuccess(done));
        return parseJsonIfValid(done.out);
    }
};

TEST_F(Compare, HelpNamesAndDefinesEveryMetric) {
    const Outcome help = compare({"--help"});
    ASSERT_TRUE(quietSuccess(help));
    for (const char* words :
         {"relative_mse  mean over pixels and channels of (a - b)² / (b² + 0.01)",
          "psnr          10 log10(peak² / mean of (a - b)²)", "flip          mean over pixels of FLIP",
          "mean          mean over pixels and channels of |a - b|", "max           largest |a - b|",
          "octave_2_4    relative_mse in the octave of wavelengths of 2 to 4 pixels",
          "octave_64_up  64 pixels and more, with the mean", "pixels        number of pixels compared",
          "alpha is ignored", "psnr: below X"}) {
        EXPECT_NE(help.out.find(words), std::string::npos) << words;
    }
}

TEST_F(Compare, ARenderedPictureIsEqualToItselfInEveryMetric) {
    ASSERT_TRUE(quietSuccess(render("builtin:cubes", {"-o", "a.exr", "-o", "a.png"})));
    for (const char* file : {"a.exr", "a.png"}) {
        const Outcome done = compare({file, file});
        ASSERT_TRUE(quietSuccess(done));
        EXPECT_EQ(
            firstWords(done.out),
            (std::vector<std::string>{"relative_mse", "psnr", "flip", "mean", "bias", "max", "octave_2_4", "octave_4_8",
                                      "octave_8_16", "octave_16_32", "octave_32_64", "octave_64_up", "pixels"}));
        EXPECT_NE(done.out.find("flip          0\n"), std::string::npos) << done.out;
        EXPECT_NE(done.out.find("psnr          inf dB\n"), std::string::npos) << done.out;
        EXPECT_NE(done.out.find("pixels        576 of 576\n"), std::string::npos) << done.out;
    }
}

TEST_F(Compare, JsonHoldsTheMetricsAndWhatWasCompared) {
    writeLayers("a.exr", {{"", rgb(1.5F)}});
    writeLayers("b.exr", {{"", rgb(1.0F)}});
    const nlohmann::json all = json({"a.exr", "b.exr"});
    EXPECT_EQ(all["picture"], "a.exr");
    EXPECT_EQ(all["truth"], "b.exr");
    EXPECT_EQ(all["kind"], "linear");
    EXPECT_EQ(all["size"], nlohmann::json({width, height}));
    EXPECT_EQ(all["pixels"], width * height);
    EXPECT_NEAR(all["relative_mse"].get<double>(), 0.25 / 1.01, 1e-9);
    EXPECT_NEAR(all["psnr"].get<double>(), 10.0 * std::log10(1.0 / 0.25), 1e-9);
    EXPECT_NEAR(all["mean"].get<double>(), 0.5, 1e-9);
    EXPECT_NEAR(all["max"].get<double>(), 0.5, 1e-9);
    EXPECT_GT(all["flip"].get<double>(), 0.05);
    EXPECT_TRUE(json({"a.exr", "a.exr"})["psnr"].is_null());
}

TEST_F(Compare, TheErrorIsSplitByOctaves) {
    writeLayers("reference.exr", {{"", rgb(0.0F)}});
    writeLayers("constant.exr", {{"", rgb(0.1F)}});
    FloatImage stripes = rgb(0.1F);  // of a wavelength of 2.7 pixels
    for (size_t i = 0; i < stripes.data.size(); ++i) {
        const double x = static_cast<double>(i / 3 % width) + 0.5;
        stripes.data[i] *= static_cast<float>(std::sqrt(2.0) * std::cos(2.0 * pi * x * 6.0 / 16.0));
    }
    writeLayers("stripes.exr", {{"", stripes}});
    for (const auto& [file, octave] :
         {std::pair("constant.exr", "octave_64_up"), std::pair("stripes.exr", "octave_2_4")}) {
        const nlohmann::json all = json({file, "reference.exr"});
        EXPECT_NEAR(all["relative_mse"].get<double>(), 1.0, 1e-5) << file;
        for (const char* name :
             {"octave_2_4", "octave_4_8", "octave_8_16", "octave_16_32", "octave_32_64", "octave_64_up"}) {
            EXPECT_NEAR(all[name].get<double>(), std::string_view(name) == octave ? 1.0 : 0.0, 1e-3) << file << name;
        }
    }
    EXPECT_TRUE(quietSuccess(compare({"constant.exr", "reference.exr", "--fail-above", "octave_2_4=1e-6"})));
    const Outcome above = compare({"stripes.exr", "reference.exr", "--fail-above", "octave_2_4=1e-6"});
    EXPECT_EQ(above.status, 1);
    EXPECT_NE(above.err.find(", above the limit 1e-06\n"), std::string::npos) << above.err;
}

TEST_F(Compare, DisplayPicturesCountAsTheyAreInTheFile) {
    writeColor("black.png", 0);
    writeColor("white.png", 255);
    const nlohmann::json all = json({"black.png", "white.png"});
    EXPECT_EQ(all["kind"], "display");
    EXPECT_EQ(all["psnr"], 0.0);
    EXPECT_NEAR(all["flip"].get<double>(), 0.96738, 1e-4);
}

TEST_F(Compare, ALayerIsNamedAfterAColonAndFinalIsTheUnnamedOne) {
    writeLayers("a.exr", {{"", rgb(1.0F)}, {"direct", rgb(3.0F)}, {"depth", filled({"Y"}, 7.0F)}});
    writeLayers("b.exr", {{"", rgb(2.0F)}, {"direct", rgb(7.0F)}, {"normal", filled({"X", "Y", "Z"}, 0.5F)}});
    EXPECT_EQ(json({"a.exr", "b.exr"})["max"], 1.0);
    EXPECT_EQ(json({"a.exr:final", "b.exr"})["max"], 1.0);
    EXPECT_EQ(json({"a.exr:direct", "b.exr:direct"})["max"], 4.0);
    EXPECT_EQ(json({"a.exr:direct", "b.exr:final"})["max"], 1.0);
    EXPECT_EQ(json({"a.exr:depth", "a.exr:depth"})["max"], 0.0);
    EXPECT_EQ(json({"b.exr:normal", "b.exr:normal"})["max"], 0.0);
}

TEST_F(Compare, AFileWhoseNameHasAColonIsThatFile) {
    for (const char* name : {"a:b.exr", "a.exr:direct", "C:a.exr"}) {
        writeLayers(name, {{"", rgb(1.0F)}, {"direct", rgb(3.0F)}});
        EXPECT_EQ(json({name, name})["max"], 0.0) << name;
    }
    EXPECT_EQ(json({"C:a.exr:direct", "a:b.exr"})["max"], 2.0);
}

TEST_F(Compare, AMissingLayerIsReportedWithTheAvailableOnesAndTheNearest) {
    writeLayers("a.exr", {{"", rgb(1.0F)}, {"direct", rgb(3.0F)}});
    EXPECT_TRUE(refused(compare({"a.exr:dirct", "a.exr"}), 1,
                        {"a.exr", "no layer 'dirct'", "its layers: final, direct", "did you mean 'direct'"}));
    writeLayers("b.exr", {{"direct", rgb(3.0F)}});
    EXPECT_TRUE(refused(compare({"a.exr", "b.exr"}), 1, {"b.exr", "no layer 'final'", "its layers: direct"}));
}

TEST_F(Compare, AlphaIsIgnored) {
    FloatImage withAlpha = filled({"R", "G", "B", "A"}, 1.0F);
    for (size_t i = 3; i < withAlpha.data.size(); i += 4) {
        withAlpha.data[i] = std::numeric_limits<float>::quiet_NaN();
    }
    writeLayers("a.exr", {{"", withAlpha}});
    writeLayers("b.exr", {{"", rgb(1.0F)}});
    EXPECT_EQ(json({"a.exr", "b.exr"})["max"], 0.0);
    writeColor("a.png", 70, 4);
    writeColor("b.png", 70, 3);
    EXPECT_EQ(json({"a.png", "b.png"})["max"], 0.0);
}

TEST_F(Compare, PicturesThatDoNotFitTogetherAreRefusedInOneLine) {
    writeLayers("a.exr", {{"", rgb(1.0F)}, {"depth", filled({"Y"}, 1.0F)}, {"motion", filled({"X", "Y"}, 1.0F)}});
    writeLayers("wide.exr", {{"", filled({"R", "G", "B"}, 1.0F, 9)}});
    writeColor("a.png", 1);
    EXPECT_TRUE(refused(compare({"a.exr", "wide.exr"}), 1, {"a.exr is 8x4", "wide.exr is 9x4"}));
    EXPECT_TRUE(refused(compare({"a.exr", "a.exr:depth"}), 1, {"a.exr has the channels R, G, B", "a.exr:depth has Y"}));
    EXPECT_TRUE(refused(compare({"a.exr:motion", "a.exr:motion"}), 1, {"X, Y", "only images with 1 or 3 channels"}));
    EXPECT_TRUE(refused(compare({"a.png", "a.exr"}), 2, {"a.png", "a.exr", "the same kind"}));
    EXPECT_TRUE(refused(compare({"a.exr", "missing.exr"}), 1, {"missing.exr", "No such file"}));
    EXPECT_TRUE(refused(compare({"a.exr", "missing.exr:direct"}), 1, {"missing.exr", "No such file"}));
    EXPECT_TRUE(refused(compare({"a.tif", "a.exr"}), 2, {"a.tif", ".png", ".exr"}));
    EXPECT_TRUE(refused(compare({"a.png:direct", "a.png"}), 2, {"a.png:direct", "only EXR files have layers"}));
    EXPECT_TRUE(refused(compare({"a.exr"}), 2, {"B"}));
}

TEST_F(Compare, NanIsReportedWithFilePixelChannelAndHowMany) {
    FloatImage bad = rgb(1.0F);
    bad.data[(2 * width + 5) * 3 + 2] = std::numeric_limits<float>::quiet_NaN();
    bad.data.back() = std::numeric_limits<float>::infinity();
    writeLayers("a.exr", {{"", rgb(1.0F)}});
    writeLayers("b.exr", {{"", bad}});
    EXPECT_TRUE(refused(compare({"a.exr", "b.exr"}), 1, {"b.exr: NaN at pixel (5, 2), channel B", "and 1 more"}));
}

TEST_F(Compare, AMaskLeavesItsLightPixels) {
    FloatImage wrongAtRight = leftColumns({"R", "G", "B"}, 6);
    writeLayers("a.exr", {{"", wrongAtRight}, {"mask", leftColumns({"Y"}, 5)}});
    writeLayers("b.exr", {{"", rgb(1.0F)}});
    EXPECT_EQ(json({"a.exr", "b.exr"})["max"], 1.0);
    const nlohmann::json layer = json({"a.exr", "b.exr", "--mask", "a.exr:mask"});
    EXPECT_EQ(layer["max"], 0.0);
    EXPECT_EQ(layer["pixels"], 5 * height);
    writeColor("light.png", 128);
    writeColor("dark.png", 127);
    EXPECT_EQ(json({"a.exr", "b.exr", "--mask", "light.png"})["pixels"], width * height);
    EXPECT_TRUE(refused(compare({"a.exr", "b.exr", "--mask", "dark.png"}), 1, {"mask leaves no pixels"}));
    writeLayers("wide.exr", {{"", filled({"Y"}, 1.0F, 9)}});
    EXPECT_TRUE(refused(compare({"a.exr", "b.exr", "--mask", "wide.exr"}), 1, {"wide.exr: the mask is 9x4", "8x4"}));
}

TEST_F(Compare, HitsArePixelsWhereBothFilesHaveData) {
    FloatImage confidence = leftColumns({"R", "G"}, 6);
    for (size_t i = 0; i < confidence.data.size(); i += 2) {
        confidence.data[i] = 0.0F;  // one channel suffices
    }
    writeLayers("a.exr", {{"", rgb(1.0F)}, {"confidence", confidence}, {"depth", leftColumns({"Y"}, 1)}});
    FloatImage depth = leftColumns({"Y"}, 2);
    for (float& v : depth.data) {
        v = 1.0F - v;
    }
    writeLayers("b.exr", {{"", rgb(1.0F)}, {"depth", depth}});
    EXPECT_EQ(json({"a.exr", "b.exr", "--mask", "hits"})["pixels"], 4 * height);  // columns 2 to 5
    EXPECT_EQ(json({"b.exr", "b.exr", "--mask", "hits"})["pixels"], 6 * height);
}

TEST_F(Compare, HitsNeedTheLayersThatRecordThem) {
    writeLayers("a.exr", {{"", rgb(1.0F)}, {"depth", filled({"Y"}, 1.0F)}});
    writeLayers("b.exr", {{"", rgb(1.0F)}});
    writeColor("a.png", 1);
    EXPECT_TRUE(refused(compare({"a.exr", "b.exr", "--mask", "hits"}), 1, {"b.exr", "--aov depth"}));
    EXPECT_TRUE(refused(compare({"a.png", "a.png", "--mask", "hits"}), 1, {"a.png", "EXR"}));
}

TEST_F(Compare, TheHeatMapIsAPictureOfTheSameSizeDarkWhereNothingDiffers) {
    FloatImage wrongAtRight = leftColumns({"R", "G", "B"}, 4);
    writeLayers("a.exr", {{"", wrongAtRight}});
    writeLayers("b.exr", {{"", rgb(1.0F)}});
    ASSERT_TRUE(quietSuccess(compare({"a.exr", "b.exr", "--heatmap", "h.png", "--pixels-per-degree", "1"})));
    const Bitmap map = readBitmap(path("h.png"));
    EXPECT_EQ(map.width, width);
    EXPECT_EQ(map.height, height);
    EXPECT_LT(map.data[0], 40);
    EXPECT_GT(map.data[size_t{width - 1} * 3], 200);
    EXPECT_TRUE(refused(compare({"a.exr", "b.exr", "--heatmap", "h.exr"}), 2, {"h.exr", ".png"}));
    EXPECT_TRUE(refused(compare({"a.exr", "b.exr", "--heatmap", "no/h.png"}), 1, {"no/h.png", "create the folder"}));
}

// 2 of the reference's 8 are direct light; a quarter of the diffuse light is missing, and as much as half of the
// specular too much.
TEST_F(Compare, PathsTellWhichLightIsMissing) {
    writeLayers("a.exr", {{"direct", rgb(2.0F)}, {"indirect_diffuse", rgb(3.0F)}, {"indirect_specular", rgb(3.0F)}});
    writeLayers("b.exr", {{"direct", rgb(2.0F)}, {"indirect_diffuse", rgb(4.0F)}, {"indirect_specular", rgb(2.0F)}});
    const nlohmann::json result = json({"a.exr", "b.exr", "--paths"});
    EXPECT_NEAR(result.at("bias"), 0.0, 1e-6);
    ASSERT_EQ(result.at("paths").size(), 3U);
    const auto expect = [&](size_t i, const char* layer, double share, double part, double own) {
        const nlohmann::json& path = result.at("paths")[i];
        EXPECT_EQ(path.at("layer"), layer);
        EXPECT_NEAR(path.at("share"), share, 1e-6) << layer;
        EXPECT_NEAR(path.at("part_of_bias"), part, 1e-6) << layer;
        EXPECT_NEAR(path.at("bias"), own, 1e-6) << layer;
    };
    expect(0, "direct", 0.25, 0.0, 0.0);
    expect(1, "indirect_diffuse", 0.5, -0.125, -0.25);
    expect(2, "indirect_specular", 0.25, 0.125, 0.5);
    const Outcome table = compare({"a.exr", "b.exr", "--paths"});
    ASSERT_TRUE(quietSuccess(table));
    EXPECT_NE(table.out.find("indirect_diffuse       50.0%       -12.50%    -25.0%"), std::string::npos) << table.out;
}

TEST_F(Compare, PathsNeedLayersAndTwoImages) {
    writeLayers("a.exr", {{"", rgb(2.0F)}});
    EXPECT_TRUE(refused(compare({"a.exr", "a.exr", "--paths"}), 1, {"has no layer 'direct'", "--aov"}));
    EXPECT_TRUE(refused(compare({"a.exr:direct", "a.exr", "--paths"}), 2, {"expected an EXR file"}));
    EXPECT_TRUE(refused(compare({"a.exr", "a.exr", "--paths", "--fail-above", "flip=1"}), 2, {"--paths"}));
}

TEST_F(Compare, FailAboveExitsWithOneAndNamesMetricValueAndLimit) {
    writeLayers("a.exr", {{"", rgb(1.5F)}});
    writeLayers("b.exr", {{"", rgb(1.0F)}});
    EXPECT_TRUE(quietSuccess(compare({"a.exr", "b.exr", "--fail-above", "mean=0.5", "--fail-above", "psnr=6"})));
    const Outcome mean = compare({"--fail-above", "mean=0.4", "a.exr", "b.exr"});
    EXPECT_EQ(mean.status, 1);
    EXPECT_EQ(mean.err, "reflet: mean is 0.5, above the limit 0.4\n");
    EXPECT_EQ(firstWords(mean.out).size(), 13U);
    const Outcome both = compare({"a.exr", "b.exr", "--fail-above", "psnr=6.1", "--fail-above=max=0"});
    EXPECT_EQ(both.status, 1);
    EXPECT_EQ(both.err, "reflet: psnr is 6.0206 dB, below the limit 6.1; max is 0.5, above the limit 0\n");
}

TEST_F(Compare, InvalidLimitsAreUsageErrors) {
    writeLayers("a.exr", {{"", rgb(1.0F)}});
    EXPECT_TRUE(refused(compare({"a.exr", "a.exr", "--fail-above", "flop=1"}), 2,
                        {"no metric 'flop'", "relative_mse, psnr, flip, mean, bias, max", "did you mean 'flip'"}));
    for (const char* limit : {"flip", "flip=", "flip=x", "flip=1x", "flip=nan", "flip=inf"}) {
        EXPECT_TRUE(refused(compare({"a.exr", "a.exr", "--fail-above", limit}), 2, {limit, "METRIC=NUMBER"})) << limit;
    }
    EXPECT_TRUE(refused(compare({"a.exr", "a.exr", "--pixels-per-degree", "0"}), 2, {"--pixels-per-degree"}));
}

}  // namespace
}  // namespace reflet::compare_test
