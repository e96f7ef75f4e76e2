// Output of `reflet reference`, both complete and interrupted.
#include "base/json.h"
#include "base/json_text.h"
#include "cli/reference_program.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <csignal>
#include <filesystem>
#include <regex>

namespace reflet::reference_test {
namespace {

constexpr int failed = 1;
constexpr int killed = 128;

// Output.

TEST_F(Reference, AnExrHoldsAllLayersWithTheNamesAndChannelsOfTheRenderers) {
    ASSERT_TRUE(quietSuccess(reference(cubes, {"--spp", "2", "-o", "a.exr"})));
    EXPECT_EQ(files(), Names{"a.exr"});
    const Names rgb{"R", "G", "B"};
    const std::map<std::string, Names> expected{{"", rgb},
                                                {"final", rgb},
                                                {"direct", rgb},
                                                {"indirect_diffuse", rgb},
                                                {"indirect_specular", rgb},
                                                {"albedo", rgb},
                                                {"depth", {"Y"}},
                                                {"normal", {"X", "Y", "Z"}},
                                                {"sun_visibility", {"Y"}}};
    const auto all = layers("a.exr");
    std::map<std::string, Names> found;
    for (const ImageLayer& layer : all) {
        found[layer.name] = layer.image.channels;
        EXPECT_EQ(layer.pixelType, PixelType::float32) << layer.name;
        EXPECT_GT(largest(layer.image), 0.0F) << layer.name;
    }
    EXPECT_EQ(found, expected);
    EXPECT_EQ(all.size(), expected.size());

    ASSERT_TRUE(quietSuccess(
        render(cubes, {"-o", "r.exr", "--aov",
                       "final,direct,indirect_diffuse,indirect_specular,albedo,depth,normal,sun_visibility"})));
    for (const ImageLayer& layer : layers("r.exr")) {
        EXPECT_EQ(layer.image.channels, found.at(layer.name)) << layer.name;
    }
}

// The effect on the sharp picture is much nearer to the shutter's.
TEST_F(Reference, AShutterBlursWhatMovesAndMotionBlurComesNearIt) {
    const Arguments moving{"builtin:moving", "--time", "0.5", "--fps", "6"};
    const auto at = [&](const char* command, const Arguments& more) {
        Arguments all{command};
        all.insert(all.end(), moving.begin(), moving.end());
        all.insert(all.end(), more.begin(), more.end());
        return run(all);
    };
    const Arguments traced{"--size", "96x54", "--bounces", "0", "--spp", "32"};
    const auto trace = [&](const std::string& shutter, const std::string& file) {
        Arguments more = traced;
        more.insert(more.end(), {"--shutter", shutter, "-o", file});
        return at("reference", more);
    };
    ASSERT_TRUE(quietSuccess(trace("1", "shutter.exr")));
    ASSERT_TRUE(quietSuccess(run({"reference", "builtin:moving", "--time", "0.5", "--size", "96x54", "--bounces", "0",
                                  "--spp", "32", "-o", "sharp.exr"})));
    ASSERT_TRUE(quietSuccess(at("motion-blur", {"--picture", "sharp.exr", "--set", "motion_blur.shutter=1", "--set",
                                                "motion_blur.max_length=0.5", "-o", "blurred.exr"})));
    const auto error = [&](const char* file) {
        const Outcome compared = run({"compare", file, "shutter.exr", "--json"});
        return parseJson(compared.out).at("relative_mse").get<double>();
    };
    EXPECT_GT(error("sharp.exr"), 0.0015);
    EXPECT_LT(error("blurred.exr"), 0.4 * error("sharp.exr"));
    const Outcome still = trace("0", "x.exr");
    EXPECT_EQ(still.status, 2);
    EXPECT_NE(still.err.find("--fps is only for sequences"), std::string::npos) << still.err;
}

TEST_F(Reference, OneRunWritesPngAndExrAndNothingElse) {
    ASSERT_TRUE(quietSuccess(reference(cubes, {"--spp", "2", "-o", "a.png", "-o", "b.exr", "-o", "c.png"})));
    EXPECT_EQ(files(), (Names{"a.png", "b.exr", "c.png"}));
    const Bitmap bitmap = readBitmap(path("a.png"));
    EXPECT_EQ(bitmap.width, 32U);
    EXPECT_EQ(bitmap.height, 18U);
    EXPECT_GT(*std::ranges::max_element(bitmap.data), *std::ranges::min_element(bitmap.data));
    EXPECT_EQ(read("a.png"), read("c.png"));
    ASSERT_TRUE(quietSuccess(reference(cubes, {"--spp", "2", "-o", "b2.exr"})));
    EXPECT_EQ(read("b.exr"), read("b2.exr"));
}

TEST_F(Reference, ExposureChangesThePngAndNotTheValues) {
    const Arguments outputs{"--spp", "2", "-o", "a.png", "-o", "a.exr"};
    ASSERT_TRUE(quietSuccess(reference(cubes, outputs)));
    const std::string png = read("a.png");
    const std::string exr = read("a.exr");
    Arguments brighter = outputs;
    brighter.insert(brighter.end(), {"--set", "tonemap.exposure=1"});
    ASSERT_TRUE(quietSuccess(reference(cubes, brighter)));
    EXPECT_NE(png, read("a.png"));
    EXPECT_EQ(exr, read("a.exr"));
}

TEST_F(Reference, TellsAnAutomaticExposureWhichIsThatOfTheRenderer) {
    const Arguments on{"--set", "tonemap.auto_exposure=on", "--set", "tonemap.exposure=0.5"};
    Arguments more{"--spp", "16", "-o", "a.png"};
    more.insert(more.end(), on.begin(), on.end());
    const Outcome done = reference(cubes, more);
    ASSERT_TRUE(quietSuccess(done));
    std::smatch match;
    ASSERT_TRUE(std::regex_search(done.out, match, std::regex("; exposure ([-+][0-9.]+) stops\n"))) << done.out;
    Arguments rendered{"-o", "b.png", "--timings", "t.json"};
    rendered.insert(rendered.end(), on.begin(), on.end());
    ASSERT_TRUE(quietSuccess(render(cubes, rendered)));
    EXPECT_NEAR(std::stod(match[1]), parseJson(read("t.json")).at("exposure").get<double>(), 0.3);
}

TEST_F(Reference, TheSameSeedGivesTheSameBytesWhateverTheThreads) {
    const std::string standard = bytes({});
    EXPECT_EQ(standard, bytes({}));
    EXPECT_EQ(standard, bytes({"--seed", "0"}));
    for (const char* threads : {"1", "2", "5"}) {
        EXPECT_EQ(standard, bytes({"--threads", threads})) << threads << " threads";
    }
    EXPECT_NE(standard, bytes({"--seed", "1"}));
}

TEST_F(Reference, OneLineTellsSamplesNoiseRaysAndRaysPerSecond) {
    const Outcome done = reference(cubes, {"--spp", "5", "-o", "a.png"});
    ASSERT_TRUE(quietSuccess(done));
    const std::regex line(
        "5 samples per pixel, noise [0-9.]+; [0-9.]+ million rays in [0-9.]+ s: "
        "[0-9.]+ million rays per second\n");
    EXPECT_TRUE(std::regex_match(done.out, line)) << done.out;
}

TEST_F(Reference, TheNoiseOfOneSampleIsUnknown) {
    const Outcome done = reference(cubes, {"--spp", "1", "-o", "a.png"});
    ASSERT_TRUE(quietSuccess(done));
    EXPECT_TRUE(done.out.starts_with("1 sample per pixel, noise unknown; ")) << done.out;
}

TEST_F(Reference, HelpNamesEveryOptionAndSaysWhatTheLayersAre) {
    const Outcome help = run({"reference", "--help"});
    ASSERT_TRUE(quietSuccess(help));
    for (const char* words : {"SCENE",
                              "--scene",
                              "--camera",
                              "--view-file",
                              "--size",
                              "--preset",
                              "--settings",
                              "--set",
                              "--seed",
                              "--output",
                              "--bounces",
                              "--spp",
                              "--noise",
                              "--filter",
                              "--sampling",
                              "--visible-only",
                              "--threads",
                              "final (also without a name, for viewers), direct, indirect_diffuse, indirect_specular",
                              "albedo, normal, depth and sun_visibility",
                              "Noise is",
                              "materials.lambert_only",
                              "Ctrl-C",
                              "Example: reflet reference"}) {
        EXPECT_NE(help.out.find(words), std::string::npos) << words;
    }
}

// Interrupts.

TEST_F(Reference, AnInterruptWritesWhatWasDoneAndEndsWithOne) {
    for (const int signal : {SIGINT, SIGTERM}) {
        const Arguments longRun{"--spp", "1000000", "--filter", "center", "-o", "a.exr", "-o", "a.png"};
        const Outcome done = interrupt(arguments(cubes, longRun), {signal});
        EXPECT_TRUE(refused(done, failed, {"of 1000000 samples per pixel; a.exr, a.png hold the samples so far"}));
        std::smatch number;
        ASSERT_TRUE(std::regex_search(done.err, number, std::regex("interrupted after ([0-9]+) of "))) << done.err;
        EXPECT_GE(std::stoi(number[1]), 1);
        EXPECT_EQ(files(), (Names{"a.exr", "a.png"}));
        Images all = images("a.exr");
        EXPECT_EQ(all.size(), 9U);
        for (size_t i = 0; i < all["depth"].data.size(); ++i) {  // every pixel has been sampled
            ASSERT_TRUE(all["depth"].data[i] == 0.0F || all["albedo"].data[3 * i + 1] > 0.0F) << i;
        }
        std::filesystem::remove(path("a.exr"));
    }
}

TEST_F(Reference, ALaterInterruptKeepsTheSamplesSoFar) {
    const double work = 1.5;  // seconds of all cores
    const Outcome done = interrupt(arguments(cubes, {"--noise", "1e-6", "-o", "a.exr"}), {SIGINT}, work);
    EXPECT_TRUE(refused(done, failed, {"interrupted after ", " samples per pixel; a.exr holds the samples so far"}));
    Images all = images("a.exr");
    EXPECT_EQ(all.size(), 9U);
    EXPECT_GT(mean(all[""]), 0.01F);
}

TEST_F(Reference, ASecondInterruptEndsAtOnceAndLeavesNoFile) {
    // Between the two signals it cannot finish the first sample of so many pixels.
    const Outcome done =
        interrupt({"reference", "builtin:cornell", "--size", "1500x1000", "-o", "a.exr"}, {SIGINT, SIGINT});
    EXPECT_EQ(done.status, killed + SIGINT);
    EXPECT_EQ(files(), Names{});
}

}  // namespace
}  // namespace reflet::reference_test
