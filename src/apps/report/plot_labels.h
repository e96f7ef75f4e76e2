// Places for the labels of points, so that they hide neither each other nor the points.
#pragma once

#include "base/math.h"

#include <optional>
#include <span>
#include <vector>

namespace reflet {

/// Y runs down.
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
struct LabelWish {
    vec2 at{0.0F};
    vec2 size{0.0F};
};

struct LabelPlace {
    PlotBox box;
    float align = 0.0F;                 ///< the text's side toward the point: 0 its start, 0.5 its middle, 1 its end
    std::optional<PlotSegment> leader;  ///< from point to label, where they are apart
};

/// A place for each wish, in their order, beside the markers (circles of `markerRadius` around the points). Inside of
/// `area` wherever a label is small enough for that; crosses `lines` where there is no better place. The same wishes
/// give the same places.
std::vector<LabelPlace> placeLabels(std::span<const LabelWish> wishes, float markerRadius, const PlotBox& area,
                                    std::span<const PlotSegment> lines);

}  // namespace reflet
