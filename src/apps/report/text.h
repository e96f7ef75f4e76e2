// Numbers of a report as text, the same in the page and in the table.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace reflet {

/// For a cell of a table in Markdown.
std::string escapeMarkdown(std::string_view text);

// Fixed decimals, so that columns line up; "–" for what is no number, "∞" for infinity.
std::string relativeMseText(double value);
std::string flipText(double value);
std::string psnrText(double value);
std::string millisecondsText(double value);

/// 2, "scene" -> "2 scenes"
std::string countText(size_t count, std::string_view what);
/// "4 bounces", "unlimited bounces"
std::string bouncesText(const std::optional<uint32_t>& bounces);

}  // namespace reflet
