// Draws values over frames. Units are those of the viewBox, about a pixel.
#include "measure/report/frame_plot.h"

#include "measure/report/plot_text.h"
#include "measure/report/xml_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>

namespace reflet {
namespace {

constexpr double width = 760.0;
constexpr double left = 72.0;
constexpr double right = width - 20.0;
constexpr double panelHeight = 96.0;
constexpr double panelGap = 40.0;  // with the next panel's name in it
constexpr double head = 34.0;
constexpr double foot = 46.0;
constexpr size_t longestTitle = 90;
constexpr const char* color = "#3b7dd8";  // contrast of at least 3:1 against both white and black
constexpr const char* markColor = "#d95f02";

/// The largest of 1, 2, 5 times a power of ten that gives at least `count` steps over the range.
double stepOf(double range, double count) {
    const double rough = range / count;
    const double power = std::pow(10.0, std::floor(std::log10(rough)));
    const double digit = rough / power;
    return power * (digit >= 5.0 ? 5.0 : digit >= 2.0 ? 2.0 : 1.0);
}

class Axis {
public:
    Axis(double low, double high, double start, double end) : low_(low), high_(high), start_(start), end_(end) {
        if (!(high_ > low_)) {
            const double margin = std::max(std::abs(low_) * 0.1, 1e-6);
            low_ -= margin;
            high_ += margin;
        }
    }

    [[nodiscard]] double position(double value) const {
        return start_ + (value - low_) / (high_ - low_) * (end_ - start_);
    }
    [[nodiscard]] std::vector<double> ticks(double count, double least) const {
        const double step = std::max(stepOf(high_ - low_, count), least);
        std::vector<double> all;
        for (double i = std::ceil(low_ / step - 1e-9); i * step <= high_ + 1e-9 * step; ++i) {
            all.push_back(i * step + 0.0);  // without -0
        }
        return all;
    }

private:
    double low_;
    double high_;
    double start_;
    double end_;
};

Axis verticalAxis(const std::vector<double>& values, double top) {
    double low = INFINITY;
    double high = -INFINITY;
    for (const double value : values) {
        if (std::isfinite(value)) {
            low = std::min(low, value);
            high = std::max(high, value);
        }
    }
    if (!(low <= high)) {
        low = high = 0.0;
    }
    if (low > 0.0 && low < 0.7 * high) {
        low = 0.0;
    } else if (high < 0.0 && high > 0.7 * low) {
        high = 0.0;
    }
    return {low, high, top + panelHeight, top};
}

std::string numberText(double value) {
    return fmt::format("{:.3g}", value);
}

class Drawing {
public:
    explicit Drawing(const FramePlot& plot)
        : plot_(plot),
          x_(plot.frames.empty() ? 0.0 : plot.frames.front(), plot.frames.empty() ? 0.0 : plot.frames.back(), left,
             right) {}

    std::string draw() {
        const double height = head + static_cast<double>(plot_.curves.size()) * (panelHeight + panelGap) - panelGap +
                              panelGap * 0.5 + foot;
        add("<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {0:.0f} {1:.0f}\" width=\"{0:.0f}\" "
            "height=\"{1:.0f}\" style=\"max-width:100%;height:auto\" role=\"img\" fill=\"currentColor\" "
            "font-size=\"12\" font-family=\"system-ui, 'Segoe UI', 'Liberation Sans', sans-serif\">\n",
            width, height);
        add("<title>{}</title>\n<text x=\"8\" y=\"18\" font-size=\"15\" font-weight=\"600\">{}</text>\n",
            xmlText(plot_.title), xmlText(shortened(plot_.title, longestTitle)));
        double top = head + panelGap * 0.5;
        for (const FrameCurve& curve : plot_.curves) {
            addPanel(curve, top);
            top += panelHeight + panelGap;
        }
        add("<text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"middle\">frame</text>\n", 0.5 * (left + right),
            height - 8.0);
        return svg_ + "</svg>\n";
    }

private:
    template <class... Args>
    void add(fmt::format_string<Args...> format, Args&&... args) {
        fmt::format_to(std::back_inserter(svg_), format, std::forward<Args>(args)...);
    }

    void addPanel(const FrameCurve& curve, double top) {
        const Axis y = verticalAxis(curve.values, top);
        const double bottom = top + panelHeight;
        add("<text x=\"8\" y=\"{:.1f}\" font-weight=\"600\">{}{}</text>\n", top - 8.0, xmlText(curve.name),
            curve.unit.empty() ? "" : xmlText(" [" + curve.unit + "]"));
        std::string grid;
        for (const double value : y.ticks(3.0, 0.0)) {
            grid += fmt::format("M{:.1f} {:.1f}H{:.1f}", left, y.position(value), right);
            add("<text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"end\">{}</text>", left - 8.0, y.position(value) + 4.0,
                numberText(value));
        }
        for (const double frame : x_.ticks(8.0, 1.0)) {
            grid += fmt::format("M{:.1f} {:.1f}V{:.1f}", x_.position(frame), bottom, top);
            add("<text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"middle\">{:.0f}</text>", x_.position(frame),
                bottom + 16.0, frame);
        }
        add("\n<path d=\"{}\" stroke=\"currentColor\" stroke-opacity=\"0.13\" fill=\"none\"/>\n", grid);
        addCurve(curve, y);
    }

    void addCurve(const FrameCurve& curve, const Axis& y) {
        std::string line;
        bool begun = false;
        for (size_t i = 0; i < curve.values.size(); ++i) {
            if (!std::isfinite(curve.values[i])) {
                begun = false;
                continue;
            }
            // Of zero length at first: with round ends, a value between two gaps is a dot.
            line += fmt::format("{}{:.1f} {:.1f}{}", begun ? "L" : "M", x_.position(plot_.frames[i]),
                                y.position(curve.values[i]), begun ? "" : "h0");
            begun = true;
        }
        if (line.empty()) {
            return;
        }
        add("<path class=\"curve\" d=\"{}\" stroke=\"{}\" stroke-width=\"1.5\" stroke-linecap=\"round\" "
            "stroke-linejoin=\"round\" fill=\"none\"/>\n",
            line, color);
        if (curve.marked && std::isfinite(curve.values[*curve.marked])) {
            const double at = x_.position(plot_.frames[*curve.marked]);
            const double value = curve.values[*curve.marked];
            const bool before = at > 0.5 * (left + right);
            add("<circle class=\"worst\" cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"4\" fill=\"{}\"/>", at, y.position(value),
                markColor);
            add("<text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"{}\">{} in frame {}</text>\n",
                at + (before ? -8.0 : 8.0), y.position(value) + 4.0, before ? "end" : "start", numberText(value),
                plot_.frames[*curve.marked]);
        }
    }

    const FramePlot& plot_;
    Axis x_;
    std::string svg_;
};

}  // namespace

std::string framePlot(const FramePlot& plot) {
    return Drawing(plot).draw();
}

}  // namespace reflet
