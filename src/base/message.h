// Messages to the user on standard error. They never fail: the work goes on where standard error is closed or full.
#pragma once

#include "base/visible_text.h"

#include <span>
#include <string>
#include <string_view>

namespace reflet {

/// "a, b, c", or "none"; of more than 20 names the first ones and how many more there are. Each name as oneLine.
std::string listed(std::span<const std::string> names);

/// Length in bytes of the longest message that is shown whole: a list of all settings has 4000.
constexpr size_t longestMessage = 8000;

/// Writes "reflet: KIND MESSAGE" as one line, by oneLine with `longestMessage`. Errors of writing are ignored; never
/// throws. kind: "", "warning:" or "note:".
void printMessage(std::string_view kind, std::string_view message) noexcept;

/// Whether notes and progress are left out, as --quiet asks. Of the whole process.
void setQuiet(bool quiet) noexcept;
bool isQuiet() noexcept;

/// Writes the text as it is. Errors of writing are ignored; never throws.
void printRaw(std::string_view text) noexcept;

}  // namespace reflet
