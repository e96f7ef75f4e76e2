// Greedy placement: starting with the most crowded point, each label takes the cheapest position on rings around its
// point.
#include "measure/report/plot_labels.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

namespace reflet {
namespace {

constexpr float gap = 4.0F;        // from a marker to its label
constexpr float ringStep = 13.0F;  // about a line of text
constexpr int rings = 12;
constexpr float crowd = 70.0F;  // points closer than this count as crowded

// Relative costs of what a position violates.
constexpr float outsideCost = 1000.0F;
constexpr float hidesLabelCost = 300.0F;
constexpr float hidesMarkerCost = 200.0F;
constexpr float leaderThroughCost = 60.0F;  // a leader line that crosses a label, or a label on a leader line
constexpr float ringCost = 4.0F;
constexpr float leaderOverMarkerCost = 30.0F;
constexpr float onLineCost = 3.0F;
constexpr float directionCost = 0.2F;

// Clips the segment against the box (Liang and Barsky, 1984).
bool crosses(const PlotSegment& s, const PlotBox& box) {
    const vec2 d = s.to - s.from;
    const std::array<float, 4> along{-d.x, d.x, -d.y, d.y};
    const std::array<float, 4> room{s.from.x - box.left, box.right - s.from.x, s.from.y - box.top,
                                    box.bottom - s.from.y};
    float first = 0.0F;
    float last = 1.0F;
    for (size_t i = 0; i < 4; ++i) {
        if (along.at(i) == 0.0F) {
            if (room.at(i) < 0.0F) {
                return false;
            }
        } else if (along.at(i) < 0.0F) {
            first = std::max(first, room.at(i) / along.at(i));
        } else {
            last = std::min(last, room.at(i) / along.at(i));
        }
    }
    return first <= last;
}

PlotBox around(const vec2& at, float radius) {
    return {at.x - radius, at.y - radius, at.x + radius, at.y + radius};
}

/// Directions in sixteenths of a turn, best first: right and its diagonals, left and its diagonals, up, down, the rest.
constexpr std::array<int, 16> directions{0, 14, 2, 8, 10, 6, 12, 4, 15, 1, 9, 7, 13, 11, 3, 5};

LabelPlace placeAt(const LabelRequest& request, float markerRadius, int ring, int direction) {
    const float angle = static_cast<float>(direction) * glm::pi<float>() / 8.0F;
    const vec2 way(std::cos(angle), std::sin(angle));
    const vec2 edge = request.at + way * markerRadius;
    const vec2 p = edge + way * (gap + ringStep * static_cast<float>(ring));
    LabelPlace place;
    place.align = way.x > 0.3F ? 0.0F : way.x < -0.3F ? 1.0F : 0.5F;
    const float rise = way.y > 0.3F ? 0.0F : way.y < -0.3F ? 1.0F : 0.5F;
    place.box.left = p.x - place.align * request.size.x;
    place.box.top = p.y - rise * request.size.y;
    place.box.right = place.box.left + request.size.x;
    place.box.bottom = place.box.top + request.size.y;
    if (ring > 0) {
        place.leader = PlotSegment{edge, p};
    }
    return place;
}

class Placer {
public:
    Placer(std::span<const LabelRequest> requests, float markerRadius, const PlotBox& area,
           std::span<const PlotSegment> lines)
        : requests_(requests), markerRadius_(markerRadius), area_(area), lines_(lines) {}

    /// The cheapest position for a label, given those already placed.
    LabelPlace place(size_t index) {
        LabelPlace best;
        float bestCost = std::numeric_limits<float>::max();
        for (int ring = 0; ring < rings; ++ring) {
            for (size_t i = 0; i < directions.size(); ++i) {
                const LabelPlace candidate = placeAt(requests_[index], markerRadius_, ring, directions.at(i));
                const float cost = costOf(candidate, index) + ringCost * static_cast<float>(ring) +
                                   directionCost * static_cast<float>(i);
                if (cost < bestCost) {
                    best = candidate;
                    bestCost = cost;
                }
            }
        }
        placed_.push_back(best);
        return best;
    }

private:
    [[nodiscard]] float costOf(const LabelPlace& candidate, size_t index) const {
        const PlotBox& box = candidate.box;
        const bool inside =
            box.left >= area_.left && box.right <= area_.right && box.top >= area_.top && box.bottom <= area_.bottom;
        float cost = inside ? 0.0F : outsideCost;
        for (size_t i = 0; i < requests_.size(); ++i) {
            const PlotBox marker = around(requests_[i].at, markerRadius_ + 1.0F);
            cost += box.overlaps(marker) ? hidesMarkerCost : 0.0F;
            cost += i != index && candidate.leader && crosses(*candidate.leader, marker) ? leaderOverMarkerCost : 0.0F;
        }
        for (const LabelPlace& other : placed_) {
            cost += box.overlaps(other.box) ? hidesLabelCost : 0.0F;
            cost += candidate.leader && crosses(*candidate.leader, other.box) ? leaderThroughCost : 0.0F;
            cost += other.leader && crosses(*other.leader, box) ? leaderThroughCost : 0.0F;
        }
        return cost + onLineCost * static_cast<float>(std::ranges::count_if(
                                       lines_, [&](const PlotSegment& line) { return crosses(line, box); }));
    }

    std::span<const LabelRequest> requests_;
    float markerRadius_;
    PlotBox area_;
    std::span<const PlotSegment> lines_;
    std::vector<LabelPlace> placed_;
};

}  // namespace

std::vector<LabelPlace> placeLabels(std::span<const LabelRequest> requests, float markerRadius, const PlotBox& area,
                                    std::span<const PlotSegment> lines) {
    std::vector<size_t> order(requests.size());
    std::iota(order.begin(), order.end(), size_t{0});
    const auto neighbours = [&](size_t index) {
        return std::ranges::count_if(
            requests, [&](const LabelRequest& other) { return glm::distance(other.at, requests[index].at) < crowd; });
    };
    std::ranges::stable_sort(order, std::greater{}, neighbours);
    std::vector<LabelPlace> places(requests.size());
    Placer placer(requests, markerRadius, area, lines);
    for (const size_t index : order) {
        places[index] = placer.place(index);
    }
    return places;
}

}  // namespace reflet
