// The documentation's site (docs/site.sh), where mkdocs is installed: every link of every page, and pages in a browser.
#include "cli/browser.h"

#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <regex>
#include <set>
#include <string>

namespace reflet::site_test {
namespace {

namespace fs = std::filesystem;

std::string textOf(const fs::path& file) {
    std::ifstream stream(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
}

// What a page links to or shows, as written.
struct Links {
    std::set<std::string> targets;
    std::set<std::string> pictures;
};

Links linksOf(const std::string& page) {
    static const std::regex attribute(R"re(<(a|img|script|link)\b[^>]*?\b(?:href|src)="([^"]*)")re");
    Links links;
    for (std::sregex_iterator i(page.begin(), page.end(), attribute), end; i != end; ++i) {
        ((*i)[1] == "img" ? links.pictures : links.targets).insert((*i)[2]);
    }
    return links;
}

bool isElsewhere(const std::string& link) {
    return link.starts_with("http://") || link.starts_with("https://") || link.starts_with("data:");
}

// A page that shows all pictures, and says how many the browser could not decode.
std::string pageOf(const std::set<fs::path>& pictures) {
    std::string page = "<!doctype html><html><body>";
    for (const fs::path& picture : pictures) {
        page += "<img src=\"" + picture.string() + "\" alt=\"\">";
    }
    return page + R"(<script>
addEventListener("load", () => {
    const broken = [...document.images].filter((i) => !i.complete || i.naturalWidth === 0);
    document.documentElement.setAttribute("data-images", document.images.length);
    document.documentElement.setAttribute("data-broken", broken.map((i) => i.src).join(" "));
});
</script></body></html>)";
}

// Types a word, and writes into attributes of the root element what there is then.
constexpr const char* userScript = R"(<script>
addEventListener("load", () => {
    const say = (name, value) => document.documentElement.setAttribute("data-test-" + name, value);
    const field = document.querySelector(".search input");
    field.value = "hierarchical depth";
    field.dispatchEvent(new Event("input", { bubbles: true }));
    setTimeout(() => {
        say("found", document.querySelectorAll(".results a").length);
        say("wipes", document.querySelectorAll(".wipe img").length);
        say("overflow", document.documentElement.scrollWidth - document.documentElement.clientWidth);
    }, 1000);
});
</script></body>)";

// As a user of Doxygen's search, which runs in a frame and has no other sign here than that it opens.
constexpr const char* apiScript = R"(<script>
addEventListener("load", () => setTimeout(() => {
    document.getElementById("MSearchField").value = "reflet";
    searchBox.OnSearchFieldChange({ keyCode: 0, which: 0 });
    setTimeout(() => {
        const results = getComputedStyle(document.getElementById("MSearchResultsWindow")).display;
        document.documentElement.setAttribute("data-results", results);
        document.documentElement.setAttribute("data-menus", document.querySelectorAll("#main-menu > li").length);
    }, 1500);
}, 500));
</script></body>)";

class Site : public BrowserTest {
protected:
    void SetUp() override {
        BrowserTest::SetUp();
        if (!IsSkipped() && !isInstalled("mkdocs")) {
            GTEST_SKIP() << "no mkdocs in PATH";
        }
    }

    // The attributes that a script left on a page's root element. A page that allows all its own scripts must not get
    // the hash of one: it would allow that one alone.
    [[nodiscard]] std::map<std::string, std::string> visit(const std::string& page, const std::string& window,
                                                           const char* script = userScript) const {
        const std::string original = textOf(path("site/" + page));
        const bool allowsAll = original.find("script-src 'self' file: 'unsafe-inline'") != std::string::npos;
        EXPECT_EQ(allowsAll, page.starts_with("api/")) << page;
        const std::string text = withAddition(original, script, !allowsAll);
        const fs::path copy = path("site/" + page).replace_filename("visited.html");
        std::ofstream(copy) << text;
        const Outcome shown = openFile(copy, window);
        fs::remove(copy);
        EXPECT_EQ(shown.status, 0) << shown.err;
        EXPECT_EQ(consoleLines(shown), std::vector<std::string>{}) << page;
        EXPECT_EQ(foreignRequests(), std::vector<std::string>{}) << page;
        return attributesOf(shown);
    }
    static std::map<std::string, std::string> attributesOf(const Outcome& shown) {
        static const std::regex attribute(R"re(\b(data-[a-z-]+)="([^"]*)")re");
        const std::string root = shown.out.substr(0, shown.out.find('>', shown.out.find("<html")));
        std::map<std::string, std::string> found;
        for (std::sregex_iterator i(root.begin(), root.end(), attribute), end; i != end; ++i) {
            found[(*i)[1]] = (*i)[2];
        }
        return found;
    }
    // Follows a page's links. Returns its pictures.
    static void follow(const fs::path& page, std::set<fs::path>& pictures) {
        const auto target = [&](const std::string& link) {
            const std::string file = link.substr(0, link.find('#'));
            return file.empty() ? page : (page.parent_path() / file).lexically_normal();
        };
        const Links links = linksOf(textOf(page));
        for (const std::string& link : links.targets) {
            if (isElsewhere(link)) {
                continue;
            }
            EXPECT_TRUE(fs::is_regular_file(target(link))) << page << ": " << link;
            const size_t anchor = link.find('#');
            if (anchor != std::string::npos && anchor + 1 < link.size()) {
                EXPECT_NE(textOf(target(link)).find("id=\"" + link.substr(anchor + 1) + "\""), std::string::npos)
                    << page << ": " << link;
            }
        }
        for (const std::string& picture : links.pictures) {
            EXPECT_FALSE(isElsewhere(picture)) << page << ": " << picture;
            pictures.insert(target(picture));
        }
    }
};

// Over 5 s: makes a hundred pages and starts a browser four times.
TEST_F(Site, HasNoBrokenLinkAndNoBrokenPictureAndAsksNoOtherHost) {
    const Outcome made =
        runOther("bash", {REFLET_SOURCE "/docs/site.sh", path("site").string(), path("none").string()});
    ASSERT_EQ(made.status, 0) << made.out << made.err;
    std::set<fs::path> pictures;
    int pages = 0;
    for (const auto& entry : fs::recursive_directory_iterator(path("site"))) {
        const bool isPage = entry.path().extension() == ".html";
        if (isPage && entry.path().string().find("/api/") == std::string::npos) {  // that is Doxygen's
            follow(entry.path(), pictures);
            ++pages;
        }
        if (isPage) {
            EXPECT_NE(textOf(entry.path()).find("Content-Security-Policy"), std::string::npos) << entry.path();
        }
    }
    EXPECT_GT(pages, 50);
    EXPECT_GT(pictures.size(), 100U);
    std::ofstream(path("pictures.html")) << pageOf(pictures);
    const auto all = attributesOf(openFile(path("pictures.html"), "1280,900"));
    ASSERT_TRUE(all.contains("data-images"));
    EXPECT_EQ(all.at("data-images"), std::to_string(pictures.size()));
    EXPECT_EQ(all.at("data-broken"), "");
    const auto phone = visit("docs/methods/reflections.html", "500,900");
    EXPECT_EQ(phone.at("data-test-overflow"), "0");
    EXPECT_EQ(phone.at("data-test-wipes"), "2");
    const auto desk = visit("index.html", "1280,900");
    EXPECT_EQ(desk.at("data-test-overflow"), "0");
    EXPECT_EQ(desk.at("data-test-found"), "12");
    if (fs::exists(path("site/api"))) {  // doxygen is installed
        const auto api = visit("api/reflet_8h_source.html", "1280,900", apiScript);
        EXPECT_EQ(api.at("data-results"), "block");
        EXPECT_GT(std::stoi(api.at("data-menus")), 2);
    }
}

}  // namespace
}  // namespace reflet::site_test
