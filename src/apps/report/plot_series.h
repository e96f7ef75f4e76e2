// What a scatter plot's points are: which can be drawn, which belong together, which are not beaten.
#pragma once

#include "apps/report/plot.h"

#include <string>
#include <vector>

namespace reflet {

struct PlotSeries {
    std::string name;
    std::vector<size_t> points;  ///< indices
};

/// Whether it has a place on logarithmic axes, 0 on the y axis included.
bool drawable(const ScatterPoint& point);

/// In the order in which they first come.
std::vector<PlotSeries> seriesOf(const std::vector<ScatterPoint>& points);

/// The points of the series that no other one of it beats, by x: each is lower than all before. Of equal ones the
/// first.
std::vector<size_t> frontOf(const PlotSeries& series, const std::vector<ScatterPoint>& points);

}  // namespace reflet
