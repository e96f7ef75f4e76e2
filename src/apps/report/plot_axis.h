// A logarithmic axis: which range, which ticks, and where a value is.
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
    /// Has room for all `values` (finite, > 0; there may be none) between the positions `start` and `end`, and for a
    /// factor of 5 at the least.
    LogAxis(std::span<const double> values, double start, double end);

    /// Of a finite value > 0. Grows from `start` to `end` with the value.
    [[nodiscard]] double position(double value) const;
    /// From low to high; at least two of them with a number.
    [[nodiscard]] std::vector<AxisTick> ticks() const;

private:
    [[nodiscard]] double positionOfLog(double log) const;

    double low_ = 0.0;  ///< decimal logarithms of the ends
    double high_ = 0.0;
    double start_;
    double end_;
};

}  // namespace reflet
