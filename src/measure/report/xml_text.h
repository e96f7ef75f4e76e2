// Escapes text for XML and HTML.
#pragma once

#include <string>
#include <string_view>

namespace reflet {

/// The text with & < > " ' escaped, for content and quoted attributes. Line breaks and tabs become spaces, other hidden
/// characters and bytes that are not UTF-8 are shown by visibleText.
std::string xmlText(std::string_view text);

}  // namespace reflet
