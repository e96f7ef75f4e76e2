// Estimates text widths in a plot, without knowing the font.
#pragma once

#include <string>
#include <string_view>

namespace reflet {

/// Estimated width at font size 12; an overestimate, so that texts placed by it do not overlap.
float textWidth(std::string_view text);

/// The text, or its first `longest` characters and "…".
std::string shortened(std::string_view text, size_t longest);

}  // namespace reflet
