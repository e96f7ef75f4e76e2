// A scatter plot as SVG: cost against error, both logarithmic, with each series' Pareto front.
#pragma once

#include <string>
#include <vector>

namespace reflet {

/// One result. Left out where x is not finite or not positive, or y not finite or negative; y = 0 stands on the axis.
struct ScatterPoint {
    std::string label;   ///< beside the point; a long one is cut, and whole in the tooltip
    std::string series;  ///< points of one series have one colour and shape, and a front of their own
    double x = 0.0;      ///< less is better
    double y = 0.0;      ///< less is better
};

struct ScatterPlot {
    std::string title;
    std::string xLabel;
    std::string yLabel;
    std::vector<ScatterPoint> points;
};

/// An <svg> element, for a file of its own or inside HTML. Text and lines take the page's colour (currentColor); no
/// ids and no style sheet, so that several fit into one page. The thin step line of a series runs through the points
/// that no other point of the series beats in both x and y. Texts may be any bytes.
std::string scatterPlot(const ScatterPlot& plot);

}  // namespace reflet
