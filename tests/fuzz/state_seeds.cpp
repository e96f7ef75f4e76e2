// Seeds of the targets that read settings, records and states.
#include "base/json_text.h"
#include "renderer/presets.h"
#include "seeds.h"
#include "view/saved_state.h"

#include <nlohmann/json.hpp>

namespace reflet::fuzz {

std::vector<Seed> stateSeeds() {
    Settings preset;
    applyPreset(preset, "quality");
    ViewerState state;
    state.source.scene = "builtin:cubes";
    state.preset = "plain";
    return {{"settings", "settings.json", jsonText(settingsJson(preset, Settings{}), 2)},
            {"sequence_record", "record.json",
             R"({"device": "d", "size": [2, 3], "view": {"time": 1}, "settings": {"diffuse.rays": "4"}})"},
            {"saved_state", "state.json", stateText(state)}};
}

}  // namespace reflet::fuzz
