// Messages to the user on standard error.
#include "base/message.h"

#include <algorithm>
#include <atomic>
#include <cstdio>

namespace reflet {

namespace {

std::atomic<bool> quietly{false};

}  // namespace

void setQuiet(bool quiet) noexcept {
    quietly = quiet;
}

bool isQuiet() noexcept {
    return quietly;
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
        std::string text(message);
        std::ranges::replace(text, '\n', ' ');  // of a compiler's or a library's message
        line += oneLine(text, longestMessage) + "\n";
        printRaw(line);
    } catch (...) {  // no memory for the line
        printRaw("reflet: not enough memory\n");
    }
}

}  // namespace reflet
