// How much room a text takes in a plot, without knowing the font.
#pragma once

#include <string>
#include <string_view>

namespace reflet {

/// Estimated width at a font size of 12: rather too wide, so that texts that are placed by it stay apart.
float textWidth(std::string_view text);

/// The text, or its first `longest` characters and "…".
std::string shortened(std::string_view text, size_t longest);

}  // namespace reflet
