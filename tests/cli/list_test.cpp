// `reflet list`, help, version, and the generated documentation.
#include "cli/program.h"

#include "base/file.h"

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

TEST_F(Lists, EveryShowHasALineOfItsOwn) {
    const std::string text = output({"list", "shows"});
    std::vector<std::string> names = firstWords(text);
    EXPECT_TRUE(std::ranges::find(names, "final") != names.end());
    EXPECT_TRUE(std::ranges::find(names, "sun_visibility") != names.end());
    std::ranges::sort(names);
    EXPECT_TRUE(std::ranges::adjacent_find(names) == names.end()) << text;
}

TEST_F(Lists, SettingsAreShownWithRangeAndDefault) {
    EXPECT_TRUE(has(output({"list", "settings"}), {"diffuse.rays ", "0 to 256", "default 4", "true or false"}));
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

TEST_F(Lists, AListThatCannotBeWrittenIsAFailure) {
    EXPECT_TRUE(refused(run({"list", "scenes"}, {}, "/dev/full"), 1, {"standard output"}));
}

}  // namespace
}  // namespace reflet::list_test
