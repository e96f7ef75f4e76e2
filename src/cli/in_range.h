// The check that a number on the command line is in a range.
#pragma once

#include <CLI/CLI.hpp>

namespace reflet {

/// As CLI::Range, which lets "nan" pass.
template <class T>
CLI::Validator inRange(T least, T most) {
    const CLI::Range range(least, most);
    CLI::Validator result = range;
    result.operation([range](std::string& text) -> std::string {
        double number = 0.0;
        const bool isNan = CLI::detail::lexical_cast(text, number) && number != number;
        return isNan ? "must be a number, is '" + text + "'" : range(text);
    });
    return result;
}

}  // namespace reflet
