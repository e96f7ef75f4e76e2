// Tables for a terminal.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace reflet {

/// Breaks a text between words into lines of at most `width` characters; a longer word has a line of its own.
std::vector<std::string> wrapped(std::string_view text, size_t width);

/// The text, or its first words in `width` characters with "..." at the end. Counts UTF-8 characters.
std::string firstWordsOf(std::string_view text, size_t width);

/// Markdown as plain text: the columns of its tables aligned by spaces, headings without #, code without backquotes. A
/// table wider than `width` characters is turned: a line for each column, where that is narrower.
std::string alignedTables(std::string_view markdown, size_t width);

}  // namespace reflet
