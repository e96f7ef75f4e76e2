// Computes medians and quartiles.
#include "capture/spread.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <vector>

namespace reflet {

Spread spreadOf(std::span<const double> values) {
    if (values.empty()) {
        return {};
    }
    std::vector<double> sorted(values.begin(), values.end());
    std::ranges::sort(sorted);
    const auto at = [&](double share) {
        const double place = share * static_cast<double>(sorted.size() - 1);
        const auto below = static_cast<size_t>(place);
        const size_t above = std::min(below + 1, sorted.size() - 1);
        return std::lerp(sorted[below], sorted[above], place - static_cast<double>(below));
    };
    return {sorted.size(), at(0.5), at(0.25), at(0.75), sorted.front(), sorted.back()};
}

nlohmann::ordered_json spreadJson(const Spread& spread) {
    return {{"median", spread.median},
            {"lower_quartile", spread.lowerQuartile},
            {"upper_quartile", spread.upperQuartile},
            {"min", spread.min},
            {"max", spread.max},
            {"count", spread.count}};
}

}  // namespace reflet
