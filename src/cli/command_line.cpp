// Reconstructs the command line that the user typed.
#include "cli/command_line.h"

#include <CLI/CLI.hpp>

#include <fmt/format.h>

#include <algorithm>

namespace reflet {

namespace {

std::string optionName(const CLI::Option& option) {
    return option.get_snames().empty() ? "--" + option.get_lnames().front() : "-" + option.get_snames().front();
}

}  // namespace

std::string shellWord(std::string_view word) {
    constexpr std::string_view harmless = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-+=:,./@%";
    if (!word.empty() && word.find_first_not_of(harmless) == std::string_view::npos) {
        return std::string(word);
    }
    std::string quoted = "'";
    for (const char c : word) {
        quoted += c == '\'' ? "'\\''" : std::string(1, c);
    }
    return quoted + "'";
}

std::string commandLine(const CLI::App& command) {
    std::string arguments;
    std::string options;
    for (const CLI::Option* option : command.get_options()) {
        if (option->get_positional()) {
            for (const std::string& result : option->results()) {
                arguments += " " + shellWord(result);
            }
        } else if (option->get_expected_max() == 0 && option->count() > 0) {
            // A flag with two names, one for on and one for off.
            const std::vector<std::string>& off = option->get_fnames();
            options +=
                !off.empty() && option->results().front() == "false" ? " --" + off.front() : " " + optionName(*option);
        } else if (option->get_delimiter() != '\0' && option->count() > 0) {
            const std::string delimiter(1, option->get_delimiter());
            options += fmt::format(" {} {}", optionName(*option),
                                   shellWord(fmt::format("{}", fmt::join(option->results(), delimiter))));
        } else {
            const auto atOnce = static_cast<size_t>(std::max(option->get_type_size_max(), 1));
            for (size_t i = 0; i < option->count(); ++i) {
                options += i % atOnce == 0 ? " " + optionName(*option) : "";
                options += " " + shellWord(option->results()[i]);
            }
        }
    }
    const CLI::App* parent = command.get_parent();
    const std::string program = parent == nullptr ? "" : parent->get_name() + " ";
    return program + command.get_name() + arguments + options;
}

}  // namespace reflet
