// Groups a scatter plot's points into series, and finds each series' Pareto front.
#pragma once

#include "measure/report/plot.h"

#include <string>
#include <vector>

namespace reflet {

struct PlotSeries {
    std::string name;
    std::vector<size_t> points;  ///< indices
};

/// Whether the point can be drawn on logarithmic axes; y = 0 can.
bool drawable(const ScatterPoint& point);

/// The series, in the order of their first points.
std::vector<PlotSeries> seriesOf(const std::vector<ScatterPoint>& points);

/// The Pareto front: the points of the series that no other one dominates, sorted by x with falling y. Of equal points
/// only the first.
std::vector<size_t> frontOf(const PlotSeries& series, const std::vector<ScatterPoint>& points);

}  // namespace reflet
