// The command line that a user typed, for the record.
#pragma once

#include <string>
#include <string_view>

namespace CLI {
class App;
}  // namespace CLI

namespace reflet {

/// A word as a POSIX shell must see it: in quotation marks where it needs them.
std::string shellWord(std::string_view word);

/// "reflet report builtin:cubes -o out --spp 64": positional arguments first, then the options that were given. Typed
/// again it does the same.
std::string commandLine(const CLI::App& command);

}  // namespace reflet
