// Escapes text for XML and HTML.
#include "measure/report/xml_text.h"

#include <array>
#include <cstdint>

namespace reflet {
namespace {

std::string_view escaped(char c) {
    switch (c) {
        case '&':
            return "&amp;";
        case '<':
            return "&lt;";
        case '>':
            return "&gt;";
        case '"':
            return "&quot;";
        case '\'':
            return "&#39;";
        default:
            return {};
    }
}

}  // namespace

size_t leadingCharacter(std::string_view text) {
    if (text.empty()) {
        return 0;
    }
    const auto first = static_cast<uint8_t>(text[0]);
    const size_t length = first < 0x80U ? 1 : first < 0xC0U ? 0 : first < 0xE0U ? 2 : first < 0xF0U ? 3 : 4;
    if (length == 0 || first > 0xF4U || text.size() < length) {
        return 0;
    }
    uint32_t code = length == 1 ? first : first & (0x7FU >> length);
    for (size_t i = 1; i < length; ++i) {
        const auto next = static_cast<uint8_t>(text[i]);
        if ((next & 0xC0U) != 0x80U) {
            return 0;
        }
        code = code << 6U | (next & 0x3FU);
    }
    // Overlong encodings, UTF-16 surrogates, values beyond Unicode, or codes that XML does not allow.
    constexpr std::array<uint32_t, 5> smallest{0, 0, 0x80, 0x800, 0x10000};
    const bool wrong = code < smallest.at(length) || (code >= 0xD800U && code < 0xE000U) || code > 0x10FFFFU ||
                       code == 0xFFFEU || code == 0xFFFFU;
    return wrong ? 0 : length;
}

std::string xmlText(std::string_view text) {
    std::string result;
    while (!text.empty()) {
        const size_t length = leadingCharacter(text);
        if (length == 0) {
            result += "\xEF\xBF\xBD";
        } else if (const std::string_view entity = escaped(text[0]); !entity.empty()) {
            result += entity;
        } else if (length == 1 && (static_cast<uint8_t>(text[0]) < 0x20U || text[0] == 0x7F)) {
            result += ' ';
        } else {
            result += text.substr(0, length);
        }
        text.remove_prefix(length == 0 ? 1 : length);
    }
    return result;
}

}  // namespace reflet
