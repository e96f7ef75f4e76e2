// The program says and writes the same bytes in every locale: in German and Turkish a decimal point is a comma, and in
// Turkish the small letter of I is another one.
#include "base/file.h"
#include "cli/program.h"

#include <filesystem>
#include <regex>

namespace reflet::locale_test {
namespace {

namespace fs = std::filesystem;

class Locale : public ProgramTest, public testing::WithParamInterface<const char*> {
protected:
    /// The variables that choose the locale; empty if it cannot be made.
    [[nodiscard]] Variables chosen() const {
        const fs::path folder = path("locales");
        fs::create_directories(folder);
        const std::string name = std::string(GetParam()) + ".UTF-8";
        // 1: made, with warnings.
        if (runOther("localedef", {"--no-archive", "-i", GetParam(), "-f", "UTF-8", (folder / name).string()}).status >
            1) {
            return {};
        }
        return {{"LOCPATH", folder.string()}, {"LC_ALL", name}, {"LANG", name}, {"LANGUAGE", ""}};
    }

    /// The outputs and the named file of the commands, with these variables.
    [[nodiscard]] std::vector<std::string> said(const std::vector<Arguments>& commands, const Variables& variables,
                                                std::string_view file) const {
        std::vector<std::string> all;
        for (const Arguments& command : commands) {
            const Outcome done = run(command, variables);
            EXPECT_EQ(done.status, 0) << command.front() << ": " << done.err;
            all.push_back(done.out + done.err);
        }
        all.push_back(read(file));
        return all;
    }
};

TEST_P(Locale, ChangesNoByteOfWhatIsSaidOrWritten) {
    if (!isInstalled("localedef")) {
        GTEST_SKIP() << "no localedef: install Debian's package locales";
    }
    const Variables locale = chosen();
    if (locale.empty()) {
        GTEST_SKIP() << "localedef has no definition of " << GetParam();
    }
    ASSERT_EQ(runOther("locale", {"decimal_point"}, locale).out, ",\n") << "the locale is not in use";
    write("v.json", R"({"camera": {"position": [1.25, 2.5, 3.75], "target": [0, 0.5, 0]}})");
    write("scene.gltf", triangleAnd(R"("nodes":[{"mesh":0,"translation":[0.25,0,0]}])"));
    const std::vector<Arguments> commands{
        {"--help"},
        {"render", "--help"},
        {"list", "settings"},
        {"list", "presets"},
        {"completion", "bash"},
        {"info", "scene.gltf"},
        {"info", "builtin:cubes"},
        {"reference", "builtin:cubes", "--view-file", "v.json", "--fov", "41.5", "--size", "16x9", "--spp", "2",
         "--bounces", "1", "--seed", "1", "--save-view", "w.json", "--quiet", "-o", "a_0000.exr"},
        {"reference", "builtin:cubes", "--view-file", "w.json", "--size", "16x9", "--spp", "4", "--bounces", "1",
         "--seed", "2", "--quiet", "-o", "b_0000.exr"},
        {"compare", "a_0000.exr", "b_0000.exr", "--json"},
        {"compare", "a_0000.exr", "b_0000.exr"},
        {"compare", "a_####.exr", "b_####.exr", "--plot", "p.svg"}};
    const std::vector<std::string> plain = said(commands, {{"LC_ALL", "C"}}, "w.json");
    const std::string picture = read("a_0000.exr");
    const std::string plot = read("p.svg");
    EXPECT_NE(plain.back().find("1.25"), std::string::npos) << plain.back();
    for (const char* file : {"a_0000.exr", "b_0000.exr", "p.svg", "w.json"}) {
        fs::remove(path(file));
    }
    const std::vector<std::string> local = said(commands, locale, "w.json");
    for (size_t i = 0; i < plain.size(); ++i) {
        EXPECT_EQ(local[i], plain[i]) << "command " << i;
    }
    EXPECT_TRUE(read("a_0000.exr") == picture);
    EXPECT_EQ(read("p.svg"), plot);
}

INSTANTIATE_TEST_SUITE_P(OfComma, Locale, testing::Values("de_DE", "tr_TR"),
                         [](const auto& locale) { return std::string(locale.param); });

// A host of the library has a locale of its own, which the functions of C obey.
TEST(Sources, AskNoLocale) {
    const std::regex asks(R"(\b(std::locale\b|(setlocale|imbue|strto[dflu]\w*|std::sto[a-z]+|ato[fil]|sscanf|)"
                          R"(is(alpha|alnum|digit|space|upper|lower|punct|print)|to(upper|lower))\())");
    size_t files = 0;
    for (const char* folder : {"src", "include"}) {
        for (const auto& entry : fs::recursive_directory_iterator(fs::path(REFLET_SOURCE) / folder)) {
            const std::string kind = entry.path().extension().string();
            if (entry.path().filename() == "format.cpp" || (kind != ".cpp" && kind != ".h")) {
                continue;  // base/format.cpp instantiates a library's templates
            }
            ++files;
            const std::string text = readFile(entry.path());
            std::smatch found;
            EXPECT_FALSE(std::regex_search(text, found, asks)) << entry.path() << ": " << found.str();
        }
    }
    EXPECT_GT(files, 500U);
}

}  // namespace
}  // namespace reflet::locale_test
