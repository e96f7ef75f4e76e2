// Messages to the user on standard error.
#include "base/message.h"

#include <algorithm>
#include <cctype>
#include <cstdio>

namespace reflet {

namespace {

constexpr size_t longest = 8000;  // a list of all settings has 4000

std::string withoutControls(std::string_view text, char instead) {
    std::string result(text);
    std::ranges::replace_if(
        result, [](unsigned char c) { return std::iscntrl(c) != 0; }, instead);
    return result;
}

}  // namespace

std::string oneLine(std::string_view text, size_t most) {
    return withoutControls(text.substr(0, most), '?') + (text.size() > most ? "..." : "");
}

std::string listed(std::span<const std::string> names) {
    constexpr size_t most = 20;
    constexpr size_t mostBytes = 60;
    std::string text = names.empty() ? "none" : "";
    for (size_t i = 0; i < names.size() && i < most; ++i) {
        text += (i == 0 ? "" : ", ") + oneLine(names[i], mostBytes);
    }
    return text + (names.size() > most ? " and " + std::to_string(names.size() - most) + " more" : "");
}

void printRaw(std::string_view text) noexcept {
    (void)std::fwrite(text.data(), 1, text.size(), stderr);  // not fmt::print, which throws
    (void)std::fflush(stderr);
}

void printMessage(std::string_view kind, std::string_view message) noexcept {
    try {
        std::string line = "reflet: ";
        line.append(kind).append(kind.empty() ? "" : " ");
        line += withoutControls(message.substr(0, longest), ' ');
        line += message.size() > longest ? "...\n" : "\n";
        printRaw(line);
    } catch (...) {  // no memory for the line
        printRaw("reflet: not enough memory\n");
    }
}

}  // namespace reflet
