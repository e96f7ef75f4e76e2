// Letters and digits of ASCII. The functions of <cctype> obey the locale that a host has set for its whole process.
#pragma once

#include <string>

namespace reflet {

constexpr bool isAsciiDigit(char c) {
    return c >= '0' && c <= '9';
}

constexpr bool isAsciiUpper(char c) {
    return c >= 'A' && c <= 'Z';
}

constexpr char asciiLower(char c) {
    return isAsciiUpper(c) ? static_cast<char>(c - 'A' + 'a') : c;
}

constexpr char asciiUpper(char c) {
    return c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c;
}

inline std::string inLowerCase(std::string text) {
    for (char& c : text) {
        c = asciiLower(c);
    }
    return text;
}

constexpr bool isAsciiAlphanumeric(char c) {
    return isAsciiDigit(c) || isAsciiUpper(asciiUpper(c));
}

}  // namespace reflet
