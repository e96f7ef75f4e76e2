// Text from outside as it may be shown.
#include "base/visible_text.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <utility>

namespace reflet {

namespace {

// Only digits and letters: {fmt} would make every file of the library that includes this larger.
std::string hexText(std::string_view prefix, char32_t value, int digits) {
    constexpr std::string_view letters = "0123456789abcdef";
    std::string text(prefix);
    for (int i = digits - 1; i >= 0; --i) {
        text += letters[(static_cast<uint32_t>(value) >> (4U * static_cast<uint32_t>(i))) & 15U];
    }
    return text;
}

std::string escapeOf(char32_t code) {
    switch (code) {
        case '\n':
            return "\\n";
        case '\r':
            return "\\r";
        case '\t':
            return "\\t";
        default:
            return code < 0x100     ? hexText("\\x", code, 2)
                   : code < 0x10000 ? hexText("\\u", code, 4)
                                    : hexText("\\U", code, 8);
    }
}

// What the text begins with, shown, and its length in bytes.
std::pair<std::string, size_t> firstShown(std::string_view text) {
    const Character first = firstCharacter(text);
    if (first.length == 0) {
        return {hexText("\\x", static_cast<uint8_t>(text[0]), 2), 1};
    }
    return {isHidden(first.code) ? escapeOf(first.code) : std::string(text.substr(0, first.length)), first.length};
}

}  // namespace

Character firstCharacter(std::string_view text) {
    if (text.empty()) {
        return {};
    }
    const auto first = static_cast<uint8_t>(text[0]);
    const size_t length = first < 0x80U ? 1 : first < 0xC0U ? 0 : first < 0xE0U ? 2 : first < 0xF0U ? 3 : 4;
    if (length == 0 || first > 0xF4U || text.size() < length) {
        return {};
    }
    uint32_t code = length == 1 ? first : first & (0x7FU >> length);
    for (size_t i = 1; i < length; ++i) {
        const auto next = static_cast<uint8_t>(text[i]);
        if ((next & 0xC0U) != 0x80U) {
            return {};
        }
        code = code << 6U | (next & 0x3FU);
    }
    // Overlong encodings, UTF-16 surrogates, values beyond Unicode.
    constexpr std::array<uint32_t, 5> smallest{0, 0, 0x80, 0x800, 0x10000};
    const bool wrong = code < smallest.at(length) || (code >= 0xD800U && code < 0xE000U) || code > 0x10FFFFU;
    return wrong ? Character{} : Character{code, length};
}

bool isHidden(char32_t code) {
    struct Range {
        char32_t first, last;
    };
    // Unicode's general categories Cc, Cf, Zl and Zp, what shows nothing though it counts as a letter (fillers of
    // Hangul, the combining grapheme joiner, selectors of variants beyond those of emoji), and noncharacters.
    constexpr std::array<Range, 22> hidden{
        {{0, 0x1F},          {0x7F, 0x9F},      {0xAD, 0xAD},     {0x34F, 0x34F},     {0x600, 0x605},
         {0x61C, 0x61C},     {0x6DD, 0x6DD},    {0x70F, 0x70F},   {0x115F, 0x1160},   {0x180B, 0x180F},
         {0x200B, 0x200F},   {0x2028, 0x202E},  {0x2060, 0x206F}, {0x3164, 0x3164},   {0xFDD0, 0xFDEF},
         {0xFEFF, 0xFEFF},   {0xFFA0, 0xFFA0},  {0xFFF0, 0xFFFB}, {0x110BD, 0x110CD}, {0x1BCA0, 0x1BCA3},
         {0x1D173, 0x1D17A}, {0xE0000, 0xE0FFF}}};
    return (code & 0xFFFEU) == 0xFFFEU ||
           std::ranges::any_of(hidden, [&](const Range& r) { return code >= r.first && code <= r.last; });
}

std::string visibleText(std::string_view text) {
    std::string result;
    result.reserve(text.size());
    while (!text.empty()) {
        const auto [shown, length] = firstShown(text);
        result += shown;
        text.remove_prefix(length);
    }
    return result;
}

std::string oneLine(std::string_view text, size_t most) {
    std::string result;
    while (!text.empty()) {
        const auto [shown, length] = firstShown(text);
        if (result.size() + shown.size() > most) {
            return result + "...";
        }
        result += shown;
        text.remove_prefix(length);
    }
    return result;
}

}  // namespace reflet
