// Places the labels of points so that they overlap neither each other nor the points.
#pragma once

#include "base/math.h"

#include <optional>
#include <span>
#include <vector>

namespace reflet {

/// Y points down.
struct PlotBox {
    float left = 0.0F;
    float top = 0.0F;
    float right = 0.0F;
    float bottom = 0.0F;

    [[nodiscard]] bool overlaps(const PlotBox& other) const {
        return left < other.right && other.left < right && top < other.bottom && other.top < bottom;
    }
};

struct PlotSegment {
    vec2 from{0.0F};
    vec2 to{0.0F};
};

/// A point of the plot and the size of its label.
struct LabelRequest {
    vec2 at{0.0F};
    vec2 size{0.0F};
};

struct LabelPlace {
    PlotBox box;
    float align = 0.0F;  ///< which part of the text is at the point: 0 its start, 0.5 its middle, 1 its end
    std::optional<PlotSegment> leader;  ///< line from point to label, if they are far apart
};

/// A position for each request, in the same order, outside the markers (circles of `markerRadius` around the points).
/// Inside `area` if the label fits; crosses `lines` only if there is no better position. Deterministic.
std::vector<LabelPlace> placeLabels(std::span<const LabelRequest> requests, float markerRadius, const PlotBox& area,
                                    std::span<const PlotSegment> lines);

}  // namespace reflet
