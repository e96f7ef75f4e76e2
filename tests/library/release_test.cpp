// A release's version is in several files: all of them agree.
#include <reflet/reflet.h>

#include <gtest/gtest.h>

#include <fstream>
#include <iterator>
#include <regex>
#include <string>

namespace reflet::test::release_test {
namespace {

std::string read(const std::string& file) {
    std::ifstream stream(REFLET_SOURCE "/" + file);
    return {std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
}

// What the expression's first group is in the file; "" without a match.
std::string found(const std::string& file, const std::string& expression) {
    std::smatch match;
    const std::string text = read(file);
    return std::regex_search(text, match, std::regex(expression)) ? match[1].str() : "";
}

TEST(Release, AllFilesHaveTheVersionOfTheHeader) {
    const std::string version = std::to_string(REFLET_VERSION_MAJOR) + "." + std::to_string(REFLET_VERSION_MINOR) +
                                "." + std::to_string(REFLET_VERSION_PATCH);
    EXPECT_EQ(refletVersion(), REFLET_VERSION);
    EXPECT_EQ(found("CMakeLists.txt", R"(project\(reflet VERSION ([0-9.]+))"), version);
    EXPECT_EQ(found("packaging/vcpkg/reflet/vcpkg.json", R"re("version": "([^"]+)")re"), version);
    EXPECT_EQ(found("packaging/conan/conanfile.py", R"re(\n    version = "([^"]+)")re"), version);
    EXPECT_EQ(found("CHANGELOG.md", R"(\n## \[([0-9][0-9.]*)\])"), version) << "the newest section with a number";
    EXPECT_EQ(found("docs/upgrading.md", R"(\n## From [0-9.]+ to ([0-9.]+)\n)") + ".0", version);
}

TEST(Release, TheChangelogAndThePackagesHaveTheSameDate) {
    const std::string date = found("CMakeLists.txt", R"(set\(REFLET_RELEASE_DATE ([0-9-]+)\))");
    EXPECT_EQ(date.size(), 10U);
    EXPECT_EQ(found("CHANGELOG.md", R"(\n## \[[0-9][0-9.]*\] - ([0-9-]+)\n)"), date);
    const std::string day = found("CMakeLists.txt", R"re(REFLET_RELEASE_DATE_LONG "[A-Z][a-z]+, ([0-9]+) )re");
    EXPECT_EQ(day, date.substr(8)) << "of the Debian changelog";
}

}  // namespace
}  // namespace reflet::test::release_test
