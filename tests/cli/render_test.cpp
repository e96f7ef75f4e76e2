// Output of successful runs of `reflet render`.
#include "cli/program.h"

#include "base/image_file.h"
#include "base/json_text.h"
#include "base/math.h"

#include <nlohmann/json.hpp>

#include <map>

namespace reflet::render_test {
namespace {

using Names = std::vector<std::string>;
const std::string cubes = "builtin:cubes";
const std::string secondLayer = "trace_screen.thickness_mode=second_layer";  // required by back_depth
const std::string cascades = "shadow.cascades=2";                            // required by cascade_index

class Render : public ProgramTest {
protected:
    /// The bytes of the picture rendered with these arguments.
    [[nodiscard]] std::string picture(const Arguments& more) const {
        Arguments all{"-o", "picture.png"};
        all.insert(all.end(), more.begin(), more.end());
        EXPECT_TRUE(quietSuccess(render(cubes, all)));
        return read("picture.png");
    }
    [[nodiscard]] Names names(const std::string& list) const { return firstWords(run({"list", list}).out); }
};

TEST_F(Render, WritesEveryOutputOfOneRunAndNothingElse) {
    const Outcome done = render(cubes, {"-o", "a.png", "-o", "b.png", "-o", "c.exr"});
    ASSERT_TRUE(quietSuccess(done));
    EXPECT_EQ(done.out, "");
    EXPECT_EQ(files(), (Names{"a.png", "b.png", "c.exr"}));
    const Bitmap bitmap = readBitmap(path("a.png"));
    EXPECT_EQ(bitmap.width, 32U);
    EXPECT_EQ(bitmap.height, 18U);
    EXPECT_EQ(read("a.png"), read("b.png"));
    const auto all = layers("c.exr");
    ASSERT_EQ(all.size(), 1U);
    EXPECT_EQ(all[0].image.channels, (Names{"R", "G", "B"}));
    EXPECT_GT(mean(all[0].image), 0.01F);
}

TEST_F(Render, ATerminalIsToldWhatWasWritten) {
    const std::string command =
        std::string(REFLET_PROGRAM) + " render builtin:cubes --preset direct --size 8x8 -o a.png";
    const Outcome done = runOther("script", {"-qec", command, "/dev/null"});
    if (done.err.find("pseudo-terminal") != std::string::npos) {
        GTEST_SKIP() << "no terminal can be made here";
    }
    EXPECT_EQ(done.status, 0) << done.err;
    EXPECT_NE(done.out.find("written: a.png"), std::string::npos) << done.out;
}

// Over 5 s: its processes each have their shaders compiled by the driver.
TEST_F(Render, TheSceneMayStandAfterAnyOption) {
    for (const Arguments& option :
         {Arguments{"-o", "b.png"}, Arguments{"--set", "diffuse.rays=1"}, Arguments{"--frames", "1"}}) {
        Arguments all{"render", "-o", "a.png", "--size", "8x8", "--preset", "direct"};
        all.insert(all.end(), option.begin(), option.end());
        all.push_back(cubes);
        EXPECT_TRUE(quietSuccess(run(all))) << option.front();
    }
}

TEST_F(Render, AnExrHoldsTheNamedLayersBesideTheMainImage) {
    ASSERT_TRUE(quietSuccess(render(cubes, {"-o", "a.exr", "--aov", "normal,depth", "--aov", "direct,normal"})));
    const auto all = layers("a.exr");
    ASSERT_EQ(all.size(), 4U);
    const std::vector<std::pair<std::string, Names>> expected{
        {"", {"R", "G", "B"}}, {"depth", {"Y"}}, {"direct", {"R", "G", "B"}}, {"normal", {"X", "Y", "Z"}}};
    for (size_t i = 0; i < expected.size(); ++i) {
        EXPECT_EQ(all[i].name, expected[i].first);
        EXPECT_EQ(all[i].image.channels, expected[i].second);
    }
}

// What each show holds in each scene is tested by Sweep, without a process for each.
// Over 5 s: its processes each have their shaders compiled by the driver.
TEST_F(Render, AShowMakesAPictureAndValuesOfItsSize) {
    const std::map<std::string, uvec2> sizes{
        {"final", {32, 18}},      {"depth", {32, 18}}, {"lamp_visibility", {32, 18}},
        {"shadow_map", {64, 64}}, {"rays", {4, 3}},    {"probe_atlas", {6 * 16, 16}}};
    for (const auto& [show, wanted] : sizes) {
        const std::string scene = show.starts_with("lamp_") ? "builtin:cornell" : cubes;  // cubes has no lamps
        const std::string probes = show == "probe_atlas" ? "probes.enabled=true" : "probes.enabled=false";
        ASSERT_TRUE(
            quietSuccess(render(scene, {"-o", "a.png", "-o", "a.exr", "--show", show, "--set", "shadow.resolution=64",
                                        "--set", "probes.resolution=16", "--set", "probes.count=1", "--set", probes})))
            << show;
        const auto all = layers("a.exr", wanted.x, wanted.y);
        ASSERT_EQ(all.size(), 1U) << show;
        EXPECT_EQ(readBitmap(path("a.png")).width, all[0].image.width) << show;
    }
}

TEST_F(Render, AllListedShowsOfTheFramesSizeFitIntoOneFile) {
    Names shows = names("shows");
    ASSERT_GE(shows.size(), 20U);
    for (const char* ofOwnSize : {"shadow_map", "lamp_count", "probe_atlas", "rays", "diffuse_rays", "specular_rays",
                                  "tile_class", "velocity_tiles"}) {
        std::erase(shows, ofOwnSize);
    }
    std::string aovs;
    for (const std::string& show : shows) {
        aovs += (aovs.empty() ? "" : ",") + show;
    }
    write("lens.json", R"({"camera": {"aperture_radius": 0.01}})");
    ASSERT_TRUE(
        quietSuccess(render("builtin:cornell", {"-o", "a.exr", "--view-file", "lens.json", "--aov", aovs, "--set",
                                                secondLayer, "--set", cascades, "--set", "ao.method=bitmask", "--set",
                                                "temporal.enabled=true", "--frames", "1"})));
    EXPECT_EQ(layers("a.exr").size(), shows.size() + 1);
}

// Over 5 s: its processes each have their shaders compiled by the driver.
TEST_F(Render, AnotherSeedGivesOtherNoise) {
    EXPECT_EQ(picture({}), picture({"--seed", "0"}));
    EXPECT_NE(picture({}), picture({"--seed", "1"}));
}

// Successive frames have different noise, and a sequence has them all.
TEST_F(Render, TheLastOfSeveralFramesIsWritten) {
    const Arguments noise{"--preset", "direct", "--set", "diffuse.rays=1"};
    Arguments sequence{"--frames", "3", "-o", "f_#.png"};
    sequence.insert(sequence.end(), noise.begin(), noise.end());
    ASSERT_TRUE(quietSuccess(render(cubes, sequence)));
    Arguments last{"--frames", "3"};
    last.insert(last.end(), noise.begin(), noise.end());
    const std::string written = picture(last);
    EXPECT_TRUE(written == read("f_2.png"));
    EXPECT_FALSE(written == read("f_1.png"));
}

// Over 5 s: stills compile shaders of their own.
TEST_F(Render, APictureWithoutAPresetIsAStill) {
    const Outcome still =
        run({"render", cubes, "--size", "32x18", "--seconds", "1", "--set", "shadow.resolution=256", "-o", "a.png"});
    ASSERT_EQ(still.status, 0) << still.err;
    EXPECT_NE(still.err.find("a still, lit by rays through the scene, with all bounces; at most 1 s"),
              std::string::npos);
    EXPECT_EQ(readBitmap(path("a.png")).width, 32U);
    const Outcome draft = run({"render", cubes, "--size", "32x18", "--effort", "draft", "--set", "probes.resolution=16",
                               "--set", "shadow.resolution=256", "-o", "b.png"});
    ASSERT_EQ(draft.status, 0) << draft.err;
    EXPECT_NE(draft.err.find("a still, lit by the screen and probes; at most 8 s"), std::string::npos);
    EXPECT_TRUE(quietSuccess(run({"render", cubes, "--size", "32x18", "--preset", "plain", "-o", "c.png"})));
}

TEST_F(Render, AnEffortIsForAStill) {
    const auto refusedWith = [&](const Arguments& more) {
        Arguments all{"render", cubes, "--size", "32x18", "-o", "a.png"};
        all.insert(all.end(), more.begin(), more.end());
        return run(all);
    };
    EXPECT_TRUE(refused(refusedWith({"--effort", "best"}), 2, {"--effort best", "draft, normal or high"}));
    EXPECT_TRUE(refused(refusedWith({"--effort", "high", "--frames", "3"}), 2, {"--effort", "--seconds"}));
    EXPECT_TRUE(refused(refusedWith({"--seconds", "0"}), 2, {"--seconds"}));
}

TEST_F(Render, TimingsTellEveryPassOfTheFrame) {
    ASSERT_TRUE(quietSuccess(render(cubes, {"--frames", "3", "--timings", "t.json"})));
    EXPECT_EQ(files(), Names{"t.json"});
    const auto timings = parseJson(read("t.json"));
    EXPECT_FALSE(timings.at("device").get<std::string>().empty());
    EXPECT_EQ(timings.at("size"), parseJson("[32, 18]"));
    EXPECT_EQ(timings.at("frames"), 3);
    EXPECT_GT(timings.at("frame_ms"), 0.0);
    const auto& passes = timings.at("passes");
    for (const char* pass : {"gbuffer", "shadow_visibility", "direct", "diffuse.classify_tiles",
                             "diffuse.trace_at_once", "specular.trace_at_once", "composite", "tonemap"}) {
        EXPECT_TRUE(passes.contains(pass)) << pass;
    }
    EXPECT_FALSE(passes.contains("shadow_map")) << "drawn in the first frame, whose times are left out, and kept";
    for (const auto& [pass, ms] : passes.items()) {
        EXPECT_GT(ms, 0.0) << pass;
    }
}

// Over 5 s: its processes each have their shaders compiled by the driver.
TEST_F(Render, LaterSourcesOfSettingsWin) {
    write("bright.json", R"({"tonemap": {"exposure": 2}})");
    write("dark.json", R"({"tonemap": {"exposure": -2, "curve": "srgb"}, "trace_screen": {"jitter": false}})");
    const std::string standard = picture({"--preset", "direct"});
    const std::string bright = picture({"--preset", "direct", "--set", "tonemap.exposure=2"});
    EXPECT_NE(standard, bright);
    EXPECT_EQ(bright, picture({"--settings", "bright.json", "--preset", "direct"}));
    EXPECT_EQ(standard, picture({"--set", "tonemap.exposure=0", "--preset", "direct", "--settings", "bright.json"}));
    EXPECT_EQ(bright, picture({"--preset", "direct", "--settings", "dark.json", "--settings", "bright.json", "--set",
                               "tonemap.curve=neutral"}));
    EXPECT_EQ(bright, picture({"--preset", "direct", "--set", "tonemap.exposure=1", "--set", "tonemap.exposure=2"}));
}

// Over 5 s: its processes each have their shaders compiled by the driver.
TEST_F(Render, ASettingsFileOverridesThePreset) {
    write("rays.json", R"({"diffuse": {"rays": 4}, "specular": {"rays": 1}})");
    EXPECT_EQ(picture({}), picture({"--preset", "direct", "--settings", "rays.json"}));
    EXPECT_NE(picture({}), picture({"--preset", "direct"}));
}

TEST_F(Render, AViewFileChangesCameraSunAndEnvironment) {
    const std::string standard = picture({"--preset", "direct"});
    write("camera.json", R"({"camera": {"fov_y": 20}})");
    write("sun.json", R"({"sun": {"direction": [0.2, -1, 0.1]}})");
    write("dark.json", R"({"sun": {"irradiance": [0, 0, 0]}, "environment": {"radiance": [0, 0, 0]}})");
    EXPECT_NE(standard, picture({"--preset", "direct", "--view-file", "camera.json"}));
    EXPECT_NE(standard, picture({"--preset", "direct", "--view-file", "sun.json"}));
    ASSERT_TRUE(quietSuccess(render("builtin:tilted-cube", {"--view-file", "dark.json", "-o", "a.exr"})));
    EXPECT_EQ(mean(layers("a.exr").at(0).image), 0.0F);
}

// Over 5 s: its processes each have their shaders compiled by the driver.
TEST_F(Render, ACameraIsChosenByNumberOrName) {
    const std::string second = picture({"--preset", "direct", "--camera", "1"});
    EXPECT_EQ(second, picture({"--preset", "direct", "--camera", "side"}));
    const std::string first = picture({"--preset", "direct"});
    EXPECT_NE(second, first);
    EXPECT_EQ(first, picture({"--preset", "direct", "--camera", "main"}));
    EXPECT_EQ(first, picture({"--preset", "direct", "--camera", "0"}));
}

TEST_F(Render, AGltfFileIsAScene) {
    write("triangle.gltf", triangleAnd(R"("nodes": [{"mesh": 0}])"));
    ASSERT_TRUE(quietSuccess(render("triangle.gltf", {"-o", "a.exr", "--show", "depth", "--environment", "none"})));
    EXPECT_GT(mean(layers("a.exr").at(0).image), 0.0F);
}

TEST_F(Render, ADeviceIsChosenByNumberOrPartOfItsName) {
    const std::string name = run({"list", "devices"}).out.substr(3, 5);
    EXPECT_TRUE(quietSuccess(render(cubes, {"-o", "a.png", "--preset", "direct", "--device", "0"})));
    EXPECT_TRUE(quietSuccess(render(cubes, {"-o", "a.png", "--preset", "direct", "--device", name})));
}

TEST_F(Render, TheValidationLayersHaveNothingToSay) {
    EXPECT_TRUE(quietSuccess(render(cubes, {"-o", "a.png", "--validate", "--frames", "3"})));
    EXPECT_TRUE(quietSuccess(render("builtin:cave", {"--validate", "--set", "diffuse.rays=5"})));
}

}  // namespace
}  // namespace reflet::render_test
