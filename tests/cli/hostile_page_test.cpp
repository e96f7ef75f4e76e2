// The report of scenes and variants whose names are HTML, in a browser (Chromium, if installed): everything is shown
// as text, nothing runs, and no other host is asked. Also without the page's policy, which is the second defence.
#include "cli/browser.h"
#include "support/html.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <regex>
#include <string>
#include <vector>

namespace reflet::hostile_page_test {
namespace {

constexpr const char* triangle = R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],
"nodes":[{"mesh":0}],"meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}],
"accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3","min":[0,0,0],"max":[1,1,0]}],
"bufferViews":[{"buffer":0,"byteLength":36}],"buffers":[{"byteLength":36,
"uri":"data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA"}]})";

// A variant's name ends at the first "=", and RUN is a script.
const std::array<std::string, 3> variantNames{
    "<script>RUN</script>",
    "</title></style></script></h2><script>RUN</script>",
    "'\"><!-- -->\n<script>RUN</script> & &lt;",
};

// Names of files have no slash. "http:NAME" is an address without one.
const std::array<std::string, 4> sceneNames{
    "\"><img src=x onerror=RUN>",
    "<img src=http:other.invalid>\n'\" & &amp;",
    "\" onerror=\"RUN",
    "<link rel=stylesheet href=http:other.invalid><svg onload=RUN>",
};

std::string withScript(const std::string& name) {
    return std::regex_replace(name, std::regex("RUN"), "document.documentElement.setAttribute('data-ran','yes')");
}

// What the page shows of a name.
std::string onOneLine(std::string name) {
    std::ranges::replace(name, '\n', ' ');
    return name;
}

std::string hex(const std::string& text) {
    std::string all;
    for (const char c : text) {
        all += fmt::format("{:02x}", static_cast<unsigned char>(c));
    }
    return all;
}

template <size_t count>
std::string hexList(const std::array<std::string, count>& names) {
    std::string all;
    for (const std::string& name : names) {
        all += (all.empty() ? "" : " ") + hex(onOneLine(withScript(name)));
    }
    return all;
}

// Uses the page, and writes its texts into attributes of the root element.
constexpr const char* userScript = R"(
<script>
addEventListener("load", () => {
    const say = (name, value) => document.documentElement.setAttribute("data-test-" + name, value);
    const all = (selector) => [...document.querySelectorAll(selector)];
    const hex = (element) => [...new TextEncoder().encode(element.textContent)].map(
        (byte) => byte.toString(16).padStart(2, "0")).join("");
    const choice = document.querySelector("select.right");
    choice.value = "5";  // after ground truth, visible-only, plain
    choice.dispatchEvent(new Event("input", { bubbles: true }));
    say("tag", hex(document.querySelector(".tag.right")));
    say("scripts", document.scripts.length);
    say("odd", all("link:not([rel=icon]), [onerror], [onload], [onfocus], [autofocus]").length);
    say("scenes", all("section.scene > h2").map(hex).join(" "));
    say("variants", [...document.querySelector("select.left").options].slice(3).map(hex).join(" "));
    say("done", "yes");
});
</script>
</body>)";

class HostilePage : public BrowserTest {
protected:
    void makeReport() const {
        Arguments all{"report"};
        for (const std::string& name : sceneNames) {
            const std::string file = withScript(name) + ".gltf";
            write(file, triangle);
            all.push_back(file);
        }
        for (const char* word : {"-o", "out", "--size", "32x18", "--preset", "plain", "--spp", "2", "--frames", "1",
                                 "--environment", "none"}) {
            all.emplace_back(word);
        }
        for (size_t i = 0; i < variantNames.size(); ++i) {
            all.emplace_back("--variant");
            all.push_back(fmt::format("{}=plain,tonemap.exposure={}", withScript(variantNames.at(i)), i));
        }
        const Outcome made = run(all);
        ASSERT_EQ(made.status, 0) << made.err;
    }

    void checkPage(const std::string& page) const {
        write("out/test.html", page);
        const Outcome shown = openFile(path("out/test.html"), "1280,900");
        ASSERT_EQ(shown.status, 0) << shown.err;
        EXPECT_EQ(consoleLines(shown), std::vector<std::string>{});
        EXPECT_EQ(foreignRequests(), std::vector<std::string>{});
        const test::Html html = test::parseHtml(shown.out);
        ASSERT_FALSE(html.elements.empty()) << shown.err;
        const auto said = [&](const std::string& name) { return html.elements.front().value("data-" + name); };
        ASSERT_EQ(said("test-done"), "yes");
        EXPECT_EQ(said("ran"), "");
        EXPECT_EQ(said("test-scripts"), "2") << "the page's and the test's";
        EXPECT_EQ(said("test-odd"), "0");
        EXPECT_EQ(said("test-scenes"), hexList(sceneNames));
        EXPECT_EQ(said("test-variants"), hexList(variantNames));
        EXPECT_EQ(said("test-tag"), hex(onOneLine(withScript(variantNames[2])))) << "the page's own script works";
    }

    // Whether something ran or was asked for.
    [[nodiscard]] bool worksAsMarkup(const std::string& name) const {
        write("raw.html", fmt::format("<!doctype html><html><head><title>{0}</title></head><body>"
                                      "<h2>{0}</h2><img src=none title=\"{0}\"></body></html>",
                                      withScript(name)));
        const Outcome shown = openFile(path("raw.html"), "1280,900");
        return shown.out.find("data-ran=\"yes\"") != std::string::npos || !foreignRequests().empty();
    }
};

// Over 5 s: starts a browser twice.
TEST_F(HostilePage, NamesAreTextAndThePageWorks) {
    makeReport();
    checkPage(withAddition(read("out/index.html"), userScript));
    const std::regex policy("<meta http-equiv=\"Content-Security-Policy\"[^>]*>");
    checkPage(withAddition(std::regex_replace(read("out/index.html"), policy, ""), userScript, false));
}

// Over 5 s: starts a browser for each name.
TEST_F(HostilePage, EachNameWouldBeDetectedAsMarkup) {
    for (const std::string& name : variantNames) {
        EXPECT_TRUE(worksAsMarkup(name)) << name;
    }
    for (const std::string& name : sceneNames) {
        EXPECT_TRUE(worksAsMarkup(name)) << name;
    }
    EXPECT_FALSE(worksAsMarkup("cubes"));
}

}  // namespace
}  // namespace reflet::hostile_page_test
