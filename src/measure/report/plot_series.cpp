// Groups a scatter plot's points into series.
#include "measure/report/plot_series.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

namespace reflet {

bool drawable(const ScatterPoint& point) {
    return std::isfinite(point.x) && point.x > 0.0 && std::isfinite(point.y) && point.y >= 0.0;
}

std::vector<PlotSeries> seriesOf(const std::vector<ScatterPoint>& points) {
    std::vector<PlotSeries> all;
    for (size_t i = 0; i < points.size(); ++i) {
        auto found = std::ranges::find(all, points[i].series, &PlotSeries::name);
        if (found == all.end()) {
            all.push_back({points[i].series, {}});
            found = std::prev(all.end());
        }
        found->points.push_back(i);
    }
    return all;
}

std::vector<size_t> frontOf(const PlotSeries& series, const std::vector<ScatterPoint>& points) {
    std::vector<size_t> order = series.points;
    std::ranges::stable_sort(order, {}, [&](size_t i) { return std::pair(points[i].x, points[i].y); });
    std::vector<size_t> front;
    for (const size_t i : order) {
        if (front.empty() || points[i].y < points[front.back()].y) {
            front.push_back(i);
        }
    }
    return front;
}

}  // namespace reflet
