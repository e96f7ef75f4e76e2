// Computes range and ticks of a logarithmic axis.
#include "measure/report/plot_axis.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string_view>

namespace reflet {
namespace {

constexpr double leastDecades = 0.75;  // the shortest range that always contains two of the numbers 1, 2, 5

std::string superscript(int number) {
    static constexpr std::string_view digits[] = {"⁰", "¹", "²", "³", "⁴", "⁵", "⁶", "⁷", "⁸", "⁹"};
    std::string result = number < 0 ? "⁻" : "";
    for (const char digit : std::to_string(std::abs(number))) {
        result += digits[digit - '0'];
    }
    return result;
}

/// digit · 10^exponent, without floating-point rounding.
std::string tickText(int digit, int exponent) {
    if (exponent >= 0 && exponent <= 4) {
        return std::to_string(digit) + std::string(static_cast<size_t>(exponent), '0');
    }
    if (exponent < 0 && exponent >= -4) {
        return "0." + std::string(static_cast<size_t>(-exponent - 1), '0') + std::to_string(digit);
    }
    return (digit == 1 ? "" : std::to_string(digit) + "·") + "10" + superscript(exponent);
}

/// The leading digits whose ticks get a number, on an axis of so many decades.
std::string_view numberedDigits(double decades) {
    return decades < 1.0 ? "12357" : decades <= 3.0 ? "125" : "1";
}

}  // namespace

LogAxis::LogAxis(std::span<const double> values, double start, double end) : start_(start), end_(end) {
    if (!values.empty()) {
        const auto [least, most] = std::ranges::minmax(values);
        low_ = std::log10(least);
        high_ = std::log10(most);
    }
    const double decades = high_ - low_;
    const double margin = std::max(0.06 * decades, 0.5 * (leastDecades - decades));
    low_ -= margin;
    high_ += margin;
}

double LogAxis::positionOfLog(double log) const {
    return start_ + (log - low_) / (high_ - low_) * (end_ - start_);
}

double LogAxis::position(double value) const {
    return positionOfLog(std::log10(value));
}

std::vector<AxisTick> LogAxis::ticks() const {
    const double decades = high_ - low_;
    const int stride = static_cast<int>(std::ceil(decades / 8.0));  // decades between numbers
    const std::string_view numbered = numberedDigits(decades);
    std::vector<AxisTick> ticks;
    for (int exponent = static_cast<int>(std::floor(low_)); exponent <= static_cast<int>(high_) + 1; ++exponent) {
        if (exponent % stride != 0) {
            continue;
        }
        for (int digit = 1; digit <= (decades <= 6.0 ? 9 : 1); ++digit) {
            const double log = exponent + std::log10(digit);
            if (log >= low_ && log <= high_) {
                const bool text = numbered.find(static_cast<char>('0' + digit)) != std::string_view::npos;
                ticks.push_back({positionOfLog(log), text ? tickText(digit, exponent) : ""});
            }
        }
    }
    return ticks;
}

}  // namespace reflet
