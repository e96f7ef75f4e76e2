// A logarithmic axis: its range, its ticks, and the position of a value.
#pragma once

#include <span>
#include <string>
#include <vector>

namespace reflet {

struct AxisTick {
    double position = 0.0;
    std::string text;  ///< empty: a tick without a number
};

class LogAxis {
public:
    /// Covers all `values` (finite, > 0; may be empty) between the positions `start` and `end`, and at least a factor
    /// of 5.
    LogAxis(std::span<const double> values, double start, double end);

    /// Position of a finite value > 0, from `start` to `end`.
    [[nodiscard]] double position(double value) const;
    /// Ticks from low to high; at least two have a number.
    [[nodiscard]] std::vector<AxisTick> ticks() const;

private:
    [[nodiscard]] double positionOfLog(double log) const;

    double low_ = 0.0;  ///< decimal logarithms of the ends
    double high_ = 0.0;
    double start_;
    double end_;
};

}  // namespace reflet
