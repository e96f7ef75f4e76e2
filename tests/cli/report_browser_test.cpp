// The report's page in a browser (Chromium, if installed), opened as a file.
#include "cli/browser.h"
#include "support/html.h"

namespace reflet::report_browser_test {

namespace {

// Simulates a user, and writes the effects into attributes of the root element.
constexpr const char* userScript = R"(
<script>
addEventListener("load", async () => {
    const say = (name, value) => document.documentElement.setAttribute("data-test-" + name, value);
    const compare = document.querySelector(".compare");
    const part = (selector) => compare.querySelector(selector);
    const range = part("input");
    const edge = () => getComputedStyle(part("img.right")).clipPath;
    const act = (element, value) => {
        element.value = value;
        element.dispatchEvent(new Event("input", { bubbles: true }));
    };
    const drag = (type, share) => {
        const box = part(".stage").getBoundingClientRect();
        part(".stage").dispatchEvent(new PointerEvent(type, {
            bubbles: true, isPrimary: true, pointerId: 1, button: 0, clientX: box.left + share * box.width,
        }));
    };
    say("shown", getComputedStyle(compare).display !== "none");
    say("images", document.images.length);
    say("broken", [...document.images].filter((i) => !i.complete || i.naturalWidth === 0).length);
    act(range, "25");
    say("edge-quarter", edge());
    say("words-quarter", range.getAttribute("aria-valuetext"));
    act(part("select.left"), "1");
    act(part("select.right"), "3");
    say("left", part("img.left").getAttribute("src"));
    say("right", part("img.right").getAttribute("src"));
    say("right-alt", part("img.right").alt);
    act(part("select.kind"), "visible");
    say("right-map", part("img.right").getAttribute("src"));
    say("right-tag", part(".tag.right").textContent);
    // Not decode(): virtual time waits for requests, but not for a decoder, and ends the page.
    const loaded = part("img.right");
    if (!loaded.complete) {
        await new Promise((done) => loaded.addEventListener("load", done, { once: true }));
    }
    say("map-width", part("img.right").naturalWidth);
    part(".stage").setPointerCapture = () => {};  // simulated pointers cannot be captured
    drag("pointerdown", 0.75);
    say("edge-drag", edge());
    say("tab-stops", compare.querySelectorAll("select, input").length);
    say("unlabelled", [...compare.querySelectorAll("select, input")].filter(
        (e) => e.labels.length === 0 && !e.getAttribute("aria-label")).length);
    say("overflow", document.documentElement.scrollWidth - document.documentElement.clientWidth);
    say("done", "yes");
});
</script>
</body>)";

class ReportBrowserTest : public BrowserTest {
protected:
    void SetUp() override {
        BrowserTest::SetUp();
        if (IsSkipped()) {
            return;
        }
        ASSERT_TRUE(quietSuccess(
            run({"report", "builtin:cubes", "-o", "out", "--size", "64x36", "--spp", "2", "--frames", "2", "--set",
                 "probes.resolution=16", "--set", "shadow.resolution=256", "--preset", "fast,direct"})));
    }

    /// Writes a copy of the page with something added at its end, whose script its policy allows, or does not.
    void extendPage(const std::string& file, const std::string& addition, bool allowed = true) const {
        write("out/" + file, withAddition(read("out/index.html"), addition, allowed));
    }

    [[nodiscard]] Outcome open(const std::string& file, const std::string& window) const {
        return openFile(path("out/" + file), window);
    }
};

// Over 5 s: starts a browser.
TEST_F(ReportBrowserTest, TheDividerAndTheChoicesWork) {
    extendPage("test.html", userScript);
    const Outcome shown = open("test.html", "1280,900");
    ASSERT_EQ(shown.status, 0) << shown.err;
    EXPECT_EQ(consoleLines(shown), std::vector<std::string>{});
    const test::Html html = test::parseHtml(shown.out);
    ASSERT_FALSE(html.elements.empty()) << shown.err;
    const auto said = [&](const std::string& name) { return html.elements.front().value("data-test-" + name); };
    ASSERT_EQ(said("done"), "yes");
    EXPECT_EQ(said("shown"), "true");
    EXPECT_EQ(said("images"), "12");
    EXPECT_EQ(said("broken"), "0");
    EXPECT_EQ(said("edge-quarter"), "inset(0px 0px 0px 25%)");
    EXPECT_EQ(said("words-quarter"), "25 % ground truth, 75 % fast");
    EXPECT_EQ(said("left"), "cubes-visible-only.png");
    EXPECT_EQ(said("right"), "cubes-direct.png");
    EXPECT_EQ(said("right-alt"), "cubes, variant direct");
    EXPECT_EQ(said("right-map"), "cubes-direct-method-error.png");
    EXPECT_EQ(said("right-tag"), "direct, error");
    EXPECT_EQ(said("map-width"), "64");
    EXPECT_EQ(said("edge-drag"), "inset(0px 0px 0px 75%)");
    EXPECT_EQ(said("tab-stops"), "4");
    EXPECT_EQ(said("unlabelled"), "0");
    EXPECT_EQ(foreignRequests(), std::vector<std::string>{});
    EXPECT_EQ(said("overflow"), "0");
}

// Over 5 s: starts a browser.
TEST_F(ReportBrowserTest, APhonesWidthIsEnough) {
    extendPage("test.html", userScript);
    const Outcome shown = open("test.html", "500,900");  // Chromium's minimum width
    ASSERT_EQ(shown.status, 0) << shown.err;
    const test::Html html = test::parseHtml(shown.out);
    ASSERT_FALSE(html.elements.empty()) << shown.err;
    EXPECT_EQ(html.elements.front().value("data-test-overflow"), "0");
}

// Over 5 s: starts a browser.
TEST_F(ReportBrowserTest, AScriptErrorWouldBeDetected) {
    extendPage("test.html", "<script>undefinedFunction();</script></body>");
    EXPECT_EQ(consoleLines(open("test.html", "1280,900")).size(), 1U);
}

// Over 5 s: starts a browser.
TEST_F(ReportBrowserTest, NoOtherScriptRunsAndNoOtherHostIsAsked) {
    extendPage("test.html", R"html(
<script>document.documentElement.setAttribute("data-test-ran", "inline");</script>
<img src="missing.png" onerror="document.documentElement.setAttribute('data-test-ran', 'handler')">
<script src="data:text/javascript,document.documentElement.setAttribute('data-test-ran', 'data')"></script>
<script src="http://other.invalid/script.js"></script>
<img src="http://other.invalid/image.png">
<link rel="stylesheet" href="http://other.invalid/style.css">
<iframe src="http://other.invalid/frame.html"></iframe>
</body>)html",
               false);
    const Outcome shown = open("test.html", "1280,900");
    const test::Html html = test::parseHtml(shown.out);
    ASSERT_FALSE(html.elements.empty()) << shown.err;
    EXPECT_EQ(html.elements.front().value("data-test-ran"), "");
    EXPECT_EQ(consoleLines(shown).size(), 7U) << "the browser tells what it refused";
    EXPECT_EQ(foreignRequests(), std::vector<std::string>{});
}

// Over 5 s: starts a browser.
TEST_F(ReportBrowserTest, ARequestToAnotherHostWouldBeDetected) {
    write("out/test.html", R"(<!doctype html><img src="http://other.invalid/image.png">)");
    EXPECT_EQ(open("test.html", "1280,900").status, 0);
    EXPECT_EQ(foreignRequests(), std::vector<std::string>{"http://other.invalid/image.png"});
}

}  // namespace
}  // namespace reflet::report_browser_test
