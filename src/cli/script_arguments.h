// --quiet and --json, for scripts.
#pragma once

#include <nlohmann/json_fwd.hpp>

namespace CLI {
class App;
}  // namespace CLI

namespace reflet {

struct ScriptOptions {
    bool quiet = false;
    bool json = false;
};

/// Adds the options. --quiet takes effect when the command line is parsed.
void addScriptOptions(CLI::App& command, ScriptOptions& options);

/// With --json, prints what was made to standard output.
void printResult(const ScriptOptions& options, const nlohmann::ordered_json& result);

}  // namespace reflet
