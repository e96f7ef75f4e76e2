// The report: its page, its table and its JSON, from synthetic numbers.
#include "base/json_text.h"
#include "measure/report/page.h"
#include "support/html.h"
#include "support/sample_report.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <set>
#include <sstream>

namespace reflet::test::report_page_test {

namespace {

bool contains(std::string_view text, std::string_view part) {
    return text.find(part) != std::string_view::npos;
}

std::set<std::string> ids(const Html& html) {
    std::set<std::string> found;
    for (const Element& element : html.elements) {
        if (element.has("id")) {
            EXPECT_TRUE(found.insert(element.value("id")).second) << "twice: " << element.value("id");
        }
    }
    return found;
}

// The texts of the cells that are marked as the best of their columns.
std::vector<std::string> bestTexts(const ReportPage& page) {
    std::vector<std::string> texts;
    for (const Element& element : parseHtml(reportHtml(page)).named("strong")) {
        texts.push_back(element.text);
    }
    return texts;
}

ReportPage oneScene() {
    ReportPage page = sampleReport();
    page.scenes.pop_back();
    return page;
}

TEST(ReportPage, IsWellFormed) {
    const Html html = parseHtml(reportHtml(sampleReport()));
    EXPECT_EQ(html.mistakes, std::vector<std::string>{});
    EXPECT_EQ(html.named("h1").size(), 1U);
    EXPECT_EQ(html.named("title").size(), 1U);
    EXPECT_EQ(html.named("html").front().value("lang"), "en");
}

TEST(ReportPage, NamesAreTextAndNeverMarkup) {
    const std::string html = reportHtml(sampleReport());
    EXPECT_FALSE(contains(html, "alert(\""));
    EXPECT_FALSE(contains(html, "a <b>"));
    EXPECT_FALSE(contains(html, "<another>"));
    EXPECT_FALSE(contains(html, "<device>"));
    EXPECT_FALSE(contains(html, "<scene>"));
    EXPECT_TRUE(contains(html, "&lt;script&gt;alert(&quot;1&quot;)&lt;/script&gt;"));
    EXPECT_TRUE(contains(html, "a &lt;b&gt; &amp; &#39;c&#39;"));
    EXPECT_EQ(parseHtml(html).named("script").size(), 1U);
}

TEST(ReportPage, EveryPictureHasWordsASizeAndAFile) {
    const ReportPage page = sampleReport();
    const std::vector<std::string> files = pictureFiles(page);
    std::set<std::string> shown;
    for (const Element& image : parseHtml(reportHtml(page)).named("img")) {
        EXPECT_NE(std::ranges::find(files, image.value("src")), files.end()) << image.value("src");
        EXPECT_GT(image.value("alt").size(), 8U) << image.value("src");
        const bool scale = image.value("src") == page.errorScale;
        EXPECT_EQ(image.value("width"), scale ? "256" : "64");
        EXPECT_EQ(image.value("height"), scale ? "12" : "36");
        shown.insert(image.value("src"));
    }
    EXPECT_EQ(shown.size(), files.size()) << "not all pictures are shown";
}

TEST(ReportPage, NothingInItNeedsTheNetwork) {
    const std::string text = reportHtml(sampleReport());
    for (const std::string_view word : {"http:", "https:", "url(", "@import", "fetch(", "XMLHttp", "=\"//"}) {
        EXPECT_FALSE(contains(text, word)) << word;
    }
    for (const Element& element : parseHtml(text).elements) {
        for (const std::string& target : {element.value("src"), element.value("href")}) {
            EXPECT_TRUE(!contains(target, ":") || target == "data:,") << target;
        }
    }
}

TEST(ReportPage, LinksNamePartsThatAreThere) {
    const Html html = parseHtml(reportHtml(sampleReport()));
    const std::set<std::string> known = ids(html);
    size_t links = 0;
    for (const Element& link : html.named("a")) {
        if (const std::string target = link.value("href"); target.starts_with('#')) {
            EXPECT_TRUE(known.contains(target.substr(1))) << target;
            ++links;
        }
    }
    EXPECT_EQ(links, 2U);
}

TEST(ReportPage, EveryChoiceHasAPicture) {
    std::multiset<std::string> pictures;
    std::multiset<std::string> choices;
    const Html html = parseHtml(reportHtml(sampleReport()));
    for (const Element& image : html.named("img")) {
        if (image.value("data-kind") == "picture") {
            pictures.insert({image.value("data-of"), image.value("data-of")});  // the choice left, and right
        }
    }
    for (const Element& option : html.named("option")) {
        if (const std::string value = option.value("value");
            value.find_first_not_of("0123456789") == std::string::npos) {
            choices.insert(value);
        }
    }
    EXPECT_EQ(choices.size(), 2U * 2U * 5U);  // scenes, sides, truth and visible-only and three variants
    EXPECT_EQ(choices, pictures);
}

TEST(ReportPage, TheBestOfEachColumnIsMarkedInWords) {
    EXPECT_EQ(bestTexts(oneScene()),
              (std::vector<std::string>{"1.00", "0.12500", "0.2500", "29.9", "0.06250", "0.1250", "∞"}));
}

TEST(ReportPage, NothingIsBestWhereAllAreEqualOrAlone) {
    ReportPage page = oneScene();
    page.scenes[0].variants.resize(1);
    EXPECT_EQ(bestTexts(page), std::vector<std::string>{});
    page.scenes[0].variants.push_back(page.scenes[0].variants[0]);
    EXPECT_EQ(bestTexts(page), std::vector<std::string>{});
}

TEST(ReportPage, PassesOfAllVariantsStandInTheOrderOfTheFrame) {
    std::vector<std::string> rows;
    for (const Element& head : parseHtml(reportHtml(oneScene())).named("th")) {
        if (head.value("scope") == "row") {
            rows.push_back(head.text);
        }
    }
    const std::vector<std::string> passes(rows.end() - 5, rows.end());
    EXPECT_EQ(passes, (std::vector<std::string>{"gbuffer", "diffuse.trace_screen", "shadow_map", "tonemap", "frame"}));
}

TEST(ReportPage, SaysUnderWhichConditionsItWasMade) {
    ReportPage page = oneScene();
    page.bounces = 3;
    page.seed = 17;
    const std::string html = reportHtml(page);
    for (const std::string_view words :
         {"A &lt;device&gt; &amp; co", "64 × 36", "3 bounces", ">17<", "reflet 1.2.3", "64 samples per pixel",
          "noise 0.0100", "reflet report &#39;a &lt;scene&gt;.glb&#39; -o out", "<svg viewBox"}) {
        EXPECT_TRUE(contains(html, words)) << words;
    }
    page.bounces.reset();
    EXPECT_TRUE(contains(reportHtml(page), "unlimited bounces"));
}

TEST(ReportPage, DoesWithoutAPlot) {
    ReportPage page = oneScene();
    page.plotSvg.clear();
    EXPECT_FALSE(contains(reportHtml(page), "<svg"));
    EXPECT_EQ(parseHtml(reportHtml(page)).mistakes, std::vector<std::string>{});
}

TEST(ReportNumbers, TheMarkdownTableHasAsManyCellsInEveryRow) {
    std::istringstream lines(reportMarkdown(sampleReport()));
    size_t rows = 0;
    for (std::string line; std::getline(lines, line);) {
        if (line.starts_with('|')) {
            const auto bars = std::ranges::count(line, '|');
            const bool escaped = contains(line, "wide\\|open");
            EXPECT_EQ(bars, escaped ? 11 : 10) << line;
            ++rows;
        }
    }
    EXPECT_EQ(rows, 2U + 2U * (3U + 2U));
}

TEST(ReportNumbers, NamesMayBeAnyBytes) {
    ReportPage page = oneScene();
    page.scenes[0].name = "caf\xE9";
    EXPECT_EQ(parseJson(reportJson(page))["scenes"][0]["name"], "caf\xEF\xBF\xBD");
    EXPECT_EQ(reportHtml(page).find('\xE9'), std::string::npos);
}

TEST(ReportNumbers, TheJsonHoldsEveryNumber) {
    const nlohmann::ordered_json json = parseOrderedJson(reportJson(sampleReport()));
    EXPECT_EQ(json["scenes"].size(), 2U);
    EXPECT_EQ(json["bounces"], "unlimited");
    const auto& variant = json["scenes"][0]["variants"][1];
    EXPECT_EQ(variant["name"], "quality");
    EXPECT_EQ(variant["against_truth"]["relative_mse"], 0.125);
    EXPECT_TRUE(variant["against_visible_only"]["psnr"].is_null()) << "infinity";
    EXPECT_EQ(variant["passes"]["diffuse.trace_screen"], 8.0);
    EXPECT_EQ(json["scenes"][0]["visible_only"]["against_truth"]["flip"], 0.05);
    EXPECT_EQ(json["scenes"][0]["truth"]["noise"], 0.01);
}

}  // namespace
}  // namespace reflet::test::report_page_test
