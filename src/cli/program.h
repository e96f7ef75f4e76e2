// The command line as a whole: finds the subcommand, runs it, reports errors.
#pragma once

#include <exception>
#include <span>

namespace CLI {
class App;
}  // namespace CLI

namespace reflet {

/// Adds a subcommand to the command line: see commands.h.
using AddCommand = void (*)(CLI::App&);

/// Runs the subcommand that the arguments name. Errors go to standard error, one line each. Returns the exit status: 0
/// success, 1 failure, 2 usage error.
int runProgram(int argc, char** argv, std::span<const AddCommand> commands);

/// Reports what was thrown, or success if it is null, and ends the process without destructors: for where a thread
/// cannot be waited for.
[[noreturn]] void endProgram(const std::exception_ptr& thrown) noexcept;

}  // namespace reflet
