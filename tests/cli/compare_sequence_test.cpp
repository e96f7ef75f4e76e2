// `reflet compare` with sequences, on generated images.
#include "cli/program.h"

#include "base/image_file.h"
#include "base/json_text.h"

#include <nlohmann/json.hpp>

#include <regex>
#include <sstream>

namespace reflet::compare_sequence_test {
namespace {

constexpr uint32_t width = 8;
constexpr uint32_t height = 4;

FloatImage rgb(float value) {
    return {width, height, {"R", "G", "B"}, std::vector<float>(size_t{width} * height * 3, value)};
}

class CompareSequence : public ProgramTest {
protected:
    void writeFrame(const std::string& file, float value) const {
        writeExr(path(file), std::vector<ImageLayer>{{"", rgb(value)}});
    }
    /// Frames 8 to 11 of b are 1; those of a are 1.25, 1.5, 0.25, 1: differences 0.25, 0.5, -0.75, 0.
    void writeSequences() const {
        const std::vector<float> values{1.25F, 1.5F, 0.25F, 1.0F};
        for (size_t i = 0; i < values.size(); ++i) {
            writeFrame("a_" + std::to_string(8 + i) + ".exr", values[i]);
            writeFrame(i < 2 ? "b_000" + std::to_string(8 + i) + ".exr" : "b_00" + std::to_string(8 + i) + ".exr",
                       1.0F);
        }
    }
    [[nodiscard]] Outcome compare(const Arguments& arguments) const {
        Arguments all{"compare"};
        all.insert(all.end(), arguments.begin(), arguments.end());
        return run(all);
    }
    [[nodiscard]] nlohmann::json json(Arguments arguments) const {
        arguments.emplace_back("--json");
        const Outcome done = compare(arguments);
        EXPECT_TRUE(quietSuccess(done));
        return parseJsonIfValid(done.out);
    }
};

TEST_F(CompareSequence, ATableHasAllFramesTheMeansAndTheWorst) {
    writeSequences();
    const Outcome done = compare({"a_#.exr", "b_####.exr"});
    ASSERT_TRUE(quietSuccess(done));
    EXPECT_EQ(firstWords(done.out), (std::vector<std::string>{"frame", "8", "9", "10", "11", "mean", "worst", "in",  //
                                                              "frame", "8", "9", "10", "11", "mean", "worst", "in"}));
    std::istringstream lines(done.out);
    std::string line;
    std::getline(lines, line);
    const size_t width0 = line.size();
    EXPECT_NE(line.find("relative_mse"), std::string::npos) << line;
    while (std::getline(lines, line)) {
        EXPECT_TRUE(line.size() == width0 || line.empty()) << line;
    }
    EXPECT_NE(done.out.find("octave_64_up\n"), std::string::npos) << done.out;
}

TEST_F(CompareSequence, JsonHasWhatEachFrameHasAlone) {
    writeSequences();
    const nlohmann::json all = json({"a_#.exr:final", "b_####.exr"});
    ASSERT_EQ(all["frames"].size(), 4U);
    const nlohmann::json alone = json({"a_9.exr", "b_0009.exr"});
    for (const char* metric :
         {"relative_mse", "psnr", "flip", "mean", "bias", "max", "octave_2_4", "octave_64_up", "pixels"}) {
        EXPECT_EQ(all["frames"][1][metric], alone[metric]) << metric;
    }
    EXPECT_EQ(all["frames"][1]["frame"], 9);
    EXPECT_EQ(all["size"], alone["size"]);
    EXPECT_TRUE(all["frames"][3]["psnr"].is_null()) << "equal images: infinity";
    EXPECT_NEAR(double(all["mean"]["mean"]), (0.25 + 0.5 + 0.75) / 4.0, 1e-6);
    EXPECT_NEAR(double(all["mean"]["bias"]), (0.25 + 0.5 - 0.75) / 4.0, 1e-6);
    EXPECT_NEAR(double(all["mean"]["octave_64_up"]), double(all["mean"]["relative_mse"]), 1e-6);
    EXPECT_EQ(all["worst"]["octave_64_up"]["frame"], 10);
    EXPECT_EQ(all["worst"]["mean"]["frame"], 10);
    EXPECT_EQ(all["worst"]["psnr"]["frame"], 10);
    EXPECT_EQ(all["worst"]["bias"]["frame"], 10) << "the largest absolute value";
    EXPECT_NEAR(double(all["worst"]["bias"]["value"]), -0.75, 1e-6);
}

TEST_F(CompareSequence, OneReferenceServesAllFrames) {
    writeSequences();
    const nlohmann::json all = json({"a_#.exr", "b_0008.exr"});
    EXPECT_EQ(all["frames"].size(), 4U);
    EXPECT_EQ(all["worst"]["mean"]["frame"], 10);
}

TEST_F(CompareSequence, AMissingFrameIsAnErrorAndAFrameWithoutReferenceAWarning) {
    writeSequences();
    std::filesystem::remove(path("a_9.exr"));
    EXPECT_TRUE(refused(compare({"a_#.exr", "b_####.exr"}), 1, {"a_#.exr lacks frames that b_####.exr has: 9"}));
    std::filesystem::remove(path("b_0009.exr"));
    EXPECT_EQ(json({"a_#.exr", "b_####.exr"})["frames"].size(), 3U);
    std::filesystem::remove(path("b_0010.exr"));
    const Outcome fewer = compare({"a_#.exr", "b_####.exr"});
    EXPECT_EQ(fewer.status, 0);
    EXPECT_EQ(fewer.err, "reflet: warning: b_####.exr lacks frames that a_#.exr has, which are not compared: 10\n");
    EXPECT_EQ(firstWords(fewer.out)[2], "11");
}

TEST_F(CompareSequence, FilesOfOtherNamesAreNoFrames) {
    writeSequences();
    writeFrame("b_00009.exr", 5.0F);  // too many digits
    writeFrame("b_0009x.exr", 5.0F);
    writeFrame("bb_0009.exr", 5.0F);
    EXPECT_EQ(json({"a_#.exr", "b_####.exr"})["frames"].size(), 4U);
}

TEST_F(CompareSequence, TheHeatMapIsOfTheWorstFrameOrOfEach) {
    writeSequences();
    ASSERT_TRUE(quietSuccess(compare({"a_#.exr", "b_####.exr", "--heatmap", "h_##.png"})));
    ASSERT_TRUE(quietSuccess(compare({"a_#.exr", "b_####.exr", "--heatmap", "worst.png"})));
    const nlohmann::json all = json({"a_#.exr", "b_####.exr"});
    const auto worst = all["worst"]["flip"]["frame"].get<int>();
    EXPECT_EQ(worst, 10);
    EXPECT_EQ(read("worst.png"), read("h_10.png"));
    EXPECT_NE(read("worst.png"), read("h_08.png"));
    EXPECT_TRUE(std::filesystem::exists(path("h_11.png")));
}

TEST_F(CompareSequence, AMaskMayBeASequence) {
    writeSequences();
    for (const std::string number : {"08", "09", "10", "11"}) {
        Bitmap mask{width, height, 3, std::vector<uint8_t>(size_t{width} * height * 3, 255)};
        std::fill_n(mask.data.begin(), 3 * std::stoi(number), uint8_t{0});
        writePng(path("m_" + number + ".png"), mask);
    }
    const nlohmann::json all = json({"a_#.exr", "b_####.exr", "--mask", "m_##.png"});
    EXPECT_EQ(all["frames"][0]["pixels"], width * height - 8);
    EXPECT_EQ(all["frames"][3]["pixels"], width * height - 11);
    EXPECT_EQ(json({"a_#.exr", "b_####.exr", "--mask", "m_08.png"})["frames"][3]["pixels"], width * height - 8);
}

TEST_F(CompareSequence, ALimitHoldsForEveryFrame) {
    writeSequences();
    EXPECT_TRUE(quietSuccess(compare({"a_#.exr", "b_####.exr", "--fail-above", "mean=0.8"})));
    const Outcome broken = compare({"a_#.exr", "b_####.exr", "--fail-above", "mean=0.3", "--fail-above", "bias=0.4"});
    EXPECT_EQ(broken.status, 1);
    EXPECT_EQ(broken.err,
              "reflet: mean is 0.75 in frame 10, above the limit 0.3 (2 of 4 frames break it); bias is 0.5 in frame "
              "9, above the limit 0.4\n");
    EXPECT_EQ(firstWords(broken.out).size(), 2U * 8U);
}

TEST_F(CompareSequence, ThePlotHasACurveForEachMetricAndMarksTheWorst) {
    writeSequences();
    ASSERT_TRUE(quietSuccess(compare({"a_#.exr", "b_####.exr", "--plot", "p.svg"})));
    const std::string svg = read("p.svg");
    const std::regex curve("class=\"curve\" d=\"([^\"]*)\"");
    std::vector<std::string> curves;
    for (std::sregex_iterator i(svg.begin(), svg.end(), curve); i != std::sregex_iterator(); ++i) {
        curves.push_back((*i)[1]);
    }
    ASSERT_EQ(curves.size(), 6U);
    EXPECT_EQ(std::ranges::count(curves[3], 'L'), 3) << "four frames of `mean`";
    EXPECT_EQ(std::ranges::count(curves[1], 'L'), 2) << "PSNR is infinite in the last frame";
    EXPECT_NE(svg.find(">0.75 in frame 10<"), std::string::npos);
    EXPECT_NE(svg.find("a_#.exr against b_####.exr"), std::string::npos);
    EXPECT_EQ(svg.find("nan"), std::string::npos);
    EXPECT_EQ(svg.find("inf"), std::string::npos);
    ASSERT_TRUE(quietSuccess(compare({"a_8.exr", "b_0008.exr"})));
    ASSERT_TRUE(quietSuccess(compare({"a_1#.exr", "b_001#.exr", "--plot", "p.svg"})));
}

TEST_F(CompareSequence, WrongUseIsRefused) {
    writeSequences();
    EXPECT_TRUE(refused(compare({"a_8.exr", "b_####.exr"}), 2, {"b_####.exr", "a_8.exr is one image"}));
    EXPECT_TRUE(refused(compare({"a_8.exr", "b_0008.exr", "--heatmap", "h_#.png"}), 2, {"h_#.png", "one image"}));
    EXPECT_TRUE(refused(compare({"a_8.exr", "b_0008.exr", "--plot", "p.svg"}), 2, {"--plot", "sequences"}));
    EXPECT_TRUE(refused(compare({"a_#.exr", "b_####.exr", "--plot", "p.png"}), 2, {"p.png", ".svg"}));
    EXPECT_TRUE(refused(compare({"c_#.exr", "b_####.exr"}), 1, {"c_#.exr", "no file"}));
    EXPECT_TRUE(refused(compare({"a_#.exr", "c_#.exr"}), 1, {"c_#.exr", "no file"}));
    EXPECT_TRUE(refused(compare({"no/a_#.exr", "b_####.exr"}), 1, {"no/a_#.exr", "folder"}));
    EXPECT_TRUE(refused(compare({"a_#_#.exr", "b_####.exr"}), 2, {"two runs"}));
    EXPECT_TRUE(refused(compare({"a_#.exr", "b_####.exr:depth"}), 1, {"b_0008.exr", "depth"}));
}

}  // namespace
}  // namespace reflet::compare_sequence_test
