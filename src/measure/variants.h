// The variants of a report or bench: presets, and named lists of settings.
#pragma once

#include "job/scene_options.h"
#include "renderer/settings.h"

#include <string>
#include <vector>

namespace reflet {

struct Variant {
    std::string name;
    Settings settings;
};

/// A variant for each preset, then for each of `own`, in the form of --variant: NAME=PART,PART,… where a part is
/// KEY=VALUE or the name of a preset, each overriding the ones before. The settings of `shared` apply after the presets
/// and before KEY=VALUE. Throws UsageError, also for two variants of the same name.
std::vector<Variant> makeVariants(const std::vector<std::string>& presets, const std::vector<std::string>& own,
                                  const SceneOptions& shared);

/// "fast,diffuse.rays=2" or "preset:fast,diffuse.rays=2": presets, then the settings of `shared`, then those
/// of the list. `where` starts error messages. Throws UsageError.
Settings settingsOfList(const std::string& list, const SceneOptions& shared, const std::string& where);

/// "diffuse.rays=1 trace_screen.step=0.3": the settings that differ from the defaults, in the form of --set.
std::string changedSettings(const Settings& settings);

}  // namespace reflet
