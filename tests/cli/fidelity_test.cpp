// bench/fidelity/render.py: a scenario of Khronos' fidelity tests as its generator passes it.
#include "cli/program.h"

#include "base/image_file.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

namespace reflet::fidelity_test {
namespace {

class Fidelity : public ProgramTest {
protected:
    void SetUp() override {
        if (runOther("python3", {"--version"}).status != 0) {
            GTEST_SKIP() << "there is no python3";
        }
        write("model.gltf", triangleAnd(R"("nodes": [{"mesh": 0}])"));
        std::string light = "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 2 +X 4\n";
        for (int i = 0; i < 8; ++i) {
            light += std::string({'\x40', '\x40', '\x40', '\x81'});
        }
        write("light.hdr", light);
    }

    [[nodiscard]] Outcome draw(const char* lighting, const Arguments& options) const {
        Arguments all{REFLET_SOURCE "/bench/fidelity/render.py", "--program", REFLET_PROGRAM};
        all.insert(all.end(), options.begin(), options.end());
        all.push_back(fmt::format(
            R"({{"scenario": {{"name": "a", "model": "{}", "lighting": "{}", "dimensions": {{"width": 16, "height": 9}},
                "target": {{"x": 0.3, "y": 0.3, "z": 0}}, "orbit": {{"theta": 0, "phi": 90, "radius": 2}}, "verticalFoV": 45,
                "renderSkybox": false}}, "outputFile": "{}"}})",
            path("model.gltf").string(), path(lighting).string(), path("a.png").string()));
        return runOther("python3", all);
    }
};

TEST_F(Fidelity, APictureHasTwiceTheScenariosSizeAndShowsTheModel) {
    for (const Arguments& options : {Arguments{"--preset", "direct"}, Arguments{"--spp", "1"}}) {
        const Outcome drawn = draw("light.hdr", options);
        ASSERT_EQ(drawn.status, 0) << drawn.err;
        const Bitmap picture = readBitmap(path("a.png"));
        EXPECT_EQ(picture.width, 32U);
        EXPECT_EQ(picture.height, 18U);
    }
}

TEST_F(Fidelity, AMissingFileIsNamed) {
    const Outcome drawn = draw("dark.hdr", {});
    EXPECT_EQ(drawn.status, 1);
    EXPECT_NE(drawn.err.find("dark.hdr: no such file"), std::string::npos) << drawn.err;
}

}  // namespace
}  // namespace reflet::fidelity_test
