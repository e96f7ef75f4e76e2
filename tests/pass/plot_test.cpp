// measure/report: the scatter plot, its axes and its labels. No device is needed.
#include "measure/report/plot.h"

#include "measure/report/plot_axis.h"
#include "measure/report/plot_labels.h"
#include "measure/report/xml_text.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <regex>
#include <string>

namespace reflet::test::plot_test {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
const double nan = std::nan("");

ScatterPlot plotOf(std::vector<ScatterPoint> points) {
    return {"Cost and error", "ms per frame", "relative MSE", std::move(points)};
}

size_t count(const std::string& text, const std::string& part) {
    size_t found = 0;
    for (size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) {
        ++found;
    }
    return found;
}

/// Of the markers in the plot, in the order in which they are drawn.
std::vector<vec2> markersOf(const std::string& svg) {
    static const std::regex marker(R"(class="marker"[^>]*translate\(([-0-9.]+),([-0-9.]+)\))");
    std::vector<vec2> result;
    for (std::sregex_iterator i(svg.begin(), svg.end(), marker); i != std::sregex_iterator(); ++i) {
        result.emplace_back(std::stof((*i)[1]), std::stof((*i)[2]));
    }
    return result;
}

/// Expects a whole document: every number finite and within the view, tags closed in order.
void expectSound(const std::string& svg) {
    EXPECT_TRUE(svg.starts_with("<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 ")) << svg;
    EXPECT_EQ(svg.find("\"nan"), std::string::npos);
    EXPECT_EQ(svg.find("inf\""), std::string::npos);
    std::smatch view;
    ASSERT_TRUE(std::regex_search(svg, view, std::regex("viewBox=\"0 0 ([0-9]+) ([0-9]+)\"")));
    static const std::regex number(R"( (x|y)="([^"]*)\")");
    for (std::sregex_iterator i(svg.begin(), svg.end(), number); i != std::sregex_iterator(); ++i) {
        const float value = std::stof((*i)[2]);
        EXPECT_TRUE(value >= 0.0F && value <= std::stof(view[(*i)[1] == "x" ? 1 : 2])) << (*i)[0];
    }
    for (const vec2& marker : markersOf(svg)) {
        EXPECT_TRUE(marker.x >= 0.0F && marker.x <= std::stof(view[1])) << marker.x;
        EXPECT_TRUE(marker.y >= 0.0F && marker.y <= std::stof(view[2])) << marker.y;
    }
    for (const char* tag : {"svg", "g", "text", "title", "desc"}) {
        EXPECT_EQ(count(svg, std::string("</") + tag + ">"),
                  count(svg, std::string("<") + tag + " ") + count(svg, std::string("<") + tag + ">"))
            << tag;
    }
}

TEST(ScatterPlot, HasTitleDescriptionAndNames) {
    const std::string svg = scatterPlot(plotOf({{"fast", "cubes", 2.0, 0.02}, {"quality", "cubes", 9.0, 0.004}}));
    expectSound(svg);
    EXPECT_NE(svg.find("<title>Cost and error</title>"), std::string::npos);
    EXPECT_NE(svg.find("Pareto front: fast (2, 0.02); quality (9, 0.004).</desc>"), std::string::npos);
    EXPECT_NE(svg.find(">ms per frame</text>"), std::string::npos);
    EXPECT_NE(svg.find(">relative MSE</text>"), std::string::npos);
    EXPECT_NE(svg.find(">fast</text>"), std::string::npos);
    EXPECT_EQ(svg.find(">cubes</text>"), std::string::npos);  // one series needs no legend
}

TEST(ScatterPlot, OfNothingSaysSo) {
    for (const ScatterPlot& plot : {ScatterPlot{}, plotOf({{"a", "s", nan, 1.0}, {"b", "s", 1.0, infinity}})}) {
        const std::string svg = scatterPlot(plot);
        expectSound(svg);
        EXPECT_TRUE(markersOf(svg).empty());
        EXPECT_NE(svg.find("no data"), std::string::npos);
    }
}

TEST(ScatterPlot, LeavesOutWhatHasNoPlace) {
    const std::string svg = scatterPlot(plotOf({{"a", "s", 1.0, 1.0},
                                                {"b", "s", nan, 1.0},
                                                {"c", "s", 1.0, infinity},
                                                {"d", "s", 0.0, 1.0},
                                                {"e", "s", -1.0, 1.0},
                                                {"f", "s", 1.0, -1.0}}));
    expectSound(svg);
    EXPECT_EQ(markersOf(svg).size(), 1U);
    EXPECT_NE(svg.find("1 point (5 more have no value that can be drawn)"), std::string::npos);
}

TEST(ScatterPlot, TakesPointsThatAreOneOrEqualOrFarApart) {
    for (const double value : {1.0, 0.0137, 1e-300, 1e300}) {
        const std::string svg = scatterPlot(plotOf({{"only", "s", value, value}}));
        expectSound(svg);
        EXPECT_EQ(markersOf(svg).size(), 1U);
    }
    const std::string equal = scatterPlot(plotOf(std::vector<ScatterPoint>(5, {"same", "s", 3.0, 0.1})));
    expectSound(equal);
    EXPECT_EQ(markersOf(equal).size(), 5U);
    expectSound(scatterPlot(plotOf({{"a", "s", 1e-300, 1e300}, {"b", "s", 1e300, 1e-300}})));
}

TEST(ScatterPlot, PutsLessTimeToTheLeftAndLessErrorLower) {
    std::vector<ScatterPoint> points(20);
    for (int i = 0; i < 20; ++i) {
        points[i] = {std::to_string(i), "s", 0.3 * std::pow(1.7, i), 1e-4 * std::pow(1.9, i)};
    }
    const std::string svg = scatterPlot(plotOf(points));
    expectSound(svg);
    const auto markers = markersOf(svg);
    ASSERT_EQ(markers.size(), points.size());
    for (size_t i = 1; i < markers.size(); ++i) {
        EXPECT_GT(markers[i].x, markers[i - 1].x);
        EXPECT_LT(markers[i].y, markers[i - 1].y);
        // Equal ratios are equal lengths.
        EXPECT_NEAR(markers[i].x - markers[i - 1].x, markers[1].x - markers[0].x, 0.21F);
    }
}

TEST(ScatterPlot, PutsNoErrorAtTheFloorUnderAllOthers) {
    const std::string svg = scatterPlot(plotOf({{"a", "s", 1.0, 1e-9}, {"b", "s", 2.0, 0.0}, {"c", "s", 3.0, 1.0}}));
    expectSound(svg);
    const auto markers = markersOf(svg);
    ASSERT_EQ(markers.size(), 3U);
    EXPECT_GT(markers[1].y, markers[0].y + 10.0F);
    EXPECT_NE(svg.find(">0</text>"), std::string::npos);
    const std::string zeros = scatterPlot(plotOf({{"a", "s", 1.0, 0.0}, {"b", "s", 2.0, 0.0}}));
    expectSound(zeros);
    EXPECT_EQ(markersOf(zeros)[0].y, markersOf(zeros)[1].y);
}

TEST(ScatterPlot, JoinsPointsInTheirOrder) {
    ScatterPlot plot =
        plotOf({{"", "a", 32.0, 0.1}, {"", "a", 128.0, 0.02}, {"a", "a", 2048.0, 0.03}, {"", "b", 32.0, 0.3}});
    plot.joined = true;
    const std::string svg = scatterPlot(plot);
    expectSound(svg);
    const auto markers = markersOf(svg);
    ASSERT_EQ(markers.size(), 4U);
    EXPECT_EQ(count(svg, "class=\"line\""), 1U);  // one point alone has no line
    EXPECT_NE(svg.find(fmt::format("class=\"line\" d=\"M{:.1f} {:.1f}L{:.1f} {:.1f}L{:.1f} {:.1f}\"", markers[0].x,
                                   markers[0].y, markers[1].x, markers[1].y, markers[2].x, markers[2].y)),
              std::string::npos)
        << svg;
    EXPECT_EQ(count(svg, "class=\"label\""), 1U);
    EXPECT_NE(svg.find("<title>a: ms per frame 128, relative MSE 0.02</title>"), std::string::npos) << svg;
    EXPECT_NE(svg.find("a: (32, 0.1); (128, 0.02); (2048, 0.03)"), std::string::npos);
    EXPECT_EQ(svg.find("Pareto"), std::string::npos);
}

TEST(ScatterPlot, DrawsTheFrontThroughWhatIsNotBeaten) {
    const std::string svg = scatterPlot(plotOf(
        {{"fast", "s", 1.0, 1.0}, {"beaten", "s", 3.0, 2.0}, {"middle", "s", 2.0, 0.1}, {"best", "s", 4.0, 0.01}}));
    EXPECT_NE(svg.find("Pareto front: fast (1, 1); middle (2, 0.1); best (4, 0.01)"), std::string::npos);
    EXPECT_TRUE(std::regex_search(svg, std::regex("d=\"M[-0-9.]+ [-0-9.]+H[-0-9.]+V[-0-9.]+H[-0-9.]+V[-0-9.]+\"")));
}

TEST(ScatterPlot, TellsSeriesApartByColourAndShapeAndNamesThem) {
    const std::string svg = scatterPlot(plotOf({{"fast", "cubes", 1.0, 1.0}, {"fast", "cave", 2.0, 0.5}}));
    expectSound(svg);
    EXPECT_NE(svg.find(">cubes</text>"), std::string::npos);
    EXPECT_NE(svg.find(">cave</text>"), std::string::npos);
    static const std::regex marker("class=\"marker\" d=\"([^\"]*)\"[^>]*fill=\"([^\"]*)\"");
    std::sregex_iterator i(svg.begin(), svg.end(), marker);
    const std::string shape = (*i)[1];
    const std::string color = (*i)[2];
    ++i;
    EXPECT_NE(shape, (*i)[1]);
    EXPECT_NE(color, (*i)[2]);
}

TEST(ScatterPlot, EscapesWhateverItIsGiven) {
    const std::string nasty = "<a href=\"x\">&'\x01\xFF</a>";
    const std::string svg = scatterPlot(
        {nasty, nasty, nasty, {{nasty, nasty, 1.0, 1.0}, {"\xE2\x82", "\xC3\xA4", 2.0, 2.0}, {nasty, "", 2.0, 2.0}}});
    expectSound(svg);
    EXPECT_EQ(svg.find("<a"), std::string::npos);
    EXPECT_NE(svg.find("&lt;a href=&quot;x&quot;&gt;&amp;&#39;\\x01\\xff"), std::string::npos);
}

TEST(ScatterPlot, CutsLongLabelsButNotTheirTooltips) {
    std::string name;
    for (int i = 0; i < 100; ++i) {
        name += "ä";
    }
    const std::string svg = scatterPlot(plotOf({{name, "s", 1.0, 1.0}}));
    expectSound(svg);
    EXPECT_NE(svg.find("<title>" + name), std::string::npos);
    EXPECT_EQ(svg.find(name + "</text>"), std::string::npos);
    EXPECT_NE(svg.find("ää…</text>"), std::string::npos);
}

TEST(XmlText, EscapesMarkupAndShowsWhatIsHidden) {
    EXPECT_EQ(xmlText("a ä € 😀"), "a ä € 😀");
    EXPECT_EQ(xmlText("<&>\"'"), "&lt;&amp;&gt;&quot;&#39;");
    EXPECT_EQ(xmlText("\x80\n\xEF\xBF\xBF"), "\\x80 \\uffff");
}

std::vector<std::string> numbersOf(const LogAxis& axis) {
    std::vector<std::string> result;
    for (const AxisTick& tick : axis.ticks()) {
        if (!tick.text.empty()) {
            result.push_back(tick.text);
        }
    }
    return result;
}

TEST(LogAxis, HasRoundNumbersOfARightCount) {
    using Texts = std::vector<std::string>;
    EXPECT_EQ(numbersOf(LogAxis(std::vector{1.0, 45.0}, 0, 100)), (Texts{"1", "2", "5", "10", "20", "50"}));
    EXPECT_EQ(numbersOf(LogAxis(std::vector{0.003}, 0, 100)), (Texts{"0.002", "0.003", "0.005", "0.007"}));
    EXPECT_EQ(numbersOf(LogAxis(std::vector{2e-6, 3.0}, 0, 100)),
              (Texts{"10⁻⁶", "10⁻⁵", "0.0001", "0.001", "0.01", "0.1", "1"}));
    EXPECT_EQ(numbersOf(LogAxis(std::vector{3e7, 3e8}, 0, 100)), (Texts{"5·10⁷", "10⁸", "2·10⁸"}));
    for (int i = 0; i < 450; ++i) {
        const double low = 1e-12 * std::pow(1.13, i);
        for (const double ratio : {1.0, 1.01, 3.0, 20.0, 900.0, 1e5, 1e9, 1e20, 1e60}) {
            const auto numbers = numbersOf(LogAxis(std::vector{low, low * ratio}, 0, 100));
            ASSERT_GE(numbers.size(), 2U) << low << " times " << ratio;
            ASSERT_LE(numbers.size(), 10U) << low << " times " << ratio;
        }
    }
}

TEST(LogAxis, HasItsTicksWhereTheirValuesAre) {
    const LogAxis axis(std::vector{0.5, 700.0}, 50, 650);
    for (const AxisTick& tick : axis.ticks()) {
        EXPECT_TRUE(tick.position >= 50.0 && tick.position <= 650.0);
        if (!tick.text.empty()) {
            EXPECT_NEAR(tick.position, axis.position(std::stod(tick.text)), 1e-9) << tick.text;
        }
    }
    const LogAxis down(std::vector{0.5, 700.0}, 650, 50);
    EXPECT_GT(down.position(1.0), down.position(2.0));
}

void expectApart(const std::vector<LabelPlace>& places, const std::vector<LabelRequest>& requests,
                 const PlotBox& area) {
    for (size_t i = 0; i < places.size(); ++i) {
        const PlotBox& box = places[i].box;
        EXPECT_TRUE(box.left >= area.left && box.right <= area.right && box.top >= area.top &&
                    box.bottom <= area.bottom)
            << i;
        for (size_t j = 0; j < places.size(); ++j) {
            EXPECT_TRUE(i == j || !box.overlaps(places[j].box)) << i << ' ' << j;
            const vec2 p = requests[j].at;
            EXPECT_FALSE(box.overlaps({p.x - 5, p.y - 5, p.x + 5, p.y + 5})) << i << ' ' << j;
        }
    }
}

TEST(PlotLabels, HideNeitherEachOtherNorThePoints) {
    const PlotBox area{60, 50, 740, 390};
    std::vector<LabelRequest> requests(28);
    uint32_t random = 1;
    const auto next = [&random](float range) {
        random = random * 1664525U + 1013904223U;
        return range * static_cast<float>(random >> 8U) / 16777216.0F;
    };
    for (LabelRequest& request : requests) {
        request = {{70 + next(660), 60 + next(320)}, {20 + next(60), 13}};
    }
    expectApart(placeLabels(requests, 5, area, {}), requests, area);
    // All in one place, and all in one corner.
    requests.assign(8, {{400, 200}, {50, 13}});
    expectApart(placeLabels(requests, 5, area, {}), requests, area);
    requests.assign(6, {{735, 385}, {50, 13}});
    expectApart(placeLabels(requests, 5, area, {}), requests, area);
}

TEST(PlotLabels, StandBesideTheirPointWithoutALeaderWhereThereIsRoom) {
    const std::vector<LabelRequest> requests{{{100, 100}, {40, 13}}, {{300, 100}, {40, 13}}};
    const PlotBox area{0, 0, 400, 200};
    for (const LabelPlace& place : placeLabels(requests, 5, area, {})) {
        EXPECT_FALSE(place.leader);
    }
    EXPECT_EQ(placeLabels(requests, 5, area, {})[0].align, 0.0F);
    // A line to the right is crossed unwillingly.
    const std::vector<PlotSegment> line{{{100, 100}, {300, 100}}};
    EXPECT_NE(placeLabels(requests, 5, area, line)[0].box.top, placeLabels(requests, 5, area, {})[0].box.top);
}

}  // namespace
}  // namespace reflet::test::plot_test
