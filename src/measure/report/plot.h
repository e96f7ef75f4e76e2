// Draws a scatter plot as SVG, both axes logarithmic: cost against error with each series' Pareto front, or error over
// frames with joined points.
#pragma once

#include <string>
#include <vector>

namespace reflet {

/// One result. Left out if x is not finite or not positive, or y not finite or negative; y = 0 lies on the axis.
struct ScatterPoint {
    std::string label;   ///< beside the point; a long one is shortened there, and complete in the tooltip; may be empty
    std::string series;  ///< points of a series share colour, shape and Pareto front
    double x = 0.0;      ///< smaller is better
    double y = 0.0;      ///< smaller is better
};

struct ScatterPlot {
    std::string title;
    std::string xLabel;
    std::string yLabel;
    std::vector<ScatterPoint> points;
    bool joined = false;  ///< lines join the points of a series in their order, instead of its Pareto front
};

/// An <svg> element, for a separate file or inside HTML. Text and lines use the page's colour (currentColor); without
/// ids and style sheet, so that a page can hold several. Unless points are joined, the thin step line of a series is
/// its Pareto front: the points that no other point of the series beats in both x and y. Texts may be any bytes.
std::string scatterPlot(const ScatterPlot& plot);

}  // namespace reflet
