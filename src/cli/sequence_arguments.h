// Options of the subcommands that make sequences.
#pragma once

#include "job/sequence_options.h"

#include <string>
#include <vector>

namespace CLI {
class App;
class Option;
}  // namespace CLI

namespace reflet {

/// Adds the options that apply only to sequences, and returns them. history: also those of frames that depend on
/// earlier ones.
std::vector<const CLI::Option*> addSequenceOptions(CLI::App& command, SequenceOptions& options, bool history);

/// Throws UsageError if one of them is given, but no output is a sequence.
void checkSequenceOptions(const std::vector<const CLI::Option*>& options, const std::vector<std::string>& outputs);

}  // namespace reflet
