// Formats the numbers of a report as text, for the page and the table.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace reflet {

// Fixed decimals, so that columns align; "–" for NaN, "∞" for infinity.
std::string relativeMseText(double value);
std::string flipText(double value);
std::string psnrText(double value);
std::string millisecondsText(double value);

/// 2, "scene" -> "2 scenes"
std::string countText(size_t count, std::string_view what);
/// "4 bounces", "unlimited bounces"
std::string bouncesText(const std::optional<uint32_t>& bounces);

}  // namespace reflet
