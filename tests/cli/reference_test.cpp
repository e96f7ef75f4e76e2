// `reflet reference` end to end, on pictures so small that a few samples do.
#include "cli/program.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <csignal>
#include <filesystem>
#include <map>
#include <regex>

namespace reflet {
namespace {

constexpr int failed = 1;
constexpr int usage = 2;
constexpr int killed = 128;
const std::string cubes = "builtin:cubes";
const std::string tiltedCube = "builtin:tilted-cube";  // stands before a background

using Names = std::vector<std::string>;
using Images = std::map<std::string, FloatImage>;

class Reference : public ProgramTest {
protected:
    [[nodiscard]] static Arguments arguments(const std::string& scene, const Arguments& more) {
        Arguments all{"reference", scene, "--size", "32x18"};
        all.insert(all.end(), more.begin(), more.end());
        return all;
    }
    [[nodiscard]] Outcome reference(const std::string& scene, const Arguments& more) const {
        return run(arguments(scene, more));
    }
    /// The bytes of the EXR of the cubes.
    [[nodiscard]] std::string bytes(const Arguments& more) const {
        Arguments all{"--spp", "3", "-o", "bytes.exr"};
        all.insert(all.end(), more.begin(), more.end());
        EXPECT_TRUE(quietSuccess(reference(cubes, all)));
        return read("bytes.exr");
    }
    /// The EXR's layers by their names.
    [[nodiscard]] Images images(std::string_view file) const {
        Images result;
        for (ImageLayer& layer : layers(file)) {
            result.emplace(layer.name, std::move(layer.image));
        }
        return result;
    }
    [[nodiscard]] Images traced(const std::string& scene, const Arguments& more) const {
        Arguments all{"-o", "traced.exr"};
        all.insert(all.end(), more.begin(), more.end());
        EXPECT_TRUE(quietSuccess(reference(scene, all)));
        return images("traced.exr");
    }
    [[nodiscard]] Outcome wrong(const Arguments& more) const {
        Arguments all{"-o", "a.exr", "--spp", "1"};
        all.insert(all.end(), more.begin(), more.end());
        return reference(cubes, all);
    }
    [[nodiscard]] double relativeMse(const std::string& a, const std::string& b) const {
        const Outcome done = run({"compare", a, b, "--json"});
        EXPECT_TRUE(quietSuccess(done));
        return nlohmann::json::parse(done.out)["relative_mse"].get<double>();
    }
};

float largest(const FloatImage& image) {
    return std::ranges::max(image.data);
}

/// How many values are neither 0 nor 1.
ptrdiff_t between(const FloatImage& image) {
    return std::ranges::count_if(image.data, [](float v) { return v > 0.0F && v < 1.0F; });
}

// What the command line gives.

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

TEST_F(Reference, FinalIsDirectPlusBothIndirectLayers) {
    Images a = traced("builtin:cornell", {"--spp", "4"});
    for (size_t i = 0; i < a[""].data.size(); ++i) {
        const float sum = a["direct"].data[i] + a["indirect_diffuse"].data[i] + a["indirect_specular"].data[i];
        ASSERT_FLOAT_EQ(sum, a[""].data[i]) << "value " << i;
    }
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

TEST_F(Reference, OneSampleDoesNotTellTheNoise) {
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
                              "materials.lambertOnly",
                              "Ctrl-C",
                              "Example: reflet reference"}) {
        EXPECT_NE(help.out.find(words), std::string::npos) << words;
    }
}

// What the options do.

TEST_F(Reference, WithoutBouncesThereIsNoIndirectLight) {
    Images none = traced(cubes, {"--spp", "2", "--bounces", "0"});
    EXPECT_EQ(largest(none["indirect_diffuse"]), 0.0F);
    EXPECT_EQ(largest(none["indirect_specular"]), 0.0F);
    EXPECT_EQ(none[""].data, none["direct"].data);
}

TEST_F(Reference, EachBounceBringsMoreLight) {
    const Arguments common{"--spp", "8", "--bounces"};
    float before = 0.0F;
    for (const char* bounces : {"0", "1", "2", "4"}) {
        Arguments all = common;
        all.emplace_back(bounces);
        const float light = mean(traced("builtin:cornell", all)[""]);
        EXPECT_GT(light, before) << bounces << " bounces";
        before = light;
    }
    EXPECT_GE(mean(traced("builtin:cornell", {"--spp", "8"})[""]), before);  // with no limit
}

TEST_F(Reference, WhatTheCameraSeesNeverBringsMoreLightThanEverything) {
    Images all = traced(cubes, {"--spp", "8"});
    Images visible = traced(cubes, {"--spp", "8", "--visible-only"});
    for (const char* layer : {"", "direct", "indirect_diffuse", "indirect_specular"}) {
        EXPECT_LE(mean(visible[layer]), mean(all[layer])) << layer;
    }
    EXPECT_LT(mean(visible["indirect_diffuse"]), mean(all["indirect_diffuse"]));
    EXPECT_LT(mean(visible["indirect_specular"]), mean(all["indirect_specular"]));
    for (const char* layer : {"direct", "albedo", "normal", "depth", "sun_visibility"}) {
        EXPECT_EQ(visible[layer].data, all[layer].data) << layer;  // of the same paths
    }
}

TEST_F(Reference, ANoiseThatIsReachedEndsEarlier) {
    const Outcome early = reference(cubes, {"--noise", "0.2", "--spp", "1000", "-o", "a.exr"});
    ASSERT_TRUE(quietSuccess(early));
    const int samples = std::stoi(early.out);
    EXPECT_GE(samples, 2);
    EXPECT_LT(samples, 1000);
    const std::string words = "noise ";
    EXPECT_LT(std::stod(early.out.substr(early.out.find(words) + words.size())), 0.2) << early.out;
    const Outcome same = reference(cubes, {"--spp", std::to_string(samples), "-o", "b.exr"});
    ASSERT_TRUE(quietSuccess(same));
    EXPECT_EQ(read("a.exr"), read("b.exr"));  // which samples a picture is made of does not depend on why it ended
    const Outcome limited = reference(cubes, {"--noise", "0.0001", "--spp", "3", "-o", "a.exr"});
    EXPECT_TRUE(limited.out.starts_with("3 samples per pixel, ")) << limited.out;
}

TEST_F(Reference, SamplesThroughThePixelsCentreSeeTheSilhouetteOfTheDepth) {
    for (const std::string filter : {"box", "center"}) {
        Images a = traced(tiltedCube, {"--spp", "16", "--filter", filter});
        size_t split = 0;  // background at the centre, and yet something of the cube, or the other way round
        for (size_t i = 0; i < a["depth"].data.size(); ++i) {
            const float depth = a["depth"].data[i];
            const float albedo = a["albedo"].data[3 * i];
            split += (depth > 0.0F) != (albedo > 0.0F) ? 1 : 0;
        }
        EXPECT_EQ(split == 0, filter == "center") << split;
    }
}

TEST_F(Reference, DepthIsTheRenderers) {
    for (const std::string& scene : {cubes, tiltedCube}) {
        ASSERT_TRUE(quietSuccess(reference(scene, {"--spp", "1", "--filter", "center", "-o", "ref.exr"})));
        ASSERT_TRUE(quietSuccess(render(scene, {"-o", "render.exr", "--aov", "depth"})));
        EXPECT_LT(relativeMse("ref.exr:depth", "render.exr:depth"), 1e-6) << scene;
    }
}

TEST_F(Reference, UniformSamplingIsAnotherNoiseOfTheSamePicture) {
    Images cosine = traced(cubes, {"--spp", "256", "--sampling", "cosine"});
    Images uniform = traced(cubes, {"--spp", "256", "--sampling", "uniform"});
    EXPECT_NE(cosine["indirect_diffuse"].data, uniform["indirect_diffuse"].data);
    const float expected = mean(cosine["indirect_diffuse"]);
    EXPECT_NEAR(mean(uniform["indirect_diffuse"]), expected, 0.02F * expected);
    EXPECT_EQ(cosine["direct"].data, uniform["direct"].data);
}

TEST_F(Reference, LambertOnlyHasNoSpecularLight) {
    EXPECT_GT(mean(traced(cubes, {"--spp", "2"})["indirect_specular"]), 0.0F);
    EXPECT_EQ(largest(traced(cubes, {"--spp", "2", "--set", "materials.lambertOnly=true"})["indirect_specular"]), 0.0F);
}

// Scene and view.

TEST_F(Reference, ACameraIsChosenByNumberOrName) {
    EXPECT_EQ(bytes({"--camera", "1"}), bytes({"--camera", "side"}));
    EXPECT_NE(bytes({"--camera", "1"}), bytes({"--camera", "main"}));
}

TEST_F(Reference, AViewFileChangesCameraSunAndEnvironmentAsItDoesForTheRenderer) {
    write("v.json", R"({"camera": {"position": [1, 2, 7], "target": [0, 0, 0], "fov_y": 50},
                        "sun": {"irradiance": [0, 0, 0]}, "environment": {"radiance": [0, 0, 2]}})");
    Images a = traced(tiltedCube, {"--view-file", "v.json", "--spp", "4"});
    EXPECT_EQ(std::vector<float>(a["direct"].data.begin(), a["direct"].data.begin() + 3),
              (std::vector<float>{0, 0, 2}));
    EXPECT_NE(a["depth"].data, traced(tiltedCube, {"--spp", "1"})["depth"].data);
    ASSERT_TRUE(quietSuccess(reference(tiltedCube, {"--view-file", "v.json", "--spp", "1", "-o", "ref.exr"})));
    ASSERT_TRUE(quietSuccess(render(tiltedCube, {"--view-file", "v.json", "-o", "render.exr", "--aov", "depth"})));
    EXPECT_LT(relativeMse("ref.exr:depth", "render.exr:depth"), 1e-6);
    write("dark.json", R"({"sun": {"irradiance": [0, 0, 0]}, "environment": {"radiance": [0, 0, 0]}})");
    EXPECT_EQ(largest(traced(tiltedCube, {"--view-file", "dark.json", "--spp", "2"})[""]), 0.0F);
}

TEST_F(Reference, AWideSunHasPenumbrasAndAPointHasNone) {
    const auto visibility = [&](const std::string& diameter) {
        write("v.json", R"({"sun": {"angular_diameter": )" + diameter + "}}");
        return traced(cubes, {"--view-file", "v.json", "--spp", "16", "--filter", "center"})["sun_visibility"];
    };
    EXPECT_EQ(between(visibility("0")), 0);
    EXPECT_GT(between(visibility("30")), 10);
}

TEST_F(Reference, AnEnvironmentImageShinesHereAndInTheRenderer) {
    // One texel, 1 in all channels.
    write("sky.hdr", std::string("#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 1 +X 1\n") + "\x80\x80\x80\x81");
    write("image.json", R"({"sun": {"irradiance": [0, 0, 0]}, "environment": {"image": "sky.hdr", "intensity": 3}})");
    write("plain.json", R"({"sun": {"irradiance": [0, 0, 0]}, "environment": {"radiance": [3, 3, 3]}})");
    Images image = traced(tiltedCube, {"--view-file", "image.json", "--spp", "256"});
    Images plain = traced(tiltedCube, {"--view-file", "plain.json", "--spp", "256"});
    EXPECT_EQ(image["direct"].data.front(), 3.0F);  // the background
    EXPECT_EQ(image["direct"].data, plain["direct"].data);
    const float expected = mean(plain["indirect_diffuse"]);
    EXPECT_GT(expected, 0.01F);
    EXPECT_NEAR(mean(image["indirect_diffuse"]), expected, 0.02F * expected);
    ASSERT_TRUE(quietSuccess(render(tiltedCube, {"--view-file", "image.json", "-o", "image.exr", "--aov", "direct"})));
    ASSERT_TRUE(quietSuccess(render(tiltedCube, {"--view-file", "plain.json", "-o", "plain.exr", "--aov", "direct"})));
    EXPECT_EQ(relativeMse("image.exr", "plain.exr"), 0.0);
    EXPECT_EQ(relativeMse("image.exr:direct", "plain.exr:direct"), 0.0);
}

TEST_F(Reference, NoVulkanDeviceIsNeeded) {
    EXPECT_TRUE(
        quietSuccess(run(arguments(cubes, {"--spp", "1", "-o", "a.exr", "-o", "a.png"}),
                         {{"VK_ICD_FILENAMES", "/nowhere/none.json"}, {"VK_DRIVER_FILES", "/nowhere/none.json"}})));
}

// Interrupts.

TEST_F(Reference, AnInterruptWritesWhatWasDoneAndEndsWithOne) {
    for (const int signal : {SIGINT, SIGTERM}) {
        const Arguments longRun{"--spp", "1000000", "--filter", "center", "-o", "a.exr", "-o", "a.png"};
        const Outcome done = interrupt(arguments(cubes, longRun), {signal});
        EXPECT_TRUE(refused(done, failed, {"of 1000000 samples per pixel; a.exr, a.png hold what was done"}));
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
    EXPECT_TRUE(refused(done, failed, {"interrupted after ", " samples per pixel; a.exr holds what was done"}));
    Images all = images("a.exr");
    EXPECT_EQ(all.size(), 9U);
    EXPECT_GT(mean(all[""]), 0.01F);
}

TEST_F(Reference, ASecondInterruptEndsAtOnceAndLeavesNoFile) {
    // Between the two, the first sample of so many pixels is not done.
    const Outcome done =
        interrupt({"reference", "builtin:cornell", "--size", "1500x1000", "-o", "a.exr"}, {SIGINT, SIGINT});
    EXPECT_EQ(done.status, killed + SIGINT);
    EXPECT_EQ(files(), Names{});
}

// What cannot be.

TEST_F(Reference, ARunThatWouldWriteNothingIsRefused) {
    EXPECT_TRUE(refused(reference(cubes, {}), usage, {"nothing to write", "-o FILE.exr", "reflet reference --help"}));
}

TEST_F(Reference, AnOutputOfUnknownFormatIsRefused) {
    EXPECT_TRUE(refused(reference(cubes, {"-o", "a.jpg"}), usage, {"a.jpg", ".exr", ".png"}));
    EXPECT_TRUE(refused(reference(cubes, {"-o", "a.exr", "-o", "picture"}), usage, {"picture", ".exr", ".png"}));
    EXPECT_EQ(files(), Names{});
}

TEST_F(Reference, NumbersAreChecked) {
    const std::vector<Names> all{{"--spp", "0"},      {"--spp", "-1"},     {"--spp", "1048577"}, {"--spp", "few"},
                                 {"--bounces", "-1"}, {"--bounces", "x"},  {"--noise", "-0.1"},  {"--noise", "nan"},
                                 {"--noise", "low"},  {"--threads", "-1"}, {"--seed", "-1"},     {"--size", "0x4"}};
    for (const Names& option : all) {
        Arguments more{"-o", "a.exr"};
        more.insert(more.end(), option.begin(), option.end());
        Arguments whole{"reference", cubes};
        whole.insert(whole.end(), more.begin(), more.end());
        EXPECT_TRUE(refused(run(whole), usage, {option[0], option[1]})) << option[0] << " " << option[1];
    }
    EXPECT_EQ(files(), Names{});
}

TEST_F(Reference, ASizeBeyondWhatAFileHoldsIsToldTheLimit) {
    EXPECT_TRUE(refused(run({"reference", cubes, "-o", "a.exr", "--size", "4000000000x10"}), usage,
                        {"--size 4000000000x10", "up to 65536 pixels a side"}));
}

TEST_F(Reference, ChoicesAreChecked) {
    EXPECT_TRUE(refused(wrong({"--filter", "x"}), usage, {"--filter", "x", "box", "center", "--help"}));
    EXPECT_TRUE(refused(wrong({"--sampling", "x"}), usage, {"--sampling", "x", "cosine", "uniform", "--help"}));
    EXPECT_TRUE(refused(wrong({"--camera", "nowhere"}), usage, {"'nowhere'", "'main'"}));
    EXPECT_TRUE(refused(wrong({"--preset", "fst"}), usage, {"'fst'", "did you mean 'fast'"}));
    EXPECT_TRUE(refused(wrong({"--set", "materials.lambert=1"}), usage, {"did you mean 'materials.lambertOnly'"}));
}

TEST_F(Reference, AnUnknownOptionIsNamedWithTheNearest) {
    EXPECT_TRUE(refused(wrong({"--bounce", "3"}), usage, {"'--bounce'", "did you mean '--bounces'"}));
    EXPECT_TRUE(refused(wrong({"--frobnicate"}), usage, {"'--frobnicate'", "reflet reference --help"}));
    EXPECT_TRUE(refused(run({"reference"}), usage, {"SCENE", "--help"}));
    EXPECT_TRUE(refused(run({"referense", cubes}), usage, {"did you mean 'reference'"}));
}

TEST_F(Reference, ASceneOrViewFileThatIsBrokenIsNamedWithThePlace) {
    write("broken.gltf", "{ \"asset\": ");
    write("v.json", R"({"camera": {"positon": [1, 2, 3]}})");
    write("a.exr", "the old picture");
    EXPECT_TRUE(refused(reference("broken.gltf", {"-o", "a.exr"}), failed, {"broken.gltf", "JSON", "line 1"}));
    EXPECT_TRUE(refused(reference("absent.glb", {"-o", "a.exr"}), failed, {"absent.glb", "no file"}));
    EXPECT_TRUE(refused(reference("builtin:cubs", {"-o", "a.exr"}), usage, {"'cubs'", "did you mean 'cubes'"}));
    EXPECT_TRUE(refused(wrong({"--view-file", "v.json"}), failed, {"v.json: camera.positon", "did you mean"}));
    EXPECT_EQ(read("a.exr"), "the old picture");
    EXPECT_EQ(files(), (Names{"a.exr", "broken.gltf", "v.json"}));
}

TEST_F(Reference, AnOutputThatCannotBeWrittenIsNamedBeforeAnyWork) {
    const std::string manySamples = "1000000";  // which nobody waits for
    EXPECT_TRUE(refused(reference(cubes, {"--spp", manySamples, "-o", "a.exr", "-o", "absent/a.exr"}), failed,
                        {"absent/a.exr", "create the folder 'absent'"}));
    std::filesystem::create_directory(path("folder.exr"));
    EXPECT_TRUE(
        refused(reference(cubes, {"--spp", manySamples, "-o", "folder.exr"}), failed, {"folder.exr", "is a folder"}));
    EXPECT_EQ(files(), Names{"folder.exr"});
}

}  // namespace
}  // namespace reflet
