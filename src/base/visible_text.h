// Text from outside (names in files, arguments, paths) as it may be shown: on a terminal, in a document, in a window.
#pragma once

#include <string>
#include <string_view>

namespace reflet {

/// The first character of a UTF-8 text.
struct Character {
    char32_t code = 0;
    size_t length = 0;  ///< in bytes; 0: the text is empty or does not begin with valid UTF-8
};

Character firstCharacter(std::string_view text);

/// Whether the character does more than to show itself: controls (C0, DEL, C1: terminals obey them), line and paragraph
/// separators, marks of direction and invisible ones (they make one text look like another), and noncharacters.
bool isHidden(char32_t code);

/// The text with each hidden character as an escape (\n, \t, \x1b, \u202e) and each byte that is not UTF-8 as \xNN.
/// Backslashes stay, so that a second call changes nothing.
std::string visibleText(std::string_view text);

/// visibleText; of a result of more than `most` bytes the first characters that fit, followed by "...". For names and
/// values from input, which may be megabytes.
std::string oneLine(std::string_view text, size_t most = 80);

}  // namespace reflet
