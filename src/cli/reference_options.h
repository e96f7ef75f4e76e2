// The command line of `reflet reference`.
#pragma once

#include "cli/script_arguments.h"
#include "job/scene_options.h"
#include "job/sequence_options.h"
#include "reference/reference.h"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace CLI {
class App;
class Option;
}  // namespace CLI

namespace reflet {

/// The options as typed.
struct ReferenceCommand {
    SceneOptions scene;
    std::vector<std::string> outputs;
    uint32_t frames = 1;
    SequenceOptions sequence;
    std::optional<uint32_t> bounces;
    std::optional<uint32_t> samples;
    float noise = 0.0F;
    float clamp = 0.0F;
    std::string filter = "box";
    std::string sampling = "cosine";
    bool visibleOnly = false;
    bool pinhole = false;
    float shutter = 0.0F;
    std::vector<std::string> layers;
    std::optional<float> aoRadius;
    std::optional<float> aoFalloff;
    unsigned threads = 0;
    ScriptOptions script;
};

/// Adds all options. Returns those that are for sequences only, as addSequenceOptions.
std::vector<const CLI::Option*> addReferenceOptions(CLI::App& command, ReferenceCommand& options);

/// Throws UsageError for values that no range of the options refuses.
void checkReferenceCommand(const ReferenceCommand& command, uvec2 size);

ReferenceOptions referenceOptions(const ReferenceCommand& command, const Settings& settings);

}  // namespace reflet
