// `reflet list`, help, version, and the generated documentation.
#include "cli/program.h"

#include "base/file.h"
#include "base/json_text.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <filesystem>

namespace reflet::list_test {
namespace {

class Lists : public ProgramTest {
protected:
    /// Standard output of a command that must succeed.
    [[nodiscard]] std::string output(const Arguments& arguments) const {
        const Outcome done = run(arguments);
        EXPECT_TRUE(quietSuccess(done));
        return done.out;
    }
};

testing::AssertionResult has(const std::string& text, std::initializer_list<std::string_view> words) {
    for (const std::string_view word : words) {
        if (text.find(word) == std::string::npos) {
            return testing::AssertionFailure() << "no '" << word << "' in: " << text;
        }
    }
    return testing::AssertionSuccess();
}

TEST_F(Lists, ScenesAreNamedAsRenderTakesThem) {
    EXPECT_TRUE(has(output({"list", "scenes"}), {"builtin:cubes ", "builtin:cornell ", "builtin:cave "}));
}

TEST_F(Lists, PresetsAreShownWithWhatTheySet) {
    EXPECT_TRUE(has(output({"list", "presets"}), {"plain", "direct", "fast", "balanced", "quality", R"("rays":0)"}));
}

TEST_F(Lists, MaterialVariantsOfAFileAreThoseThatRenderTakes) {
    write("shoe.gltf", triangleAnd(R"("nodes": [{"mesh": 0}], "extensions": {"KHR_materials_variants":
        {"variants": [{"name": "beach"}, {"name": "street"}]}})"));
    EXPECT_EQ(output({"list", "variants", "shoe.gltf"}), "beach\nstreet\n");
    EXPECT_TRUE(refused(run({"render", "shoe.gltf", "--variant", "snow", "-o", "x.png"}), 2,
                        {"shoe.gltf", "no material variant 'snow'", "beach, street"}));
    EXPECT_TRUE(refused(run({"render", "builtin:cubes", "--variant", "snow", "-o", "x.png"}), 2,
                        {"--variant snow", "built-in"}));
}

TEST_F(Lists, PassesOfAFrameAreTablesOrDiagrams) {
    const auto passes = [&](const Arguments& more) {
        Arguments all{"list", "passes", "builtin:cubes", "--size", "64x36", "--preset", "direct"};
        all.insert(all.end(), more.begin(), more.end());
        return run(all);
    };
    EXPECT_TRUE(has(passes({}).out, {"### Passes\n", "| pass |", "### Resources\n", "| resource |"}));
    EXPECT_TRUE(passes({"--format", "mermaid"}).out.starts_with("flowchart TD\n"));
    EXPECT_TRUE(passes({"--format", "dot"}).out.starts_with("digraph frame {\n"));
    EXPECT_TRUE(refused(passes({"--format", "svg"}), 2, {"--format", "svg"}));
}

TEST_F(Lists, EveryShowHasALineOfItsOwn) {
    const std::string text = output({"list", "shows"});
    std::vector<std::string> names = firstWords(text);
    EXPECT_TRUE(std::ranges::find(names, "final") != names.end());
    EXPECT_TRUE(std::ranges::find(names, "sun_visibility") != names.end());
    std::ranges::sort(names);
    EXPECT_TRUE(std::ranges::adjacent_find(names) == names.end()) << text;
}

TEST_F(Lists, SettingsAreALineEachOfAtMostAHundredCharacters) {
    const std::string text = output({"list", "settings"});
    EXPECT_TRUE(has(text, {"diffuse.rays ", "trace_screen.max_steps ", "reflet list settings NAME"}));
    size_t begin = 0;
    while (begin < text.size()) {
        const size_t end = text.find('\n', begin);
        EXPECT_LE(end - begin, 100U) << text.substr(begin, end - begin);
        begin = end + 1;
    }
}

TEST_F(Lists, ASettingOrAGroupIsDescribedInFull) {
    EXPECT_TRUE(has(output({"list", "settings", "diffuse.rays"}), {"diffuse.rays", "default 4", "0 to 256"}));
    EXPECT_TRUE(has(output({"list", "settings", "shadow"}), {"shadow.filter", "choice", "pcss", "shadow.denoise"}));
    EXPECT_TRUE(refused(run({"list", "settings", "shadw.filter"}), 2, {"did you mean 'shadow.filter'"}));
}

TEST_F(Lists, OldNamesOfSettingsAndPresetsAreToldTheNewOnes) {
    for (const auto& [old, now] :
         {std::pair("trace_screen.maxSteps", "trace_screen.max_steps"), std::pair("shadow.clean", "shadow.denoise"),
          std::pair("environment.lostShare", "environment.occluded_weight")}) {
        EXPECT_TRUE(refused(run({"list", "settings", old}), 2, {old, "is called", now}));
    }
    const Arguments render{"render", "builtin:cubes", "-o", "a.png"};
    const auto refusedWith = [&](const std::string& option, const std::string& value, std::string_view now) {
        Arguments all = render;
        all.insert(all.end(), {option, value});
        return refused(run(all), 2, {"is called", now});
    };
    EXPECT_TRUE(refusedWith("--preset", "screen+probes", "'screen_probes'"));
    EXPECT_TRUE(refusedWith("--set", "depth.format=reversedFloat", "'reversed_float'"));
}

TEST_F(Lists, SettingsAsJsonHaveTypesAndLimits) {
    const nlohmann::json all = parseJson(output({"list", "settings", "--json"}));
    const auto found = std::ranges::find_if(all, [](const auto& s) { return s.at("name") == "diffuse.rays"; });
    ASSERT_NE(found, all.end());
    EXPECT_EQ(found->at("default"), "4");
    EXPECT_EQ(found->at("maximum"), 256);
    EXPECT_FALSE(found->at("help").get<std::string>().empty());
}

TEST_F(Lists, TheManualPageAndCompletionsNameEveryOptionOfTheHelp) {
    EXPECT_TRUE(has(output({"man"}), {".TH REFLET 1", "reflet render", "\\-\\-view\\-file", "EXIT STATUS"}));
    EXPECT_TRUE(has(output({"completion", "bash"}),
                    {"--view-file", "balanced", "builtin:cave", "trace_screen.max_steps=", "sun_visibility"}));
    EXPECT_TRUE(has(output({"completion", "zsh"}), {"#compdef reflet", "--view-file"}));
    EXPECT_TRUE(has(output({"completion", "fish"}), {"complete -c reflet", "-l view-file", "balanced"}));
    EXPECT_TRUE(refused(run({"completion", "tcsh"}), 2, {"bash"}));
}

// What bash offers after a line, by the completion that the program prints.
TEST_F(Lists, BashCompletesCommandsOptionsValuesAndScenes) {
    write("completion.bash", output({"completion", "bash"}));
    const auto offered = [&](const std::string& words) {
        const Outcome done = runOther(
            "bash", {"-c", "source completion.bash; COMP_WORDS=(" + words +
                               "); COMP_CWORD=$((${#COMP_WORDS[@]} - 1)); _reflet; printf '%s\n' \"${COMPREPLY[@]}\""});
        EXPECT_EQ(done.status, 0) << done.err;
        return done.out;
    };
    EXPECT_EQ(offered("reflet rend"), "render\n");
    EXPECT_EQ(offered("reflet render --view-f"), "--view-file\n");
    EXPECT_EQ(offered("reflet render --preset bal"), "balanced\n");
    EXPECT_EQ(offered("reflet render --set trace_screen.max_st"), "trace_screen.max_steps=\n");
    EXPECT_EQ(offered("reflet render builtin : cav"), "cave\n");
}

TEST_F(Lists, DevicesAreShownWithNumberAndWhetherTheyCanBeUsed) {
    EXPECT_TRUE(has(output({"list", "devices"}), {"0  ", "Vulkan 1.", "supported", "optional features"}));
}

TEST_F(Lists, HelpNamesEveryOption) {
    EXPECT_TRUE(has(output({"--help"}), {"render", "list", "--version"}));
    EXPECT_TRUE(has(output({"render", "--help"}), {"SCENE", "--output", "-o", "--scene", "--camera", "--view-file",
                                                   "--size", "--preset", "--settings", "--set ", "--seed", "--frames",
                                                   "--show", "--aov", "--device", "--timings", "--validate"}));
    EXPECT_TRUE(has(output({"list", "--help"}), {"scenes", "presets", "shows", "settings", "devices"}));
    EXPECT_TRUE(has(output({"list", "settings", "--help"}), {"--markdown"}));
}

TEST_F(Lists, VersionIsOneLine) {
    const std::string text = output({"--version"});
    EXPECT_TRUE(text.starts_with("reflet ")) << text;
    EXPECT_EQ(std::ranges::count(text, '\n'), 1);
}

TEST_F(Lists, TheDocumentedSettingsAreThoseOfTheProgram) {
    const std::string page = readFile(std::filesystem::path(REFLET_SOURCE) / "docs" / "settings.md");
    EXPECT_EQ(output({"list", "settings", "--markdown"}), page)
        << "regenerate it: build/bin/reflet list settings --markdown > docs/settings.md";
}

TEST_F(Lists, TheDocumentedDiagramOfTheFrameIsThatOfTheProgram) {
    const std::string page = readFile(std::filesystem::path(REFLET_SOURCE) / "docs" / "architecture.md");
    const std::string diagram =
        output({"list", "passes", "builtin:cubes", "--preset", "balanced", "--format", "mermaid"});
    EXPECT_TRUE(has(page, {"```mermaid\n" + diagram + "```\n<!-- end of passes -->"})) << "run docs/architecture.sh";
}

TEST_F(Lists, AListThatCannotBeWrittenIsAFailure) {
    EXPECT_TRUE(refused(run({"list", "scenes"}, {}, "/dev/full"), 1, {"standard output"}));
}

}  // namespace
}  // namespace reflet::list_test
