// Escapes text for XML and HTML.
#include "measure/report/xml_text.h"

#include "base/visible_text.h"

#include <algorithm>

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

std::string xmlText(std::string_view text) {
    std::string flat(text);
    std::ranges::replace_if(
        flat, [](char c) { return c == '\n' || c == '\r' || c == '\t'; }, ' ');
    std::string result;
    for (const char c : visibleText(flat)) {
        const std::string_view entity = escaped(c);
        result += entity.empty() ? std::string_view(&c, 1) : entity;
    }
    return result;
}

}  // namespace reflet
