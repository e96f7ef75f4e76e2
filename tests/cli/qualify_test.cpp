// `reflet qualify`: its page, its JSON, and its errors. A whole qualification takes minutes, so it is one scene here.
#include "base/json_text.h"
#include "cli/program.h"

#include <nlohmann/json.hpp>

namespace reflet::qualify_test {
namespace {

using QualifyTest = ProgramTest;

const Arguments small{"qualify", "--scenes", "cubes", "--presets", "fast", "--size", "64x36", "--seconds", "0"};

// Compiles the preset's pipelines, which takes most of its seconds.
TEST_F(QualifyTest, WritesAPageAndJson) {
    Arguments all = small;
    all.insert(all.end(), {"-o", "mine"});
    const Outcome outcome = run(all);
    ASSERT_EQ(outcome.status, 0) << outcome.err << outcome.out;
    EXPECT_NE(read("mine.md").find("### Qualification: passed"), std::string::npos) << read("mine.md");
    const nlohmann::json json = parseJson(read("mine.json"));
    EXPECT_TRUE(json.at("passes"));
    ASSERT_EQ(json.at("pictures").size(), 1U);
    EXPECT_EQ(json.at("pictures")[0].at("luminance").size(), 144U);
    EXPECT_LE(json.at("pictures")[0].at("mean_difference"), 0.02);  // null, without a stored picture, throws
    // The error against the reference is that of llvmpipe's stored picture, within the tolerance of the pictures.
    const double error = json.at("pictures")[0].at("reference_error");
    EXPECT_GT(error, 0.005);
    EXPECT_NEAR(error, json.at("pictures")[0].at("reference_error_llvmpipe"), 0.02);
    EXPECT_TRUE(json.at("timed").at("presets").at("fast").at("modelled_passes_ms").empty());  // of 1920x1080 alone
    EXPECT_GT(json.at("timed").at("presets").at("fast").at("frame_ms"), 0.0);
    EXPECT_GT(json.at("timed").at("presets").at("fast").at("passes_ms").size(), 20U);
    EXPECT_GE(json.at("stability").at("rounds"), 2);
    EXPECT_EQ(json.at("stability").at("differing"), 0);
}

TEST_F(QualifyTest, RefusesWhatItDoesNotKnow) {
    const Outcome scene = run({"qualify", "--scenes", "cubez"});
    EXPECT_EQ(scene.status, 2);
    EXPECT_NE(scene.err.find("no built-in scene 'cubez'"), std::string::npos) << scene.err;
    EXPECT_EQ(run({"qualify", "--presets", "fastest"}).status, 2);
    EXPECT_EQ(run({"qualify", "--seconds", "-1"}).status, 2);
}

}  // namespace
}  // namespace reflet::qualify_test
