// Estimates text widths by DejaVu Sans, which is wider than the fonts that pages usually get.
#include "measure/report/plot_text.h"

#include "base/visible_text.h"

#include <algorithm>
#include <cstdint>

namespace reflet {
namespace {

float characterWidth(std::string_view character) {
    const char c = character[0];
    if (static_cast<uint8_t>(c) >= 0x80U) {
        return character.size() > 2 ? 12.5F : 8.0F;  // CJK and other wide characters; accented, Greek, Cyrillic
    }
    if (std::string_view("fijlrtI ,.:;'|!()[]-").find(c) != std::string_view::npos) {
        return 5.0F;
    }
    if (std::string_view("mwMW%@").find(c) != std::string_view::npos) {
        return 12.0F;
    }
    return c >= 'A' && c <= 'Z' ? 9.5F : 7.7F;
}

/// Removes and returns the first character.
std::string_view takeCharacter(std::string_view& text) {
    const std::string_view character = text.substr(0, std::max<size_t>(firstCharacter(text).length, 1));
    text.remove_prefix(character.size());
    return character;
}

}  // namespace

float textWidth(std::string_view text) {
    float width = 0.0F;
    while (!text.empty()) {
        width += characterWidth(takeCharacter(text));
    }
    return width;
}

std::string shortened(std::string_view text, size_t longest) {
    std::string_view rest = text;
    for (size_t count = 0; count < longest && !rest.empty(); ++count) {
        takeCharacter(rest);
    }
    return rest.empty() ? std::string(text) : std::string(text.substr(0, text.size() - rest.size())) + "…";
}

}  // namespace reflet
