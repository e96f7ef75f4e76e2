// Messages to the user on standard error. They never fail: the work goes on where standard error is closed or full.
#pragma once

#include <span>
#include <string>
#include <string_view>

namespace reflet {

/// The text on one line: control characters become '?', and of a text of more than `most` bytes the first ones are
/// kept, followed by "...". For names and values from input, which may be megabytes.
std::string oneLine(std::string_view text, size_t most = 200);

/// "a, b, c", or "none"; of more than 20 names the first ones and how many more there are. Each name as oneLine.
std::string listed(std::span<const std::string> names);

/// Writes "reflet: KIND MESSAGE" as one line of at most 8000 bytes. Errors of writing are ignored; never throws.
/// kind: "", "warning:" or "note:".
void printMessage(std::string_view kind, std::string_view message) noexcept;

/// Writes the text as it is. Errors of writing are ignored; never throws.
void printRaw(std::string_view text) noexcept;

}  // namespace reflet
