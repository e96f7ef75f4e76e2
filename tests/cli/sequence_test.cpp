// Image sequences (`reflet render -o name_####.png`): resuming, and sharing between processes.
#include "base/json_text.h"
#include "cli/program.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <csignal>
#include <filesystem>
#include <map>

namespace reflet::sequence_test {
namespace {

using Names = std::vector<std::string>;
using Bytes = std::map<std::string, std::string>;
namespace fs = std::filesystem;

const Names sixFrames{"a_000.png", "a_001.png", "a_002.png", "a_003.png", "a_004.png", "a_005.png"};
// Settings that keep a history: of light and of shadows.
const Arguments history{"--set", "trace_screen.light=previous", "--set", "shadow.history=8"};

class Sequence : public ProgramTest {
protected:
    /// builtin:cubes, frames of an orbit at 64x36, with preset direct unless `more` has another one.
    static Arguments orbit(const Arguments& more, const std::string& frames = "6") {
        Arguments all{"render", "builtin:cubes", "--size",    "64x36", "--frames", frames,
                      "--path", "orbit",         "--segment", "2",     "--warmup", "3"};
        if (std::ranges::find(more, "--preset") == more.end()) {
            all.insert(all.end(), {"--preset", "direct"});
        }
        all.insert(all.end(), history.begin(), history.end());
        all.insert(all.end(), more.begin(), more.end());
        return all;
    }
    /// The bytes of the pictures in a folder.
    [[nodiscard]] Bytes pictures(const std::string& folder = ".") const {
        Bytes result;
        for (const auto& entry : fs::directory_iterator(path(folder))) {
            const std::string name = entry.path().filename().string();
            if (entry.path().extension() == ".png" && !name.starts_with('.')) {
                result[name] = read(folder + "/" + name);
            }
        }
        return result;
    }
    [[nodiscard]] Bytes orbitIn(const std::string& folder, const Arguments& more = {}) const {
        fs::create_directory(path(folder));
        Arguments own{"-o", folder + "/a_###.png"};
        own.insert(own.end(), more.begin(), more.end());
        EXPECT_TRUE(quietSuccess(run(orbit(own))));
        return pictures(folder);
    }
    static Names namesOf(const Bytes& files) {
        Names names;
        for (const auto& [name, bytes] : files) {
            names.push_back(name);
        }
        return names;
    }
};

TEST_F(Sequence, WritesAFileForEachFrameAndARecordAndNothingElse) {
    ASSERT_TRUE(quietSuccess(render(
        "builtin:cubes", {"--frames", "3", "--first-frame", "8", "-o", "b##.png", "-o", "b_#.exr", "--aov", "depth"})));
    EXPECT_EQ(files(), (Names{"b##.png.sequence.json", "b08.png", "b09.png", "b10.png", "b_#.exr.sequence.json",
                              "b_10.exr", "b_8.exr", "b_9.exr"}));
    EXPECT_EQ(layers("b_10.exr").size(), 2U);
}

TEST_F(Sequence, EveryFrameIsAnother) {
    const Bytes frames = orbitIn("whole");
    EXPECT_EQ(namesOf(frames), sixFrames);
    for (size_t i = 1; i < sixFrames.size(); ++i) {
        EXPECT_NE(frames.at(sixFrames[i]), frames.at(sixFrames[i - 1]));
    }
}

// Over 5 s: its processes each have their shaders compiled by the driver.
TEST_F(Sequence, SharesTogetherGiveTheWholeAndItsRecord) {
    const Bytes whole = orbitIn("whole");
    EXPECT_EQ(namesOf(orbitIn("shares", {"--share", "2/2"})), (Names{"a_002.png", "a_003.png"}));
    EXPECT_EQ(orbitIn("shares", {"--share", "1/2"}), whole);
    EXPECT_EQ(read("shares/a_###.png.sequence.json"), read("whole/a_###.png.sequence.json"));
}

TEST_F(Sequence, SharesOfASceneThatMovesGiveTheWhole) {
    const auto frames = [&](const std::string& name, const Arguments& more) {
        Arguments all{"--frames", "4", "--fps", "5", "--time", "0.5", "--segment", "2", "--warmup", "3", "-o", name};
        all.insert(all.end(), history.begin(), history.end());
        all.insert(all.end(), {"--aov", "motion"});
        all.insert(all.end(), more.begin(), more.end());
        EXPECT_TRUE(quietSuccess(render("builtin:moving", all)));
    };
    frames("a_#.exr", {});
    frames("b_#.exr", {"--share", "2/2"});
    EXPECT_FALSE(fs::exists(path("b_1.exr")));
    EXPECT_EQ(read("b_2.exr"), read("a_2.exr"));
    EXPECT_EQ(read("b_3.exr"), read("a_3.exr"));
    EXPECT_NE(read("a_3.exr"), read("a_2.exr"));
}

// Over 5 s: its processes each have their shaders compiled by the driver.
TEST_F(Sequence, SharesAreExposedAsTheWhole) {
    const auto frames = [&](const std::string& folder, const std::string& segment, const Arguments& more) {
        fs::create_directory(path(folder));
        Arguments all{"--frames", "6", "--path", "orbit", "--segment", segment, "-o", folder + "/a_#.png"};
        all.insert(all.end(), {"--preset", "direct", "--set", "tonemap.auto_exposure=on"});
        all.insert(all.end(), more.begin(), more.end());
        EXPECT_TRUE(quietSuccess(render("builtin:cubes", all)));
        return pictures(folder);
    };
    const Bytes whole = frames("whole", "2", {});
    frames("shares", "2", {"--share", "2/2"});
    EXPECT_EQ(frames("shares", "2", {"--share", "1/2"}), whole);
    EXPECT_NE(frames("alone", "2", {"--set", "tonemap.adaptation=0"}), whole);
    EXPECT_EQ(frames("one", "0", {}), whole) << "the default warm-up is as long as the smoothing";
}

// Over 5 s: its processes each have their shaders compiled by the driver.
TEST_F(Sequence, GoesOnWhereItWasKilledWithTheSameBytes) {
    const Bytes whole = orbitIn("whole", {"--preset", "plain"});  // whose frames take longer than a look at the folder
    fs::create_directory(path("killed"));
    const Arguments all = orbit({"-o", "killed/a_###.png", "--preset", "plain"});
    for (const std::string last : {"a_###.png.sequence.json", "a_000.png", "a_002.png", "a_003.png"}) {
        const Outcome killed = killWhen(all, [&] { return fs::exists(path("killed/" + last)); });
        EXPECT_GT(killed.status, 128) << "it ended too early";
        for (const auto& [name, bytes] : pictures("killed")) {
            EXPECT_EQ(bytes, whole.at(name)) << name;
        }
    }
    EXPECT_LT(pictures("killed").size(), whole.size());
    EXPECT_TRUE(quietSuccess(run(all)));
    EXPECT_EQ(pictures("killed"), whole);
}

TEST_F(Sequence, AnInterruptEndsItWithWholeFramesAndSaysSo) {
    const Arguments all = orbit({"-o", "a_####.png"}, "3000");
    const Outcome stopped = interrupt(all, {SIGINT});
    EXPECT_TRUE(refused(stopped, 1, {"interrupted after", "run the same command again"}));
    for (const std::string& name : files()) {
        EXPECT_FALSE(name.starts_with('.')) << name;
    }
}

// Over 5 s: its processes each have their shaders compiled by the driver.
TEST_F(Sequence, RendersOnlyWhatIsMissingAndLeavesTheRestAlone) {
    const Bytes whole = orbitIn("a");
    fs::remove(path("a/a_002.png"));
    write("a/a_003.png", whole.at("a_002.png"));  // a picture of the user's own
    write("a/a_004.png", "");                     // what a full disk or a lost power leaves
    write("a/a_005.png", whole.at("a_005.png").substr(0, 60));
    Bytes after = orbitIn("a");
    EXPECT_EQ(after.at("a_003.png"), whole.at("a_002.png"));
    for (const char* made : {"a_002.png", "a_004.png", "a_005.png"}) {
        EXPECT_EQ(after.at(made), whole.at(made)) << made;
    }
    EXPECT_EQ(orbitIn("a", {"--overwrite"}), whole);
}

// Over 5 s: its processes each have their shaders compiled by the driver.
TEST_F(Sequence, FramesOfOtherSettingsAreRefusedUnlessTheyMayBeOverwritten) {
    const Bytes whole = orbitIn("a");
    const Arguments other = orbit({"-o", "a/a_###.png", "--set", "diffuse.rays=3"});
    EXPECT_TRUE(refused(run(other), 1, {"a/a_###.png", "settings.diffuse.rays was ", "is \"3\"", "--overwrite"}));
    EXPECT_TRUE(refused(run(orbit({"-o", "a/a_###.png", "--seed", "2"})), 1, {"seed was 0, is 2"}));
    EXPECT_TRUE(refused(run(orbit({"-o", "a/a_###.png", "--fps", "25"})), 1, {"fps was 24.0, is 25.0"}));
    EXPECT_TRUE(refused(run(orbit({"-o", "a/a_###.png"}, "7")), 1, {"path.orbit_frames was 6, is 7"}));
    EXPECT_EQ(pictures("a"), whole);
    Arguments overwriting = other;
    overwriting.emplace_back("--overwrite");
    EXPECT_TRUE(quietSuccess(run(overwriting)));
    EXPECT_NE(pictures("a").at("a_000.png"), whole.at("a_000.png"));
    EXPECT_TRUE(quietSuccess(run(other)));
    fs::remove(path("a/a_###.png.sequence.json"));
    EXPECT_TRUE(refused(run(other), 1, {"a_###.png.sequence.json", "--overwrite"}));
}

// Over 5 s: its processes each have their shaders compiled by the driver.
TEST_F(Sequence, WithoutAnOrbitMoreFramesMayBeAddedLater) {
    write("path.json", R"({"keyframes": [{"time": 0, "position": [6, 2, 0], "target": [0, 0, 0]},
                                         {"time": 0.2, "position": [4, 3, 4], "target": [0, 0, 0]}]})");
    const auto frames = [&](const std::string& count, const std::string& name) {
        Arguments all{"--frames", count, "--path", "path.json", "-o", name, "--segment", "2", "--warmup", "2"};
        all.insert(all.end(), history.begin(), history.end());
        EXPECT_TRUE(quietSuccess(render("builtin:cubes", all)));
    };
    frames("3", "a_#.png");
    frames("5", "a_#.png");
    frames("5", "b_#.png");
    for (const std::string number : {"0", "1", "2", "3", "4"}) {
        EXPECT_EQ(read("a_" + number + ".png"), read("b_" + number + ".png")) << number;
    }
    write("path.json", R"({"keyframes": [{"time": 0, "position": [6, 2, 1], "target": [0, 0, 0]}]})");
    EXPECT_TRUE(refused(render("builtin:cubes", {"--frames", "5", "--path", "path.json", "-o", "a_#.png"}), 1,
                        {"path.keyframes"}));
}

// Over 5 s: its processes each have their shaders compiled by the driver.
TEST_F(Sequence, WithoutHistoryEveryFrameIsTheSameWhicheverAreThere) {
    write("path.json", R"({"keyframes": [{"time": 0, "position": [6, 2, 0], "target": [0, 0, 0]},
                                         {"time": 1, "position": [5, 3, 2], "target": [0, 0, 0]}]})");
    const Arguments none{"--set", "shadow.history=0", "--frames", "4", "--path", "path.json", "--aov", "depth"};
    const auto frames = [&](const std::string& name, const Arguments& more) {
        Arguments all = none;
        all.insert(all.end(), {"-o", name});
        all.insert(all.end(), more.begin(), more.end());
        EXPECT_TRUE(quietSuccess(render("builtin:cubes", all)));
    };
    frames("a_#.exr", {});
    frames("b_#.exr", {"--share", "2/4"});
    EXPECT_FALSE(fs::exists(path("b_0.exr")));
    EXPECT_EQ(read("b_1.exr"), read("a_1.exr"));
    frames("m_#.exr", {"--aov", "motion"});
    frames("n_#.exr", {"--aov", "motion", "--segment", "2", "--share", "2/2"});
    EXPECT_FALSE(fs::exists(path("n_1.exr")));
    EXPECT_EQ(read("n_2.exr"), read("m_2.exr"));
    for (const ImageLayer& layer : layers("n_2.exr")) {
        if (layer.name == "motion") {
            EXPECT_NE(mean(layer.image), 0.0F) << "the previous frame is not used";
        }
    }
}

TEST_F(Sequence, TimesAreOfTheFramesThatWereWritten) {
    ASSERT_TRUE(quietSuccess(run(orbit({"-o", "a_###.png", "--timings", "t.json"}))));
    const auto times = parseJson(read("t.json"));
    EXPECT_EQ(times.at("frames"), 6);
    EXPECT_GT(times.at("frame_ms"), 0.0);
    EXPECT_TRUE(refused(run(orbit({"-o", "a_###.png", "--timings", "t.json"})), 0, {"warning", "none was rendered"}));
}

TEST_F(Sequence, UsageErrorsSayWhatIsWrong) {
    const auto refuses = [&](const Arguments& more, std::initializer_list<std::string_view> words) {
        EXPECT_TRUE(refused(render("builtin:cubes", more), 2, words));
    };
    refuses({"-o", "a.png", "--path", "orbit"}, {"--path", "#"});
    refuses({"-o", "a.png", "--frames", "4", "--share", "1/2"}, {"--share", "#"});
    refuses({"-o", "a_#.png", "-o", "b.png"}, {"b.png", "every name"});
    refuses({"-o", "a_#_#.png"}, {"a_#_#.png", "two runs"});
    refuses({"-o", "a_#.png", "--share", "3/2"}, {"K/N", "3/2"});
    refuses({"-o", "a_#.png", "--share", "0/2"}, {"K/N"});
    refuses({"-o", "a_#.png", "--share", "half"}, {"K/N"});
    refuses({"-o", "a_#.png", "--fps", "0"}, {"--fps"});
    refuses({"-o", "a_#.png", "--share", "1/2", "--overwrite"}, {"--overwrite", "shares"});
    refuses({"-o", "a_#.png", "--time", "999999.9", "--frames", "9999"}, {"seconds"});
    EXPECT_TRUE(refused(render("builtin:cubes", {"-o", "a_#.png", "--path", "none.json"}), 1, {"none.json"}));
    write("path.json", R"({"keyframes": [{"time": 0, "position": [6, 2, 1], "target": [0, 0, 0], "ease": "smooth"}]})");
    EXPECT_TRUE(refused(render("builtin:cubes", {"-o", "a_#.png", "--path", "path.json"}), 1,
                        {"path.json", "keyframes[0].ease", "easing"}));
    EXPECT_EQ(files(), Names{"path.json"});
}

}  // namespace
}  // namespace reflet::sequence_test
