// The manual page and shell completion, made from the program's own options.
#pragma once

#include <string>
#include <string_view>

namespace CLI {
class App;
}  // namespace CLI

namespace reflet {

/// The manual page reflet(1), in troff.
std::string manualPage(const CLI::App& app, std::string_view version);

/// Completion for "bash", "zsh" or "fish": subcommands, options, and names of scenes, presets, shows and settings.
std::string shellCompletion(const CLI::App& app, std::string_view shell);

void addManualCommands(CLI::App& app, std::string_view version);

}  // namespace reflet
