// Text inside of XML and HTML.
#pragma once

#include <string>
#include <string_view>

namespace reflet {

/// The text with & < > " ' escaped, good between tags and in quoted attributes. Control characters become spaces;
/// bytes that are not UTF-8 become U+FFFD.
std::string xmlText(std::string_view text);

/// Length in bytes of the UTF-8 character that the text starts with; 0 where it starts with none.
size_t leadingCharacter(std::string_view text);

}  // namespace reflet
