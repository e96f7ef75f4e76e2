// `reflet report` end to end: its output and its errors.
#include "base/json_text.h"
#include "cli/program.h"
#include "support/html.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <iterator>

namespace reflet::report_test {

namespace {

class ReportTest : public ProgramTest {
protected:
    /// A quick `reflet report SCENES -o out`.
    [[nodiscard]] Outcome report(const Arguments& scenes, const Arguments& more = {}) const {
        Arguments all{"report"};
        all.insert(all.end(), scenes.begin(), scenes.end());
        for (const char* word : {"-o", "out", "--size", "32x18", "--spp", "2", "--frames", "2"}) {
            all.emplace_back(word);
        }
        all.insert(all.end(), more.begin(), more.end());
        return run(all);
    }

    [[nodiscard]] nlohmann::json numbers() const { return parseJson(read("out/report.json")); }
};

std::vector<std::string> variantNames(const nlohmann::json& scene) {
    std::vector<std::string> names;
    std::ranges::transform(scene["variants"], std::back_inserter(names), [](const auto& v) { return v["name"]; });
    return names;
}

// Removes what varies between runs.
nlohmann::json withoutTimes(nlohmann::json numbers) {
    for (auto& scene : numbers["scenes"]) {
        for (auto& variant : scene["variants"]) {
            variant.erase("frame_ms");
            variant.erase("passes");
        }
    }
    return numbers;
}

TEST_F(ReportTest, EveryFileThatThePageNamesIsThere) {
    ASSERT_TRUE(quietSuccess(report({"builtin:cubes"}, {"--preset", "direct,plain"})));
    EXPECT_EQ(files(), std::vector<std::string>{"out"});
    const test::Html html = test::parseHtml(read("out/index.html"));
    EXPECT_EQ(html.mistakes, std::vector<std::string>{});
    size_t named = 0;
    for (const test::Element& element : html.elements) {
        for (const std::string& file : {element.value("src"), element.value("href")}) {
            if (!file.empty() && !file.starts_with("data:")) {
                EXPECT_TRUE(std::filesystem::is_regular_file(path("out") / file)) << file;
                ++named;
            }
        }
    }
    EXPECT_GT(named, 9U);
    EXPECT_TRUE(read("out/table.md").find("| cubes | plain |") != std::string::npos);
}

// Over 5 s: its processes each have their shaders compiled by the driver.
TEST_F(ReportTest, ComparesAllPresetsUnlessSomeAreNamed) {
    // What presets differ in is switched off, so that they share their pipelines.
    Arguments alike;
    for (const char* change : {"diffuse.rays=1", "specular.rays=0", "materials.anisotropy=1", "probes.enabled=false",
                               "denoise.enabled=false", "trace_scene.enabled=false", "planar.enabled=false",
                               "temporal.enabled=false", "shadow.filter=hard"}) {
        alike.insert(alike.end(), {"--set", change});
    }
    ASSERT_TRUE(quietSuccess(report({"builtin:tilted-cube"}, alike)));
    const Arguments all = firstWords(run({"list", "presets"}).out);
    for (const std::string& name : variantNames(numbers()["scenes"][0])) {
        EXPECT_NE(std::ranges::find(all, name), all.end()) << name;
    }
    EXPECT_GE(numbers()["scenes"][0]["variants"].size(), 4U);
}

TEST_F(ReportTest, AVariantIsAPresetWithSettingsOverIt) {
    ASSERT_TRUE(quietSuccess(report(
        {"builtin:cubes"}, {"--preset", "fast", "--set", "diffuse.rays=3", "--set", "probes.enabled=false", "--variant",
                            "plain=specular.rays=0", "--variant", "more=fast,diffuse.rays=5,tonemap.exposure=1"})));
    const nlohmann::json scene = numbers()["scenes"][0];
    EXPECT_EQ(variantNames(scene), (std::vector<std::string>{"fast", "plain", "more"}));
    const auto has = [&](size_t variant, const std::string& setting) {
        const std::string all = scene["variants"][variant]["settings"];
        return fmt::format(" {} ", all).find(fmt::format(" {} ", setting)) != std::string::npos;
    };
    EXPECT_TRUE(has(0, "diffuse.rays=3") && has(0, "denoise.enabled=true")) << "--set overrides the preset";
    EXPECT_EQ(scene["variants"][1]["settings"], "diffuse.rays=3 specular.rays=0");
    EXPECT_TRUE(has(2, "diffuse.rays=5") && has(2, "denoise.enabled=true") && has(2, "tonemap.exposure=1"));
}

TEST_F(ReportTest, TheSameCommandGivesTheSameReportExceptForTimes) {
    const Arguments more{
        "--preset", "fast", "--seed", "3", "--set", "probes.resolution=16", "--set", "shadow.resolution=256"};
    ASSERT_TRUE(quietSuccess(report({"builtin:cubes"}, more)));
    const nlohmann::json first = withoutTimes(numbers());
    const std::string truth = read("out/cubes-truth.png");
    const std::string fast = read("out/cubes-fast.png");
    ASSERT_TRUE(quietSuccess(report({"builtin:cubes"}, more)));
    EXPECT_EQ(withoutTimes(numbers()), first);
    EXPECT_EQ(read("out/cubes-truth.png"), truth);
    EXPECT_EQ(read("out/cubes-fast.png"), fast);
}

TEST_F(ReportTest, AllPicturesHaveTheExposureOfTheGroundTruth) {
    const Arguments twice{"--preset", "direct", "--set", "tonemap.auto_exposure=on"};
    ASSERT_TRUE(quietSuccess(report({"builtin:cubes"}, twice)));
    const nlohmann::json scene = numbers()["scenes"][0];
    const double exposure = scene["exposure"];
    const std::string direct = read("out/cubes-direct.png");
    EXPECT_NE(read("out/index.html").find(fmt::format("Exposure {:+.2f} stops", exposure)), std::string::npos);
    const Arguments fixed{"--preset", "direct",
                          "--set",    "tonemap.auto_exposure=off",
                          "--set",    fmt::format("tonemap.exposure={}", exposure)};
    ASSERT_TRUE(quietSuccess(report({"builtin:cubes"}, fixed)));
    EXPECT_EQ(read("out/cubes-direct.png"), direct);
    EXPECT_TRUE(numbers()["scenes"][0]["exposure"].is_null());
}

TEST_F(ReportTest, SaysWithWhichCommandItWasMade) {
    ASSERT_TRUE(quietSuccess(report({"builtin:cubes"}, {"--preset", "direct,plain", "--variant", "it's=plain"})));
    EXPECT_EQ(numbers()["command"],
              "reflet report builtin:cubes -o out --preset direct,plain --variant 'it'\\''s=plain' --size 32x18 "
              "--frames 2 --spp 2");
}

TEST_F(ReportTest, ScenesOfOneNameKeepTheirPicturesApart) {
    ASSERT_TRUE(quietSuccess(report({"builtin:cubes", "builtin:cubes"}, {"--preset", "plain"})));
    const nlohmann::json all = numbers();
    EXPECT_EQ(all["scenes"][0]["truth"]["picture"], "cubes-truth.png");
    EXPECT_EQ(all["scenes"][1]["truth"]["picture"], "cubes-2-truth.png");
    EXPECT_TRUE(std::filesystem::exists(path("out/cubes-2-plain-error.png")));
}

TEST_F(ReportTest, WithoutBouncesThePresetWithoutRaysIsNearest) {
    ASSERT_TRUE(quietSuccess(report({"builtin:cubes"}, {"--preset", "direct,quality", "--bounces", "0", "--set",
                                                        "probes.resolution=16", "--set", "shadow.resolution=256"})));
    const nlohmann::json scene = numbers()["scenes"][0];
    const double direct = scene["variants"][0]["against_truth"]["relative_mse"];
    const double quality = scene["variants"][1]["against_truth"]["relative_mse"];
    EXPECT_LT(2.0 * direct, quality);
    EXPECT_EQ(numbers()["bounces"], 0);
}

TEST_F(ReportTest, WrongUseIsRefusedBeforeAnythingIsWritten) {
    EXPECT_TRUE(refused(run({"report", "-o", "out"}), 2, {"SCENE"}));
    EXPECT_TRUE(refused(run({"report", "builtin:cubes"}), 2, {"--output"}));
    EXPECT_TRUE(refused(report({"builtin:cubes"}, {"--preset", "fats"}), 2, {"fats", "did you mean 'fast'"}));
    EXPECT_TRUE(refused(report({"builtin:cubes"}, {"--variant", "fast"}), 2, {"--variant", "NAME=", "'fast'"}));
    EXPECT_TRUE(refused(report({"builtin:cubes"}, {"--variant", "a=diffuse.rays=1,fast"}), 2, {"'fast'", "first"}));
    EXPECT_TRUE(refused(report({"builtin:cubes"}, {"--variant", "a=diffuse.rayz=1"}), 2, {"diffuse.rays"}));
    EXPECT_TRUE(refused(report({"builtin:cubes"}, {"--variant", "fast=diffuse.rays=1"}), 2, {"two", "'fast'"}));
    EXPECT_TRUE(refused(report({"builtin:cubes", "builtin:cubez"}), 2, {"cubez", "did you mean 'cubes'"}));
    EXPECT_TRUE(refused(report({"builtin:cubes", "missing.glb"}), 1, {"missing.glb"}));
    EXPECT_EQ(files(), std::vector<std::string>{});
}

TEST_F(ReportTest, AFolderThatCannotBeCreatedIsReportedAtOnce) {
    write("out", "a file");
    EXPECT_TRUE(refused(report({"builtin:cubes"}), 1, {"out"}));
    EXPECT_EQ(read("out"), "a file");
}

}  // namespace
}  // namespace reflet::report_test
