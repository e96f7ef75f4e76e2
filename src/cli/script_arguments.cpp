// Options for scripts.
#include "cli/script_arguments.h"

#include "base/json_text.h"
#include "base/message.h"

#include <fmt/format.h>
#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

namespace reflet {

void addScriptOptions(CLI::App& command, ScriptOptions& options) {
    command
        .add_flag_callback(
            "--quiet",
            [&options] {
                options.quiet = true;
                setQuiet(true);
            },
            "No progress, notes or summaries; warnings and errors remain")
        ->trigger_on_parse();
    command.add_flag("--json", options.json, "Print what was made to standard output, as JSON");
}

void printResult(const ScriptOptions& options, const nlohmann::ordered_json& result) {
    if (options.json) {
        fmt::print("{}\n", jsonText(result, 2));
    }
}

}  // namespace reflet
