#include "cli/program.h"

#include "base/error.h"
#include "base/file.h"
#include "base/message.h"
#include "base/text.h"
#include "cli/last_resort.h"
#include "cli/manual.h"
#include "cli/option_hints.h"
#include "version.h"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <cstdio>
#include <new>
#include <sstream>

namespace reflet {

namespace {

constexpr int exitUsage = 2;

int reportError(std::string_view message, int status) noexcept {
    printMessage("", message);
    return status;
}

// Returns the exit status.
int reportThrown(const std::exception_ptr& thrown) noexcept {
    try {
        std::rethrow_exception(thrown);
    } catch (const UsageError& error) {
        return reportError(error.what(), exitUsage);
    } catch (const std::bad_alloc&) {
        return reportError("needs more memory than is available", exitFailed);
    } catch (const std::exception& error) {
        return reportError(error.what(), exitFailed);
    } catch (...) {
        return reportError("failed for an unknown reason", exitFailed);
    }
}

// "reflet list scenes"
std::string fullName(const CLI::App& command) {
    const CLI::App* parent = command.get_parent();
    return parent == nullptr ? command.get_name() : fullName(*parent) + " " + command.get_name();
}

// Runs before CLI11 parses, whose error would only say that a subcommand is missing.
void checkSubcommand(CLI::App& app, std::span<char* const> arguments) {
    if (app.get_require_subcommand_min() == 0) {
        return;
    }
    std::vector<std::string> names;
    std::ranges::transform(app.get_subcommands({}), std::back_inserter(names), &CLI::App::get_name);
    if (arguments.empty()) {
        failUsage("'{}' needs a subcommand: {} (see {} --help)", fullName(app), fmt::join(names, ", "), fullName(app));
    }
    const std::string name = arguments[0];
    if (app.get_option_no_throw(name) != nullptr) {
        return;
    }
    if (std::ranges::find(names, name) == names.end()) {
        failUsage("'{}' has no {} '{}'; its subcommands: {}{}", fullName(app),
                  name.starts_with('-') ? "option" : "subcommand", name, fmt::join(names, ", "),
                  suggestion(name, names));
    }
    checkSubcommand(*app.get_subcommand(name), arguments.subspan(1));
}

const CLI::App& chosenCommand(const CLI::App& app) {
    const CLI::App* command = &app;
    while (!command->get_subcommands().empty()) {
        command = command->get_subcommands().front();
    }
    return *command;
}

// CLI11 writes the ends of ranges with six decimals: "not in range 1.000000 to 179.000000".
std::string withShortRange(const std::string& error) {
    constexpr std::string_view before = "not in range ";
    const size_t at = error.find(before);
    if (at == std::string::npos) {
        return error;
    }
    std::istringstream range(error.substr(at + before.size()));
    double min = 0.0;
    double max = 0.0;
    std::string to;
    if (!(range >> min >> to >> max)) {
        return error;
    }
    return fmt::format("{}{} to {}", error.substr(0, at + before.size()), min, max);
}

// The error for the first argument that no option consumed, with the option it was probably meant to be.
std::string unexpectedArgument(const CLI::App& app) {
    const CLI::App* command = &chosenCommand(app);
    const std::vector<std::string> rest = command->remaining();
    if (rest.empty()) {
        return fmt::format("unexpected argument (see {} --help)", fullName(*command));
    }
    std::vector<std::string> names;
    for (const CLI::Option* option : command->get_options()) {
        std::ranges::transform(option->get_lnames(), std::back_inserter(names),
                               [](const std::string& name) { return "--" + name; });
    }
    const std::string& typed = rest.front();
    std::string hint = optionHint(typed, [&](const std::string& name) { return std::ranges::count(names, name) > 0; });
    if (hint.empty() && typed.starts_with('-')) {
        hint = suggestion(typed.substr(0, typed.find('=')), names);
    }
    return fmt::format("unexpected argument '{}' (see {} --help){}", typed, fullName(*command), hint);
}

int parseAndRun(int argc, char** argv, std::span<const AddCommand> commands) {
    CLI::App app("Reflet: screen-space reflections (SSR), indirect light (SSGI) and soft shadows on any Vulkan device.",
                 "reflet");
    app.set_version_flag("--version", std::string("reflet ") + versionText);
    app.require_subcommand(1);
    app.footer("Try: reflet render builtin:cubes -o cubes.png\nEach subcommand has its own --help.");
    for (const AddCommand add : commands) {
        add(app);
    }
    addManualCommands(app, versionText);
    checkSubcommand(app, std::span(argv, static_cast<size_t>(argc)).subspan(1));
    try {
        app.parse(argc, argv);
    } catch (const CLI::Success& success) {  // --help, --version
        app.exit(success);
    } catch (const CLI::ExtrasError&) {
        return reportError(unexpectedArgument(app), exitUsage);
    } catch (const CLI::ParseError& error) {
        return reportError(
            fmt::format("{} (see {} --help)", withShortRange(error.what()), fullName(chosenCommand(app))), exitUsage);
    }
    if (std::fflush(stdout) != 0 || std::ferror(stdout) != 0) {  // whoever flushed before has not looked
        return reportError("cannot write to standard output", exitFailed);
    }
    return 0;
}

}  // namespace

int runProgram(int argc, char** argv, std::span<const AddCommand> commands) {
    prepareForFailures();
    try {
        return parseAndRun(argc, argv, commands);
    } catch (...) {
        return reportThrown(std::current_exception());
    }
}

void endProgram(const std::exception_ptr& thrown) noexcept {
    exitNow(thrown ? reportThrown(thrown) : 0);
}

}  // namespace reflet
