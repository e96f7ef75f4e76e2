// `reflet bench` end to end: its output and its errors. No test depends on measured times.
#include "base/json_text.h"
#include "cli/program.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>

namespace reflet::bench_test {

namespace {

class BenchTest : public ProgramTest {
protected:
    /// A quick `reflet bench builtin:cubes` that writes its numbers to out.json. Large probes, large shadow maps and
    /// measuring the bandwidth would take longer than all else.
    [[nodiscard]] Outcome bench(const Arguments& more, bool bandwidth = false) const {
        Arguments all{"bench",         "builtin:cubes",
                      "--first",       "2",
                      "--warmup",      "1",
                      "--frames",      "3",
                      "--json",        "out.json",
                      "--truth-spp",   "2",
                      "--truth-cache", "truths",
                      "--set",         "probes.resolution=16",
                      "--set",         "shadow.resolution=256"};
        if (!bandwidth) {
            all.emplace_back("--no-bandwidth");
        }
        if (std::ranges::find(more, "--sizes") == more.end()) {
            all.insert(all.end(), {"--size", "32x18"});
        }
        all.insert(all.end(), more.begin(), more.end());
        return run(all);
    }

    [[nodiscard]] nlohmann::json numbers() const { return parseJson(read("out.json")); }
    [[nodiscard]] size_t truths() const {
        return static_cast<size_t>(
            std::distance(std::filesystem::directory_iterator(path("truths")), std::filesystem::directory_iterator()));
    }
};

void expectSpread(const nlohmann::json& spread, size_t count) {
    EXPECT_EQ(spread.at("count"), count);
    EXPECT_LE(spread.at("min"), spread.at("lower_quartile"));
    EXPECT_LE(spread.at("lower_quartile"), spread.at("median"));
    EXPECT_LE(spread.at("median"), spread.at("upper_quartile"));
    EXPECT_LE(spread.at("upper_quartile"), spread.at("max"));
}

void expectState(const nlohmann::json& state, size_t frames) {
    EXPECT_EQ(state.at("frames"), frames);
    for (const char* total : {"wall_ms", "submitted_ms", "record_ms", "frame_ms"}) {
        expectSpread(state.at(total), frames);
        EXPECT_GT(state.at(total).at("median"), 0.0);
    }
    EXPECT_GE(state.at("recorded").at("passes"), state.at("passes").size());
    EXPECT_GT(state.at("recorded").at("barriers"), 0);
    EXPECT_LE(state.at("recorded").at("barriers"), state.at("recorded").at("passes"));
    EXPECT_TRUE(state.at("recorded").at("transient_bytes").is_number_unsigned());  // 0: all lie in histories' memory
    for (const char* kind : {"groups", "passes"}) {
        ASSERT_FALSE(state.at(kind).empty());
        for (const auto& [name, pass] : state.at(kind).items()) {
            SCOPED_TRACE(name);
            expectSpread(pass, frames);
            EXPECT_TRUE(pass.at("bytes").is_number_unsigned());
        }
    }
    for (const char* metric : {"relative_mse", "flip", "displayed_flip", "psnr", "bias"}) {
        EXPECT_TRUE(state.at("error").at(metric).is_number()) << metric;
    }
}

// Over 5 s: its processes each have their shaders compiled by the driver.
TEST_F(BenchTest, NumbersAreThereForEveryStateOfEveryPreset) {
    const Outcome outcome = bench({"--preset", "fast,games202"}, true);
    ASSERT_TRUE(quietSuccess(outcome));
    const nlohmann::json json = numbers();
    for (const char* text : {"reflet", "command", "device", "driver"}) {
        EXPECT_FALSE(json.at(text).get<std::string>().empty()) << text;
    }
    EXPECT_GT(json.at("bandwidth_bytes_per_s"), 0.0);
    ASSERT_EQ(json.at("runs").size(), 2U);
    EXPECT_EQ(json.at("runs")[0].at("variant"), "fast");
    EXPECT_EQ(json.at("runs")[1].at("variant"), "games202");
    for (const nlohmann::json& run : json.at("runs")) {
        SCOPED_TRACE(run.at("variant"));
        EXPECT_EQ(run.at("size"), (nlohmann::json{32, 18}));
        EXPECT_GT(run.at("triangles"), 0);
        EXPECT_GT(run.at("memory_bytes"), 32 * 18 * 8);
        expectState(run.at("first"), 2);
        expectState(run.at("steady"), 3);
        const bool atOnce = run.at("variant") == "games202";  // no source but the screen and the environment
        EXPECT_TRUE(run.at("steady").at("passes").contains(atOnce ? "diffuse.trace_at_once" : "diffuse.trace_screen"));
        EXPECT_GT(run.at("steady").at("passes").at("gbuffer").at("floor_ms"), 0.0);
        EXPECT_TRUE(run.at("steady").at("passes").at("gbuffer").at("raster"));
        EXPECT_TRUE(std::filesystem::is_regular_file(path(run.at("truth").at("file").get<std::string>())));
    }
    EXPECT_NE(outcome.out.find("builtin:cubes"), std::string::npos) << outcome.out;
}

// Over 5 s: its processes each have their shaders compiled by the driver.
TEST_F(BenchTest, OneSettingAgainstItselfHasARatioForEveryTurnAndEqualErrors) {
    ASSERT_TRUE(quietSuccess(bench({"--compare", "preset:fast,diffuse.rays=2", "fast,diffuse.rays=2"})));
    const nlohmann::json json = numbers();
    EXPECT_EQ(json.at("runs").size(), 2U);
    ASSERT_EQ(json.at("comparisons").size(), 1U);
    const nlohmann::json& pair = json.at("comparisons")[0];
    EXPECT_EQ(pair.at("a"), "preset:fast,diffuse.rays=2");
    EXPECT_EQ(pair.at("b"), "fast,diffuse.rays=2");
    for (const auto& [state, turns] : {std::pair("first", 2U), std::pair("steady", 3U)}) {
        for (const char* total : {"wall", "submitted", "record", "frame"}) {
            const nlohmann::json& ratio = pair.at(state).at(total);
            ASSERT_EQ(ratio.at("ratios").size(), turns) << state << ' ' << total;
            expectSpread(ratio.at("ratio"), turns);
            expectSpread(ratio.at("difference_ms"), turns);
        }
        // Cube maps may differ in the last bit (docs/conventions.md).
        EXPECT_NEAR(pair.at(state).at("error_ratio").at("relative_mse"), 1.0, 1e-4);
        EXPECT_TRUE(pair.at(state).at("passes").contains("diffuse.trace_screen"));
        EXPECT_TRUE(pair.at(state).at("groups").contains("effects"));
    }
}

// Over 5 s: its processes each have their shaders compiled by the driver.
TEST_F(BenchTest, TheCommandThatIsRecordedDoesTheSameAgain) {
    ASSERT_TRUE(quietSuccess(bench({"--compare", "direct", "plain,diffuse.rays=2", "--truth-visible-only"})));
    const auto command = numbers().at("command").get<std::string>();
    EXPECT_TRUE(command.starts_with("reflet bench builtin:cubes")) << command;
    EXPECT_NE(command.find(" --compare direct plain,diffuse.rays=2"), std::string::npos) << command;
    EXPECT_NE(command.find(" --truth-visible-only"), std::string::npos) << command;
}

// Over 5 s: its processes each have their shaders compiled by the driver.
TEST_F(BenchTest, AReferenceIsRenderedOnceForAllThatShareIt) {
    const Arguments both{"--preset", "direct", "--variant", "soft=direct,shadow.radius=2"};
    ASSERT_TRUE(quietSuccess(bench(both)));
    EXPECT_EQ(truths(), 2U);  // one image and its metadata: both variants share the reference
    const nlohmann::json first = numbers();
    ASSERT_TRUE(quietSuccess(bench(both)));
    EXPECT_EQ(truths(), 2U);
    const nlohmann::json second = numbers();
    for (size_t i = 0; i < 2; ++i) {
        const double error = first["runs"][i]["steady"]["error"]["relative_mse"];
        EXPECT_NEAR(second["runs"][i]["steady"]["error"]["relative_mse"], error, 1e-4 * error);
        EXPECT_EQ(second["runs"][i]["truth"], first["runs"][i]["truth"]);
    }
    ASSERT_TRUE(quietSuccess(bench({"--preset", "direct", "--truth-bounces", "2"})));
    EXPECT_EQ(truths(), 4U);
    ASSERT_TRUE(quietSuccess(bench({"--preset", "direct", "--truth-visible-only"})));
    EXPECT_EQ(truths(), 6U);
}

// Over 5 s: its processes each have their shaders compiled by the driver.
TEST_F(BenchTest, WithManyRaysOfItsOwnASettingComesNearTheChain) {
    ASSERT_TRUE(quietSuccess(bench({"--truth", "chain:64", "--variant", "few=diffuse.rays=1,specular.rays=1",
                                    "--variant", "many=diffuse.rays=32,specular.rays=32"})));
    const nlohmann::json runs = numbers().at("runs");
    const auto error = [&](size_t i) { return runs[i]["first"]["error"]["relative_mse"].get<double>(); };
    EXPECT_LT(error(1), 0.2 * error(0));
    EXPECT_EQ(runs[0]["truth"]["samples"], 64);
}

TEST_F(BenchTest, WithoutATruthThereAreNoErrors) {
    ASSERT_TRUE(quietSuccess(bench({"--preset", "direct", "--truth", "none"})));
    EXPECT_TRUE(numbers().at("truth").is_null());
    EXPECT_TRUE(numbers()["runs"][0]["steady"]["error"].is_null());
    EXPECT_FALSE(std::filesystem::exists(path("truths")));
    EXPECT_FALSE(numbers()["runs"][0]["steady"]["passes"]["gbuffer"].contains("floor_ms"));
}

// Over 5 s: its processes each have their shaders compiled by the driver.
TEST_F(BenchTest, AllVariantsMayBeComparedWithOtherSettings) {
    const Arguments both{"--preset", "direct", "--variant", "near=direct,trace_screen.max_steps=8",
                         "--truth",  "chain:2"};
    ASSERT_TRUE(quietSuccess(bench(both)));
    EXPECT_EQ(truths(), 2U * 2U);
    Arguments fixed = both;
    fixed.insert(fixed.end(), {"--truth-of", "plain,trace_screen.max_steps=99"});
    ASSERT_TRUE(quietSuccess(bench(fixed)));
    EXPECT_EQ(truths(), 3U * 2U);
    EXPECT_NE(numbers().at("truth").at("of").get<std::string>().find("max_steps=99"), std::string::npos);
    EXPECT_TRUE(refused(bench({"--truth-of", "plain"}), 2, {"--truth-of", "chain"}));
}

TEST_F(BenchTest, SeveralSizesSayWhatAPixelCosts) {
    ASSERT_TRUE(quietSuccess(bench({"--truth", "none", "--sizes", "32x18,64x36,48x27", "--preset", "direct"})));
    const nlohmann::json json = numbers();
    EXPECT_EQ(json.at("runs").size(), 3U);
    ASSERT_EQ(json.at("scaling").size(), 1U);
    EXPECT_EQ(json["scaling"][0]["sizes"], (nlohmann::json{{32, 18}, {64, 36}, {48, 27}}));
    const auto cost = json["scaling"][0]["ns_per_pixel"].get<std::vector<double>>();
    ASSERT_EQ(cost.size(), 3U);
    const auto [least, most] = std::ranges::minmax(cost);
    EXPECT_GT(least, 0.0);
    EXPECT_NEAR(json["scaling"][0]["spread"], most / least - 1.0, 1e-6 * most / least);
}

// Over 5 s: its processes each have their shaders compiled by the driver.
TEST_F(BenchTest, MovingFramesAreEachComparedWithAReference) {
    ASSERT_TRUE(quietSuccess(bench({"--preset", "direct", "--motion", "3", "--orbit", "10", "--rest", "2"})));
    const nlohmann::json motion = numbers()["runs"][0]["motion"];
    EXPECT_EQ(motion.at("flip").size(), 3U);
    EXPECT_EQ(motion.at("displayed_flip").size(), 3U);
    EXPECT_GT(motion.at("flicker"), 0.0);
    EXPECT_GT(motion.at("truth_flicker"), 0.0);
    EXPECT_EQ(motion.at("rest").size(), 2U);
    EXPECT_EQ(truths(), 2U * 4U);  // at rest, and three moving frames
    EXPECT_TRUE(refused(bench({"--motion", "3", "--truth", "none"}), 2, {"--motion", "--truth"}));
    EXPECT_TRUE(refused(bench({"--rest", "3"}), 2, {"--rest", "--motion"}));
}

double sumOfOctaves(const nlohmann::json& json) {
    double sum = 0.0;
    for (const char* octave :
         {"octave_2_4", "octave_4_8", "octave_8_16", "octave_16_32", "octave_32_64", "octave_64_up"}) {
        EXPECT_GE(json.at(octave), 0.0) << octave;
        sum += json.at(octave).get<double>();
    }
    return sum;
}

// Over 5 s: its processes each have their shaders compiled by the driver.
TEST_F(BenchTest, ErrorsOfAStillViewAreThereByFrameAndOctave) {
    const Outcome outcome = bench({"--preset", "fast", "--convergence", "5,1,2,5", "--plot", "p.svg", "--markdown"});
    ASSERT_TRUE(quietSuccess(outcome));
    const nlohmann::json run = numbers()["runs"][0];
    const nlohmann::json& errors = run.at("convergence");
    ASSERT_EQ(errors.size(), 3U);
    const std::vector<uint32_t> frames{1, 2, 5};
    for (size_t i = 0; i < frames.size(); ++i) {
        EXPECT_EQ(errors[i].at("frame"), frames[i]);
        const double total = errors[i].at("relative_mse");
        EXPECT_NEAR(sumOfOctaves(errors[i]), total, 1e-5 * total);
        EXPECT_GT(errors[i].at("flip"), 0.0);
        EXPECT_GT(errors[i].at("displayed_flip"), 0.0);
        EXPECT_NE(outcome.out.find(fmt::format("| fast | 32x18 | {} |", frames[i])), std::string::npos) << outcome.out;
    }
    // Frame 1 is the first state; frame 5 follows one frame of warm-up and three measured ones. That frames before it
    // are compared changes nothing.
    const auto error = [](const nlohmann::json& of) { return of.at("relative_mse").get<double>(); };
    EXPECT_NEAR(error(errors[0]), error(run["first"]["error"]), 1e-4 * error(errors[0]));
    EXPECT_NEAR(error(errors[2]), error(run["steady"]["error"]), 1e-4 * error(errors[2]));
    EXPECT_NE(read("p.svg").find("class=\"line\""), std::string::npos);
    EXPECT_NE(read("p.svg").find(">frame</text>"), std::string::npos);
    EXPECT_TRUE(refused(bench({"--convergence", "3", "--truth", "none"}), 2, {"--convergence", "--truth"}));
    EXPECT_TRUE(refused(bench({"--octaves", "--truth", "none"}), 2, {"--octaves", "--truth"}));
    EXPECT_TRUE(refused(bench({"--octaves", "--against", REFLET_PROGRAM}), 2, {"--octaves", "--against"}));
    EXPECT_TRUE(refused(bench({"--convergence", "0"}), 2, {"--convergence"}));
}

// Over 5 s: its processes each have their shaders compiled by the driver.
TEST_F(BenchTest, OctavesAreThoseOfFourFramesAtRestAndOfFramesInMotion) {
    const Outcome outcome = bench({"--preset", "direct", "--octaves", "--motion", "2", "--orbit", "10", "--markdown"});
    ASSERT_TRUE(quietSuccess(outcome));
    const nlohmann::json run = numbers()["runs"][0];
    std::vector<uint32_t> frames;
    for (const nlohmann::json& error : run.at("convergence")) {
        frames.push_back(error.at("frame"));
    }
    EXPECT_EQ(frames, (std::vector<uint32_t>{1, 8, 32, 128}));
    const nlohmann::json& motion = run.at("motion");
    ASSERT_EQ(motion.at("relative_mse").size(), 2U);
    const double mean = (motion["relative_mse"][0].get<double>() + motion["relative_mse"][1].get<double>()) / 2.0;
    EXPECT_NEAR(sumOfOctaves(motion.at("octaves")), mean, 1e-5 * mean);
    EXPECT_NE(outcome.out.find("| direct | 32x18 | in motion |"), std::string::npos) << outcome.out;
}

// Over 5 s: its process has its shaders compiled by the driver.
TEST_F(BenchTest, HardMotionIsMeasuredInCasesOfItsOwn) {
    const Arguments motions{"bench", "--motions", "lamp-off", "--truth-spp", "2", "--truth-cache", "truths"};
    const auto with = [&](const Arguments& more) {
        Arguments all = motions;
        all.insert(all.end(), more.begin(), more.end());
        return run(all);
    };
    const Outcome outcome = with({"--preset", "direct", "--size", "32x18", "--warmup", "2", "--json", "out.json",
                                  "--strips", ".", "--markdown"});
    ASSERT_TRUE(quietSuccess(outcome));
    EXPECT_NE(outcome.out.find("| lamp-off |"), std::string::npos) << outcome.out;
    const nlohmann::json json = numbers();
    EXPECT_EQ(json.at("size"), (nlohmann::json{32, 18}));
    ASSERT_EQ(json.at("motions").size(), 1U);
    const nlohmann::json& motion = json["motions"][0];
    EXPECT_EQ(motion.at("case"), "lamp-off");
    EXPECT_EQ(motion.at("variant"), "direct");
    EXPECT_EQ(motion.at("error_in_motion").at("displayed_flip").size(), 12U);
    EXPECT_EQ(motion.at("error_at_rest").at("relative_mse").size(), 12U);
    EXPECT_EQ(motion.at("ghost").at("left").size(), 8U);
    // Direct light has no history.
    EXPECT_EQ(motion.at("lag").at("frames"), 0);
    EXPECT_NEAR(motion.at("error_ratio").get<double>(), 1.0, 1e-3);
    EXPECT_NEAR(motion.at("ghost").at("left")[7].get<double>(), 0.0, 1e-3);
    EXPECT_TRUE(std::filesystem::is_regular_file(path("lamp-off.png")));
    EXPECT_EQ(truths(), 2U);  // after the step; all frames share it
    EXPECT_TRUE(refused(with({"builtin:cubes"}), 2, {"--motions", "builtin:cubes"}));
    EXPECT_TRUE(refused(with({"--motion", "2"}), 2, {"--motions", "--motion"}));
    EXPECT_TRUE(refused(with({"--truth", "none"}), 2, {"--motions", "--truth"}));
    EXPECT_TRUE(refused(run({"bench", "--motions", "jump"}), 2, {"jump", "lamp-off"}));
    EXPECT_TRUE(refused(run({"bench"}), 2, {"SCENE"}));
}

// Over 5 s: its processes each have their shaders compiled by the driver.
TEST_F(BenchTest, AnotherBuildTakesTurnsWithThisOne) {
    ASSERT_TRUE(quietSuccess(
        bench({"--against", REFLET_PROGRAM, "--rounds", "2", "--preset", "direct", "--set", "diffuse.rays=2"})));
    const nlohmann::json json = numbers();
    ASSERT_EQ(json.at("runs").size(), 2U);
    EXPECT_EQ(json["runs"][0]["variant"], "this build, direct");
    EXPECT_NE(json["runs"][1]["settings"].get<std::string>().find("diffuse.rays=2"), std::string::npos);
    ASSERT_EQ(json.at("comparisons").size(), 1U);
    EXPECT_EQ(json["comparisons"][0]["first"]["submitted"]["ratios"].size(), 2U);
    // The ratio of each round is that of its two times, and of two rounds these are the least and the greatest.
    const auto product = [&](size_t run) {
        const nlohmann::json& ms = json["runs"][run]["steady"]["frame_ms"];
        return ms.at("min").get<double>() * ms.at("max").get<double>();
    };
    const auto ratios = json["comparisons"][0]["steady"]["frame"]["ratios"].get<std::vector<double>>();
    ASSERT_EQ(ratios.size(), 2U);
    EXPECT_NEAR(ratios[0] * ratios[1], product(0) / product(1), 1e-6 * ratios[0] * ratios[1]);
    EXPECT_TRUE(json["comparisons"][0]["steady"]["passes"].contains("gbuffer"));
}

// Over 5 s: its processes each have their shaders compiled by the driver.
TEST_F(BenchTest, AnOlderBuildThatDoesNotTellHowItRecordsIsCompared) {
    // Its JSON has not the keys that came later.
    write("old", fmt::format("#!/bin/sh\n'{}' \"$@\" || exit\nwhile [ $# -gt 0 ]; do\n"
                             "  [ \"$1\" = --json ] && sed -i 's/\"record_ms\"/\"a\"/; s/\"recorded\"/\"b\"/' \"$2\"\n"
                             "  shift\ndone\nexit 0\n",
                             REFLET_PROGRAM));
    std::filesystem::permissions(path("old"), std::filesystem::perms::owner_all);
    ASSERT_TRUE(quietSuccess(bench({"--against", "./old", "--rounds", "1", "--preset", "direct"})));
    const nlohmann::json json = numbers();
    EXPECT_TRUE(json["runs"][0]["steady"].contains("record_ms"));
    EXPECT_FALSE(json["runs"][1]["steady"].contains("record_ms"));
    EXPECT_FALSE(json["runs"][1]["steady"].contains("recorded"));
    EXPECT_TRUE(json["comparisons"][0]["steady"].contains("submitted"));
    EXPECT_FALSE(json["comparisons"][0]["steady"].contains("record"));
}

TEST_F(BenchTest, ABuildWithoutABenchIsAskedForItsTimings) {
    write("old", fmt::format("#!/bin/sh\n[ \"$1\" = bench ] && exit 2\nexec '{}' \"$@\"\n", REFLET_PROGRAM));
    std::filesystem::permissions(path("old"), std::filesystem::perms::owner_all);
    ASSERT_TRUE(quietSuccess(bench({"--against", "./old", "--rounds", "1", "--preset", "direct"})));
    EXPECT_EQ(numbers()["comparisons"][0]["steady"]["frame"]["ratios"].size(), 1U);
}

// Over 5 s: its processes each have their shaders compiled by the driver.
TEST_F(BenchTest, PrintsAlignedTablesOrMarkdownAndWritesAPlot) {
    const Outcome markdown = bench({"--preset", "direct", "--markdown", "--plot", "p.svg"});
    ASSERT_TRUE(quietSuccess(markdown));
    EXPECT_NE(markdown.out.find("| scene | variant | size |"), std::string::npos) << markdown.out;
    EXPECT_NE(markdown.out.find("| wall ms | record ms |"), std::string::npos) << markdown.out;
    EXPECT_NE(markdown.out.find("| memory, MB | transient, MB | passes | barriers |"), std::string::npos)
        << markdown.out;
    EXPECT_NE(markdown.out.find("| builtin:cubes | direct | 32x18 |"), std::string::npos) << markdown.out;
    EXPECT_TRUE(read("p.svg").starts_with("<svg "));
    EXPECT_NE(read("p.svg").find("direct"), std::string::npos);
    const Outcome aligned = bench({"--preset", "direct"});
    EXPECT_EQ(aligned.out.find('|'), std::string::npos) << aligned.out;
    EXPECT_NE(aligned.out.find("memory, MB "), std::string::npos) << aligned.out;
}

// Over 5 s: its processes each have their shaders compiled by the driver.
TEST_F(BenchTest, IsSilentUnderValidation) {
    EXPECT_TRUE(quietSuccess(bench({"--preset", "plain", "--validate"})));
}

TEST_F(BenchTest, RefusesWhatItDoesNotKnowAndNamesTheNearest) {
    EXPECT_TRUE(refused(bench({"--preset", "fats"}), 2, {"'fats'", "did you mean 'fast'?"}));
    EXPECT_TRUE(refused(bench({"--compare", "fast", "preset:qualty"}), 2, {"'qualty'", "did you mean 'quality'?"}));
    EXPECT_TRUE(refused(bench({"--compare", "fast", "diffuse.ray=1"}), 2, {"diffuse.rays"}));
    EXPECT_TRUE(refused(bench({"--compare", "diffuse.rays=1,fast", "fast"}), 2, {"a preset must come first"}));
    EXPECT_TRUE(refused(bench({"--truth", "guess"}), 2, {"--truth", "chain:RAYS"}));
    EXPECT_TRUE(refused(bench({"--truth-bounces", "many"}), 2, {"--truth-bounces", "unlimited"}));
    EXPECT_TRUE(refused(bench({"--layer", "depth"}), 2, {"--layer", "indirect_diffuse"}));
    EXPECT_TRUE(refused(bench({"--sizes", "32x18,big"}), 2, {"'big'"}));
    EXPECT_TRUE(refused(bench({"--against", "./no-such-program"}), 2, {"no-such-program", "cannot be run"}));
    EXPECT_TRUE(refused(bench({"--compare", "fast", "fast", "--against", REFLET_PROGRAM}), 2, {"--compare"}));
    EXPECT_FALSE(std::filesystem::exists(path("out.json")));
}

}  // namespace
}  // namespace reflet::bench_test
