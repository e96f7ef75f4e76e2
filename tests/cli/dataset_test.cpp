// `reflet dataset`: shares, resuming, layouts and what is refused.
#include "base/json_text.h"
#include "cli/program.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>

namespace reflet::dataset_test {
namespace {

namespace fs = std::filesystem;
using Bytes = std::map<std::string, std::string>;

class DatasetCommand : public ProgramTest {
protected:
    /// Six frames of two scenes, of 32x18 pixels: bursts of two, so that there is a frame before.
    [[nodiscard]] static Arguments small(const std::string& folder, const Arguments& more = {}) {
        Arguments all{"dataset",
                      "builtin:cubes",
                      "builtin:moving",
                      "-o",
                      folder,
                      "--frames",
                      "6",
                      "--burst",
                      "2",
                      "--spp",
                      "4",
                      "--noisy",
                      "1,2",
                      "--size",
                      "32x18",
                      "--seed"};
        all.emplace_back("3");
        all.insert(all.end(), more.begin(), more.end());
        return all;
    }
    [[nodiscard]] Bytes bytesIn(const std::string& folder) const {
        Bytes all;
        for (const auto& entry : fs::recursive_directory_iterator(path(folder))) {
            if (entry.is_regular_file()) {
                const std::string name = fs::relative(entry.path(), path(folder)).string();
                all[name] = read(folder + "/" + name);
            }
        }
        return all;
    }
    [[nodiscard]] nlohmann::json record(const std::string& file) const { return parseJson(read(file)); }
    [[nodiscard]] FloatImage layer(const std::string& file, const std::string& name) const {
        for (const ImageLayer& l : layers(file)) {
            if (l.name == name) {
                return l.image;
            }
        }
        ADD_FAILURE() << file << " has no layer " << name;
        return {};
    }
};

TEST_F(DatasetCommand, SharesAndResumedRunsGiveTheSameBytes) {
    ASSERT_TRUE(quietSuccess(run(small("whole"))));
    const Bytes whole = bytesIn("whole");
    EXPECT_EQ(whole.size(), 2U + 2 * 6) << "manifest, index, an image and a record for each frame";

    ASSERT_TRUE(quietSuccess(run(small("shared", {"--share", "2/2", "--threads", "1"}))));
    EXPECT_FALSE(fs::exists(path("shared/frames.jsonl"))) << "the other share is not there yet";
    ASSERT_TRUE(quietSuccess(run(small("shared", {"--share", "1/2"}))));
    EXPECT_EQ(bytesIn("shared"), whole);

    const auto killed = [&] { return fs::exists(path("killed/moving/moving_000002.json")); };
    (void)killWhen(small("killed"), killed);
    write("killed/cubes/cubes_000000.exr", "cut");  // as a machine that lost power leaves it
    fs::remove(path("killed/moving/moving_000002.exr"));
    ASSERT_TRUE(quietSuccess(run(small("killed"))));
    EXPECT_EQ(bytesIn("killed"), whole);

    const Outcome empty = run(small("whole", {"--share", "4/4"}));
    EXPECT_EQ(empty.status, 0);
    EXPECT_NE(empty.err.find("--share 4/4: nothing to do"), std::string::npos) << empty.err;
}

TEST_F(DatasetCommand, LayersAddUpAndMotionLeadsToTheFrameBefore) {
    ASSERT_TRUE(quietSuccess(run(small("d", {"--float"}))));
    for (const std::string of : {"", "spp1.", "spp2."}) {
        const FloatImage sum = layer("d/cubes/cubes_000001.exr", of + "final");
        FloatImage parts = layer("d/cubes/cubes_000001.exr", of + "direct");
        for (const std::string name : {"indirect_diffuse", "indirect_specular"}) {
            const FloatImage part = layer("d/cubes/cubes_000001.exr", of + name);
            std::ranges::transform(parts.data, part.data, parts.data.begin(), std::plus<>());
        }
        for (size_t i = 0; i < sum.data.size(); ++i) {
            ASSERT_NEAR(sum.data[i], parts.data[i], 1e-5F * (1.0F + sum.data[i])) << of << i;
        }
    }
    // Where a pixel's surface was, the frame before has that depth, except at edges.
    const nlohmann::json now = record("d/cubes/cubes_000001.json");
    EXPECT_EQ(now.at("previous"), "cubes/cubes_000000");
    const FloatImage motion = layer("d/cubes/cubes_000001.exr", "motion");
    const FloatImage expected = layer("d/cubes/cubes_000001.exr", "previous_depth");
    const FloatImage before = layer("d/cubes/cubes_000000.exr", "depth");
    size_t seen = 0;
    size_t off = 0;
    for (uint32_t i = 0; i < 32 * 18; ++i) {
        const float u = (float(i % 32) + 0.5F) / 32.0F - motion.data[2 * i];
        const float v = (float(i / 32) + 0.5F) / 18.0F - motion.data[2 * i + 1];
        if (expected.data[i] > 0.0F && u > 0.0F && u < 1.0F && v > 0.0F && v < 1.0F) {
            const auto at = static_cast<size_t>(v * 18.0F) * 32 + static_cast<size_t>(u * 32.0F);
            ++seen;
            off += std::abs(before.data[at] - expected.data[i]) > 0.1F * expected.data[i] ? 1 : 0;
        }
    }
    EXPECT_GT(seen, 150U);
    EXPECT_LT(off, seen / 10);
}

TEST_F(DatasetCommand, CamerasBehindUnlitWallsAreDrawnAgain) {
    // The first camera that is drawn for the third frame is behind the box, under a black sky.
    ASSERT_TRUE(quietSuccess(run({"dataset", "builtin:cornell", "-o", "d", "--frames", "3", "--spp", "4", "--noisy",
                                  "1", "--size", "32x18", "--seed", "5", "--share", "3/3"})));
    EXPECT_GT(std::ranges::max(layer("d/cornell/cornell_000002.exr", "final").data), 0.0F);
}

TEST_F(DatasetCommand, TheOtherLayoutIsThatOfTheTrainingTools) {
    ASSERT_TRUE(quietSuccess(run({"dataset", "builtin:cubes", "-o", "d", "--frames", "1", "--spp", "4", "--noisy", "1",
                                  "--size", "32x18", "--layout", "oidn", "--ldr", "--cameras", "orbit"})));
    for (const std::string version : {"0001spp", "ref"}) {
        for (const std::string feature : {"hdr", "alb", "nrm", "ldr"}) {
            const auto found = layers("d/cubes/cubes_000000_" + version + "." + feature + ".exr");
            ASSERT_EQ(found.size(), 1U);
            EXPECT_EQ(found[0].image.channels, (std::vector<std::string>{"R", "G", "B"}));
        }
    }
    EXPECT_EQ(record("d/cubes/cubes_000000.json").at("files").size(), 8U);
}

TEST_F(DatasetCommand, RefusesOtherOptionsInAFolderAndWhatExcludesEachOther) {
    const Arguments one{"dataset", "builtin:cubes", "-o", "d", "--frames", "1", "--spp", "1", "--size", "32x18"};
    const auto with = [&](const Arguments& more) {
        Arguments all = one;
        all.insert(all.end(), more.begin(), more.end());
        return run(all);
    };
    EXPECT_TRUE(refused(with({"--share", "3/2"}), 2, {"--share"}));
    EXPECT_FALSE(fs::exists(path("d"))) << "nothing is begun";
    ASSERT_TRUE(quietSuccess(run(one)));
    EXPECT_TRUE(refused(with({"--seed", "5"}), 1, {"manifest.json", "seed was 0, is 5", "empty the folder"}));
    EXPECT_TRUE(refused(with({"--fov", "nrmal"}), 2, {"--fov", "did you mean 'normal'"}));
    EXPECT_TRUE(refused(with({"--fov", "60..40"}), 2, {"must ascend"}));
    EXPECT_TRUE(refused(with({"--noisy", "plain", "--layout", "oidn"}), 2, {"takes numbers only"}));
    EXPECT_TRUE(refused(with({"--noisy", "plian"}), 2, {"plain"}));
    EXPECT_TRUE(refused(with({"--cameras", "path"}), 2, {"--path"}));
    EXPECT_TRUE(refused(with({"--burst", "2"}), 2, {"multiple of --burst"}));
}

}  // namespace
}  // namespace reflet::dataset_test
