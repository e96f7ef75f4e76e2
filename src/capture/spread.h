// Statistics of repeated measurements: median and spread.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include <cstddef>
#include <span>

namespace reflet {

/// Quartiles between two values are interpolated linearly, as is the median of an even number of values.
struct Spread {
    size_t count = 0;
    double median = 0.0;
    double lowerQuartile = 0.0;
    double upperQuartile = 0.0;
    double min = 0.0;
    double max = 0.0;
};

/// All 0 without values.
Spread spreadOf(std::span<const double> values);

/// { "median", "lower_quartile", "upper_quartile", "min", "max", "count" }
nlohmann::ordered_json spreadJson(const Spread& spread);

}  // namespace reflet
