// Breaks texts between words.
#include "base/wrap.h"

#include <algorithm>

namespace reflet {

size_t characters(std::string_view text) {
    return static_cast<size_t>(std::ranges::count_if(text, [](char c) { return (c & 0xC0) != 0x80; }));
}

std::vector<std::string> wrapped(std::string_view text, size_t width) {
    std::vector<std::string> lines;
    while (!text.empty()) {
        const size_t end = std::min(text.find(' '), text.size());
        const std::string_view word = text.substr(0, end);
        if (!lines.empty() && characters(lines.back()) + 1 + characters(word) <= width) {
            lines.back() += ' ';
            lines.back() += word;
        } else {
            lines.emplace_back(word);
        }
        text.remove_prefix(std::min(end + 1, text.size()));
    }
    return lines;
}

std::string firstWordsOf(std::string_view text, size_t width) {
    if (characters(text) <= width) {
        return std::string(text);
    }
    const std::vector<std::string> lines = wrapped(text, width - std::min<size_t>(width, 4));
    return lines.empty() ? "" : lines.front() + " ...";
}

}  // namespace reflet
