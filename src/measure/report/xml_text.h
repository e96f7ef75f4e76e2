// Escapes text for XML and HTML.
#pragma once

#include <string>
#include <string_view>

namespace reflet {

/// The text with & < > " ' escaped, for content and quoted attributes. Control characters become spaces;
/// bytes that are not UTF-8 become U+FFFD.
std::string xmlText(std::string_view text);

/// Length in bytes of the UTF-8 character at the start of the text; 0 if there is no valid one.
size_t leadingCharacter(std::string_view text);

}  // namespace reflet
