// Texts in lines of a limited width. Counts UTF-8 characters.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace reflet {

size_t characters(std::string_view text);

/// Breaks a text between words into lines of at most `width` characters; a longer word has a line of its own.
std::vector<std::string> wrapped(std::string_view text, size_t width);

/// The text, or its first words in `width` characters with "..." at the end.
std::string firstWordsOf(std::string_view text, size_t width);

}  // namespace reflet
