// Reconstructs the command line that the user typed, to record it in results.
#pragma once

#include <string>
#include <string_view>

namespace CLI {
class App;
}  // namespace CLI

namespace reflet {

/// Quotes a word for a POSIX shell where it needs quotes.
std::string shellWord(std::string_view word);

/// "reflet report builtin:cubes -o out --spp 64": positional arguments first, then the options that were given.
/// Running it again does the same.
std::string commandLine(const CLI::App& command);

}  // namespace reflet
