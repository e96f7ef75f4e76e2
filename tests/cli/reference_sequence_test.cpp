// Sequences of `reflet reference`: the same frames as those of `reflet render`, shared between processes, with the
// share taken from a scheduler's environment.
#include "cli/reference_program.h"

#include <algorithm>
#include <cmath>
#include <csignal>
#include <filesystem>

namespace reflet::reference_sequence_test {
namespace {

namespace fs = std::filesystem;

class ReferenceSequence : public Reference {
protected:
    static Arguments orbit(const std::string& output, const Arguments& more = {}) {
        Arguments all{"--frames", "4", "--path", "orbit", "-o", output};
        all.insert(all.end(), more.begin(), more.end());
        if (std::ranges::find(more, "--spp") == more.end()) {
            all.insert(all.end(), {"--spp", "2"});
        }
        return arguments(cubes, all);
    }
    void orbitIn(const std::string& folder, const Arguments& more = {}, const Variables& environment = {}) const {
        fs::create_directory(path(folder));
        EXPECT_TRUE(quietSuccess(run(orbit(folder + "/a_##.exr", more), environment)));
    }
    [[nodiscard]] std::vector<std::string> numbers(const std::string& folder) const {
        std::vector<std::string> found;
        for (const auto& entry : fs::directory_iterator(path(folder))) {
            if (entry.path().extension() == ".exr") {
                found.push_back(entry.path().stem().string().substr(2));
            }
        }
        std::ranges::sort(found);
        return found;
    }
    void expectEqualFrames(const std::string& folder, const std::string& other) const {
        EXPECT_EQ(numbers(folder).size(), 4U);
        for (const std::string& number : numbers(folder)) {
            EXPECT_EQ(read(folder + "/a_" + number + ".exr"), read(other + "/a_" + number + ".exr")) << number;
        }
    }
};

using Numbers = std::vector<std::string>;

TEST_F(ReferenceSequence, ItsFramesAreTheRenderersWithAllLayers) {
    for (const std::string scene : {"builtin:cubes", "builtin:moving"}) {
        const Arguments same{"--frames", "3", "--path", "orbit", "--first-frame", "7", "--fps", "5", "--time", "0.2"};
        Arguments clean{"--spp", "1", "--filter", "center", "-o", "clean_##.exr", "--overwrite"};
        clean.insert(clean.end(), same.begin(), same.end());
        Arguments noisy{"--preset", "direct", "--aov", "depth", "-o", "noisy_##.exr", "--overwrite"};
        noisy.insert(noisy.end(), same.begin(), same.end());
        ASSERT_TRUE(quietSuccess(run(arguments(scene, clean))));
        ASSERT_TRUE(quietSuccess(render(scene, noisy)));
        EXPECT_EQ(layers("clean_09.exr").size(), 9U);
        for (const std::string number : {"07", "08", "09"}) {
            const FloatImage depth = images("clean_" + number + ".exr").at("depth");
            const FloatImage rendered = images("noisy_" + number + ".exr").at("depth");
            size_t different = 0;  // at edges
            for (size_t i = 0; i < depth.data.size(); ++i) {
                different += std::abs(depth.data[i] - rendered.data[i]) > 1e-3F * (1.0F + depth.data[i]) ? 1 : 0;
            }
            EXPECT_LE(different, 2U) << scene << number;
        }
        EXPECT_NE(images("clean_07.exr").at("depth").data, images("clean_08.exr").at("depth").data);
    }
}

TEST_F(ReferenceSequence, EveryFrameHasItsOwnNoiseAndTheFirstThatOfASingleImage) {
    ASSERT_TRUE(quietSuccess(reference(cubes, {"--spp", "2", "--frames", "2", "-o", "a_#.exr"})));
    ASSERT_TRUE(quietSuccess(reference(cubes, {"--spp", "2", "-o", "single.exr"})));
    EXPECT_EQ(read("a_0.exr"), read("single.exr"));
    EXPECT_NE(images("a_0.exr").at("indirect_diffuse").data, images("a_1.exr").at("indirect_diffuse").data);
}

TEST_F(ReferenceSequence, SharesAndResumedRunsGiveTheSameBytes) {
    orbitIn("whole");
    orbitIn("shares", {"--share", "2/3"});
    EXPECT_EQ(numbers("shares"), (Numbers{"01"}));
    orbitIn("shares", {"--share", "1/3"});
    EXPECT_EQ(numbers("shares"), (Numbers{"00", "01", "03"}));
    orbitIn("shares");
    expectEqualFrames("shares", "whole");
    EXPECT_EQ(read("shares/a_##.exr.sequence.json"), read("whole/a_##.exr.sequence.json"));
    write("shares/a_02.exr", read("whole/a_03.exr"));  // a picture of the user's own
    write("shares/a_03.exr", "not whole");
    orbitIn("shares");
    EXPECT_EQ(read("shares/a_02.exr"), read("whole/a_03.exr"));
    EXPECT_EQ(read("shares/a_03.exr"), read("whole/a_03.exr"));
    orbitIn("shares", {"--overwrite"});
    expectEqualFrames("shares", "whole");
}

TEST_F(ReferenceSequence, FramesOfOtherOptionsAreRefused) {
    orbitIn("a");
    const auto refuses = [&](const Arguments& more, std::string_view words) {
        EXPECT_TRUE(refused(run(orbit("a/a_##.exr", more)), 1, {words, "--overwrite"}));
    };
    refuses({"--spp", "3"}, "reference.samples was 2, is 3");
    refuses({"--bounces", "1"}, "reference.bounces");
    refuses({"--noise", "0.5"}, "reference.noise");
    refuses({"--filter", "center"}, "reference.filter");
    refuses({"--sampling", "uniform"}, "reference.sampling");
    refuses({"--visible-only"}, "reference.visible_only");
    refuses({"--pinhole"}, "reference.pinhole");
    refuses({"--layers", "final,ambient_occlusion"}, "reference.layers");
    refuses({"--set", "materials.lambert_only=on"}, "reference.lambert_only");
    refuses({"--seed", "1"}, "seed was 0, is 1");
    refuses({"--background", "white"}, "view.background");
    orbitIn("a", {"--set", "tonemap.exposure=1"});  // of PNG alone
    EXPECT_TRUE(quietSuccess(run(orbit("a/a_##.png"))));
    EXPECT_TRUE(refused(run(orbit("a/a_##.png", {"--set", "tonemap.exposure=1"})), 1, {"settings.tonemap.exposure"}));
}

TEST_F(ReferenceSequence, AnInterruptKeepsWholeFramesAlone) {
    Arguments all = arguments(cubes, {"--spp", "4", "--frames", "30000", "-o", "a_#.exr"});
    EXPECT_TRUE(refused(interrupt(all, {SIGINT}, 1.2), 1, {"interrupted after", "run the same command again"}));
    ASSERT_TRUE(quietSuccess(reference(cubes, {"--spp", "4", "--frames", "1", "-o", "whole_#.exr"})));
    EXPECT_EQ(read("a_0.exr"), read("whole_0.exr"));
    for (const std::string& name : files()) {
        EXPECT_FALSE(name.starts_with('.')) << name;
    }
}

// The share that a scheduler's environment says, as the frames' numbers.
TEST_F(ReferenceSequence, TheShareIsThatOfTheJobArray) {
    const auto expectShare = [&](const std::string& share, const Variables& environment, const Numbers& expected) {
        orbitIn("a", {"--share", share}, environment);
        EXPECT_EQ(numbers("a"), expected) << share;
        fs::remove_all(path("a"));
    };
    const auto slurm = [](const std::string& id, const std::string& min, const std::string& max,
                          const std::string& count, const std::string& step) {
        return Variables{{"SLURM_ARRAY_TASK_ID", id},
                         {"SLURM_ARRAY_TASK_MIN", min},
                         {"SLURM_ARRAY_TASK_MAX", max},
                         {"SLURM_ARRAY_TASK_COUNT", count},
                         {"SLURM_ARRAY_TASK_STEP", step}};
    };
    expectShare("auto", slurm("1", "0", "2", "3", "1"), {"01"});
    expectShare("auto", slurm("1", "1", "3", "3", "1"), {"00", "03"});
    expectShare("auto", slurm("8", "4", "8", "3", "2"), {"02"});
    expectShare("auto/3", slurm("1", "0", "2", "3", "1"), {"01"});
    expectShare("auto", slurm("0", "0", "0", "1", "1"), {"00", "01", "02", "03"});
    expectShare("auto", {{"SLURM_STEP_NUM_TASKS", "2"}, {"SLURM_PROCID", "1"}}, {"01", "03"});
    Variables both = slurm("1", "0", "1", "2", "1");
    both.insert({{"SLURM_STEP_NUM_TASKS", "2"}, {"SLURM_PROCID", "0"}});
    expectShare("auto", both, {"02"});
    expectShare("auto/4", {{"PBS_ARRAY_INDEX", "4"}}, {"03"});
    expectShare("auto/4", {{"PBS_ARRAYID", "2"}}, {"01"});
    expectShare("auto/2", {{"PARALLEL_SEQ", "2"}}, {"01", "03"});
}

TEST_F(ReferenceSequence, AnEnvironmentWithoutAShareIsAUsageError) {
    const auto refuses = [&](const std::string& share, const Variables& environment,
                             std::initializer_list<std::string_view> words) {
        EXPECT_TRUE(refused(run(orbit("a_#.exr", {"--share", share}), environment), 2, words));
    };
    refuses("auto", {}, {"no job array", "K/N"});
    refuses("auto/4", {}, {"no job array"});
    refuses("auto/0", {}, {"K/N", "auto/0"});
    refuses("auto/x", {}, {"K/N"});
    refuses("auto", {{"SLURM_STEP_NUM_TASKS", "1"}, {"SLURM_PROCID", "0"}}, {"no job array"});
    refuses("auto", {{"PBS_ARRAY_INDEX", "1"}}, {"PBS", "auto/16"});
    refuses("auto/4", {{"PBS_ARRAY_INDEX", "0"}}, {"PBS_ARRAY_INDEX", "from 1"});
    refuses("auto/4", {{"PBS_ARRAY_INDEX", "5"}}, {"task 5", "4"});
    refuses("auto/4", {{"PARALLEL_SEQ", "one"}}, {"PARALLEL_SEQ", "'one'"});
    refuses("auto", {{"SLURM_ARRAY_TASK_ID", "1"}}, {"SLURM_ARRAY_TASK_MIN"});
    Variables gaps{{"SLURM_ARRAY_TASK_ID", "7"},
                   {"SLURM_ARRAY_TASK_MIN", "0"},
                   {"SLURM_ARRAY_TASK_MAX", "7"},
                   {"SLURM_ARRAY_TASK_COUNT", "3"}};
    refuses("auto", gaps, {"--array=0-2", "K/N"});
    gaps["SLURM_ARRAY_TASK_MAX"] = "2";
    refuses("auto", gaps, {"task 7"});
    gaps["SLURM_ARRAY_TASK_ID"] = "2";
    refuses("auto/4", gaps, {"3 tasks"});
    gaps["PARALLEL_SEQ"] = "1";
    refuses("auto", gaps, {"Slurm", "GNU parallel"});
    EXPECT_TRUE(refused(run(arguments(cubes, {"-o", "a.exr", "--frames", "3"})), 2, {"--frames", "#"}));
    EXPECT_TRUE(refused(run(arguments(cubes, {"-o", "a.exr", "--share", "auto"})), 2, {"--share", "#"}));
    EXPECT_TRUE(files().empty());
}

// Neither waits for the other, and what both write is whole.
TEST_F(ReferenceSequence, AShareWithoutFramesSaysSo) {
    const Outcome outcome = run(orbit("a_##.exr", {"--share", "5/6"}));
    EXPECT_EQ(outcome.status, 0);
    EXPECT_NE(outcome.err.find("--share 5/6: nothing to do, because 4 frames are 4 segments of 1"), std::string::npos)
        << outcome.err;
}

TEST_F(ReferenceSequence, TwoProcessesMayHaveTheSameShare) {
    const auto same = [](const std::string& output) {
        return arguments(cubes, {"--spp", "8", "--frames", "40", "-o", output});
    };
    const int first = begin(same("a_##.exr"));
    const int second = begin(same("a_##.exr"));
    EXPECT_TRUE(quietSuccess(finish(first)));
    EXPECT_TRUE(quietSuccess(finish(second)));
    ASSERT_TRUE(quietSuccess(run(same("b_##.exr"))));
    EXPECT_EQ(files().size(), 82U) << "a file of an interrupted write is left";
    for (const std::string& name : files()) {
        if (name.starts_with("a_")) {
            EXPECT_EQ(read(name), read("b_" + name.substr(2))) << name;
        }
    }
}

}  // namespace
}  // namespace reflet::reference_sequence_test
