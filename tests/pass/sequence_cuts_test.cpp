// Cuts in sequences: the frame after one has the history of its own shot only.
#include "base/file.h"
#include "job/sequence_plan.h"
#include "job/sequence_views.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <string>

namespace reflet::sequence_cuts_test {
namespace {

std::vector<uint32_t> cutsOf(const std::string& keyframes, uint32_t frames) {
    const std::filesystem::path file = std::filesystem::path(testing::TempDir()) / "cuts.json";
    writeFileAtomically(file, R"({"keyframes": [)" + keyframes + "]}");
    const Scene scene;
    SequenceOptions options;
    options.fps = 10.0;
    options.path = file.string();
    const std::vector<uint32_t> cuts = SequenceViews(View{}, scene, options, frames).cuts(scene);
    std::filesystem::remove(file);
    return cuts;
}

using Frames = std::vector<uint32_t>;

TEST(SequenceCuts, AreWhereTheCameraJumps) {
    EXPECT_EQ(cutsOf(R"({"time": 0, "position": [0,0,5], "target": [0,0,0], "easing": "step"},
                        {"time": 0.5, "position": [5,0,0], "target": [0,0,0], "easing": "step"},
                        {"time": 0.8, "position": [0,0,5], "target": [0,0,0]})",
                     12),
              (Frames{5, 8}));
    EXPECT_EQ(cutsOf(R"({"time": 0, "position": [0,0,5], "target": [0,0,0]},
                        {"time": 0.45, "position": [0.5,0,5], "target": [0,0,0]},
                        {"time": 0.46, "position": [0,3,-5], "target": [0,0,0]},
                        {"time": 1, "position": [0,4,-5], "target": [0,0,0]})",
                     10),
              (Frames{5}));
}

TEST(SequenceCuts, AreNotWhereItIsFast) {
    EXPECT_EQ(cutsOf(R"({"time": 0, "position": [0,0,5], "target": [0,0,0]},
                        {"time": 0.5, "position": [0,0,5], "target": [0,0,0]},
                        {"time": 1, "position": [0,0,5], "target": [8,0,5]})",
                     12),
              Frames{})
        << "a whip pan from rest";
    EXPECT_EQ(cutsOf(R"({"time": 0, "position": [0,0,5], "target": [0,0,0], "easing": "step"},
                        {"time": 0.5, "position": [0.1,0,5], "target": [0,0,0]})",
                     8),
              Frames{})
        << "a small step";
}

TEST(SequenceCuts, PartRunsAndEndWarmUps) {
    EXPECT_EQ((SequencePlan{.frames = 2, .segment = 4294967295}.segments()), 1U);
    const SequencePlan plan{.frames = 20, .segment = 10, .warmUp = 4, .cuts = {3, 10, 13}};
    const std::vector<SequencePlan::Run> runs = plan.runs(Share{}, [](uint32_t) { return true; });
    Frames begins;
    for (const SequencePlan::Run& run : runs) {
        begins.push_back(run.begin);
    }
    EXPECT_EQ(begins, (Frames{0, 3, 10, 13}));
    EXPECT_EQ(runs.back().end, 20U);
    EXPECT_EQ(plan.work(runs), 20U + 4U * 4U);
    EXPECT_EQ(plan.shotOf(2), 0U);
    EXPECT_EQ(plan.shotOf(12), 10U);
    EXPECT_EQ(plan.shotOf(19), 13U);
}

}  // namespace
}  // namespace reflet::sequence_cuts_test
