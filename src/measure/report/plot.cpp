// Draws the scatter plot: header, axes, fronts or lines, markers, labels. Units are those of the viewBox, about a
// pixel.
#include "measure/report/plot.h"

#include "measure/report/plot_axis.h"
#include "measure/report/plot_labels.h"
#include "measure/report/plot_series.h"
#include "measure/report/plot_text.h"
#include "measure/report/xml_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <string_view>

namespace reflet {
namespace {

constexpr float width = 760.0F;
constexpr float headLeft = 8.0F;
constexpr float plotLeft = 64.0F;
constexpr float plotRight = width - 20.0F;
constexpr float plotHeight = 340.0F;
constexpr float footerHeight = 52.0F;  // under the plot: numbers and the x axis's name
constexpr float row = 22.0F;           // of the header
constexpr float floorRoom = 26.0F;     // between the y axis's lowest positive value and 0
constexpr float markerRadius = 5.0F;
constexpr float textHeight = 13.0F;
constexpr size_t longestName = 80;  // of the plot and of an axis

// Contrast of at least 3:1 against both white and black backgrounds.
constexpr std::array<std::string_view, 8> colors{"#3b7dd8", "#d95f02", "#1b9e77", "#c2559c",
                                                 "#a6761d", "#8a63d2", "#808080", "#d64550"};
// Centred at (0, 0), with about the same area.
constexpr std::array<std::string_view, 8> shapes{
    "M-4.6 0a4.6 4.6 0 1 0 9.2 0a4.6 4.6 0 1 0 -9.2 0z",
    "M-4.1 -4.1h8.2v8.2h-8.2z",
    "M0 -5.6L5.4 4H-5.4z",
    "M0 -5.8L5.8 0L0 5.8L-5.8 0z",
    "M0 5.6L5.4 -4H-5.4z",
    "M-1.7 -5.2h3.4v3.5h3.5v3.4h-3.5v3.5h-3.4v-3.5h-3.5v-3.4h3.5z",
    "M-5.4 0L-2.7 -4.7H2.7L5.4 0L2.7 4.7H-2.7z",
    "M0 -6L1.6 -1.9L6 -1.7L2.6 1.1L3.7 5.4L0 3L-3.7 5.4L-2.6 1.1L-6 -1.7L-1.6 -1.9z"};

std::string labelOf(std::string_view text) {
    return shortened(text, 26);
}

/// Counts, such as frames, in full.
std::string xText(double value) {
    constexpr double largestCount = 1e6;
    return value <= largestCount && value == std::floor(value) ? fmt::format("{:.0f}", value)
                                                               : fmt::format("{:.3g}", value);
}

class Drawing {
public:
    explicit Drawing(const ScatterPlot& plot);
    std::string draw();

private:
    template <class... Args>
    void add(fmt::format_string<Args...> format, Args&&... args) {
        fmt::format_to(std::back_inserter(svg_), format, std::forward<Args>(args)...);
    }
    static float layoutLegend(const std::vector<PlotSeries>& series, float top, std::vector<vec2>& places);
    [[nodiscard]] std::string description() const;
    [[nodiscard]] std::string valuesText(const ScatterPoint& point) const;
    void addHeader();
    void addAxes();
    void addJoints();
    void addFronts();
    void addPoint(size_t index, size_t series, const LabelPlace& place);
    void addPoints();

    const ScatterPlot& plot_;
    std::vector<ScatterPoint> points_;  ///< those that can be drawn
    std::vector<PlotSeries> series_;
    std::vector<vec2> legend_;  ///< position of each series' entry; empty for one series
    PlotBox area_;
    bool hasZero_ = false;
    LogAxis x_{{}, 0.0, 1.0};
    LogAxis y_{{}, 0.0, 1.0};
    std::vector<vec2> positions_;
    std::vector<PlotSegment> lines_;
    std::string svg_;
};

Drawing::Drawing(const ScatterPlot& plot) : plot_(plot) {
    std::ranges::copy_if(plot.points, std::back_inserter(points_), drawable);
    series_ = seriesOf(points_);
    float top = plot.title.empty() ? 0.0F : row + 4.0F;
    if (series_.size() > 1) {
        top = layoutLegend(series_, top, legend_);
    }
    top += row + 4.0F;  // the y axis's name
    area_ = {plotLeft, top, plotRight, top + plotHeight};
    std::vector<double> xs;
    std::vector<double> ys;
    for (const ScatterPoint& p : points_) {
        xs.push_back(p.x);
        if (p.y > 0.0) {
            ys.push_back(p.y);
        }
    }
    hasZero_ = ys.size() < points_.size();
    x_ = LogAxis(xs, area_.left, area_.right);
    y_ = LogAxis(ys, area_.bottom - (hasZero_ ? floorRoom : 0.0F), area_.top);
    for (const ScatterPoint& p : points_) {
        positions_.emplace_back(x_.position(p.x), p.y > 0.0 ? y_.position(p.y) : double{area_.bottom});
    }
}

/// Lays entries out in rows from `top` down; returns the bottom.
float Drawing::layoutLegend(const std::vector<PlotSeries>& series, float top, std::vector<vec2>& places) {
    vec2 at(headLeft, top + 0.5F * row);
    for (const PlotSeries& s : series) {
        const float needed = 32.0F + textWidth(labelOf(s.name));
        if (at.x > headLeft && at.x + needed > plotRight) {
            at = {headLeft, at.y + row};
        }
        places.push_back(at);
        at.x += needed;
    }
    return at.y + 0.5F * row;
}

std::string Drawing::valuesText(const ScatterPoint& point) const {
    std::string name = series_.size() > 1 || point.label.empty() ? point.series : point.label;
    if (series_.size() > 1 && !point.label.empty()) {
        name = fmt::format("{}, {}", point.label, point.series);
    }
    return fmt::format("{}: {} {}, {} {:.3g}", name, plot_.xLabel, xText(point.x), plot_.yLabel, point.y);
}

/// Text alternative for screen readers.
std::string Drawing::description() const {
    std::string text = fmt::format("{} with logarithmic axes: {} across, {} up; less is better. {} point{}",
                                   plot_.joined ? "Line plot" : "Scatter plot", plot_.xLabel, plot_.yLabel,
                                   points_.size(), points_.size() == 1 ? "" : "s");
    if (points_.size() < plot_.points.size()) {
        text += fmt::format(" ({} more have no value that can be drawn)", plot_.points.size() - points_.size());
    }
    for (const PlotSeries& series : series_) {
        std::vector<std::string> members;
        if (plot_.joined) {
            for (const size_t i : series.points) {
                members.push_back(fmt::format("({}, {:.3g})", xText(points_[i].x), points_[i].y));
            }
            text += fmt::format(". {}: {}", series.name, fmt::join(members, "; "));
            continue;
        }
        for (const size_t i : frontOf(series, points_)) {
            members.push_back(fmt::format("{} ({:.3g}, {:.3g})", points_[i].label, points_[i].x, points_[i].y));
        }
        text += fmt::format(". {}{}Pareto front: {}", series.name, series.name.empty() ? "" : ", ",
                            fmt::join(members, "; "));
    }
    return text + ".";
}

void Drawing::addHeader() {
    if (!plot_.title.empty()) {
        add("<text x=\"{:.1f}\" y=\"16\" font-size=\"15\" font-weight=\"600\">{}</text>\n", headLeft,
            xmlText(shortened(plot_.title, longestName)));
    }
    for (size_t i = 0; i < legend_.size(); ++i) {
        add("<path d=\"{}\" transform=\"translate({:.1f},{:.1f})\" fill=\"{}\"/>", shapes.at(i % shapes.size()),
            legend_[i].x + markerRadius, legend_[i].y, colors.at(i % colors.size()));
        add("<text x=\"{:.1f}\" y=\"{:.1f}\">{}</text>\n", legend_[i].x + 16.0F, legend_[i].y + 4.0F,
            xmlText(labelOf(series_[i].name)));
    }
    add("<text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"middle\">{}</text>\n", 0.5F * (area_.left + area_.right),
        area_.bottom + 44.0F, xmlText(shortened(plot_.xLabel, longestName)));
    add("<text x=\"{:.1f}\" y=\"{:.1f}\">{}</text>\n", headLeft, area_.top - 11.0F,
        xmlText(shortened(plot_.yLabel, longestName)));
}

void Drawing::addAxes() {
    std::string grid;
    std::string marks;
    std::vector<AxisTick> yTicks = y_.ticks();
    if (hasZero_) {
        yTicks.push_back({area_.bottom, "0"});
    }
    for (const AxisTick& t : yTicks) {
        if (t.text.empty()) {
            marks += fmt::format("M{:.1f} {:.1f}h4", area_.left, t.position);
            continue;
        }
        grid += fmt::format("M{:.1f} {:.1f}H{:.1f}", area_.left, t.position, area_.right);
        add(R"(<text x="{:.1f}" y="{:.1f}" text-anchor="end">{}</text>)", area_.left - 8.0F, t.position + 4.0, t.text);
    }
    for (const AxisTick& t : x_.ticks()) {
        if (t.text.empty()) {
            marks += fmt::format("M{:.1f} {:.1f}v-4", t.position, area_.bottom);
            continue;
        }
        grid += fmt::format("M{:.1f} {:.1f}V{:.1f}", t.position, area_.bottom, area_.top);
        add(R"(<text x="{:.1f}" y="{:.1f}" text-anchor="middle">{}</text>)", t.position, area_.bottom + 18.0F, t.text);
    }
    add("\n<path d=\"{}\" stroke=\"currentColor\" stroke-opacity=\"0.13\" fill=\"none\"/>\n", grid);
    add("<path d=\"{}\" stroke=\"currentColor\" stroke-opacity=\"0.45\" fill=\"none\"/>\n", marks);
    // Dashed where the y axis skips the range between its lowest value and 0.
    const float bend = hasZero_ ? area_.bottom - floorRoom : area_.bottom;
    add("<path d=\"M{0:.1f} {1:.1f}V{2:.1f}M{0:.1f} {3:.1f}H{4:.1f}\" stroke=\"currentColor\" stroke-opacity=\"0.6\" "
        "fill=\"none\"/>\n",
        area_.left, area_.top, bend, area_.bottom, area_.right);
    add("<path d=\"M{0:.1f} {1:.1f}V{2:.1f}\" stroke=\"currentColor\" stroke-opacity=\"0.6\" stroke-dasharray=\"2 3\" "
        "fill=\"none\"/>\n",
        area_.left, bend, area_.bottom);
}

void Drawing::addJoints() {
    for (size_t s = 0; s < series_.size(); ++s) {
        const std::vector<size_t>& points = series_[s].points;
        std::string path = fmt::format("M{:.1f} {:.1f}", positions_[points[0]].x, positions_[points[0]].y);
        for (size_t i = 1; i < points.size(); ++i) {
            path += fmt::format("L{:.1f} {:.1f}", positions_[points[i]].x, positions_[points[i]].y);
            lines_.push_back({positions_[points[i - 1]], positions_[points[i]]});
        }
        if (points.size() > 1) {
            add("<path class=\"line\" d=\"{}\" stroke=\"{}\" stroke-opacity=\"0.75\" fill=\"none\"/>\n", path,
                colors.at(s % colors.size()));
        }
    }
}

void Drawing::addFronts() {
    for (size_t s = 0; s < series_.size(); ++s) {
        const std::vector<size_t> front = frontOf(series_[s], points_);
        std::string path = fmt::format("M{:.1f} {:.1f}", positions_[front[0]].x, positions_[front[0]].y);
        for (size_t i = 1; i < front.size(); ++i) {
            const vec2 from = positions_[front[i - 1]];
            const vec2 to = positions_[front[i]];
            path += fmt::format("H{:.1f}V{:.1f}", to.x, to.y);
            lines_.push_back({from, {to.x, from.y}});
            lines_.push_back({{to.x, from.y}, to});
        }
        if (front.size() > 1) {
            add("<path d=\"{}\" stroke=\"{}\" stroke-opacity=\"0.75\" fill=\"none\"/>\n", path,
                colors.at(s % colors.size()));
        }
    }
}

void Drawing::addPoint(size_t index, size_t series, const LabelPlace& place) {
    const std::string_view color = colors.at(series % colors.size());
    const PlotBox& box = place.box;
    add("<g><title>{}</title>", xmlText(valuesText(points_[index])));
    const bool labelled = !points_[index].label.empty();
    if (labelled && place.leader) {
        add("<path d=\"M{:.1f} {:.1f}L{:.1f} {:.1f}\" stroke=\"currentColor\" stroke-opacity=\"0.5\" "
            "stroke-width=\"0.8\"/>",
            place.leader->from.x, place.leader->from.y, place.leader->to.x, place.leader->to.y);
    }
    add("<path class=\"marker\" d=\"{}\" transform=\"translate({:.1f},{:.1f})\" fill=\"{}\"/>",
        shapes.at(series % shapes.size()), positions_[index].x, positions_[index].y, color);
    if (labelled) {
        const char* anchor = place.align == 0.0F ? "start" : place.align == 1.0F ? "end" : "middle";
        add("<text class=\"label\" x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"{}\">{}</text>",
            glm::mix(box.left, box.right, place.align), box.bottom - 3.0F, anchor,
            xmlText(labelOf(points_[index].label)));
    }
    add("</g>\n");
}

void Drawing::addPoints() {
    std::vector<LabelRequest> requests;
    for (size_t i = 0; i < points_.size(); ++i) {
        requests.push_back({positions_[i], {textWidth(labelOf(points_[i].label)), textHeight}});
    }
    PlotBox area = area_;
    area.left += 4.0F;
    const std::vector<LabelPlace> places = placeLabels(requests, markerRadius, area, lines_);
    for (size_t s = 0; s < series_.size(); ++s) {
        for (const size_t index : series_[s].points) {
            addPoint(index, s, places[index]);
        }
    }
    if (points_.empty()) {
        add("<text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"middle\">no data</text>\n",
            0.5F * (area_.left + area_.right), 0.5F * (area_.top + area_.bottom));
    }
}

std::string Drawing::draw() {
    const float height = area_.bottom + footerHeight;
    add("<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {:.0f} {:.0f}\" width=\"{:.0f}\" height=\"{:.0f}\" "
        "style=\"max-width:100%;height:auto\" role=\"img\" fill=\"currentColor\" font-size=\"12\" "
        "font-family=\"system-ui, 'Segoe UI', 'Liberation Sans', sans-serif\">\n",
        width, height, width, height);
    add("<title>{}</title>\n<desc>{}</desc>\n", xmlText(plot_.title.empty() ? "Scatter plot" : plot_.title),
        xmlText(description()));
    addHeader();
    addAxes();
    if (plot_.joined) {
        addJoints();
    } else {
        addFronts();
    }
    addPoints();
    return svg_ + "</svg>\n";
}

}  // namespace

std::string scatterPlot(const ScatterPlot& plot) {
    return Drawing(plot).draw();
}

}  // namespace reflet
