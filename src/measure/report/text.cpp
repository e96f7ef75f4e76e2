// Formats the numbers of a report as text.
#include "measure/report/text.h"

#include <fmt/format.h>

#include <cmath>

namespace reflet {

namespace {

std::string fixedText(double value, int decimals) {
    if (std::isnan(value)) {
        return "–";
    }
    if (std::isinf(value)) {
        return value > 0.0 ? "∞" : "−∞";
    }
    return fmt::format("{:.{}f}", value, decimals);
}

}  // namespace

std::string relativeMseText(double value) {
    return fixedText(value, 5);
}

std::string flipText(double value) {
    return fixedText(value, 4);
}

std::string psnrText(double value) {
    return fixedText(value, 1);
}

std::string millisecondsText(double value) {
    return fixedText(value, 2);
}

std::string countText(size_t count, std::string_view what) {
    return fmt::format("{} {}{}", count, what, count == 1 ? "" : "s");
}

std::string bouncesText(const std::optional<uint32_t>& bounces) {
    return bounces ? countText(*bounces, "bounce") : "unlimited bounces";
}

}  // namespace reflet
