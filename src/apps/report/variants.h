// The variants of a report: presets, and settings under names of the user's own.
#pragma once

#include "apps/scene_options.h"
#include "render/settings.h"

#include <string>
#include <vector>

namespace reflet {

struct Variant {
    std::string name;
    Settings settings;
};

/// A variant for each preset, then for each of `own`, which are as --variant takes them: NAME=PART,PART,… where a part
/// is KEY=VALUE or the name of a preset, each over the ones before. What `shared` says of settings comes after the
/// presets and before KEY=VALUE. Throws UsageError, also for two variants of one name.
std::vector<Variant> makeVariants(const std::vector<std::string>& presets, const std::vector<std::string>& own,
                                  const SceneOptions& shared);

/// "fast,diffuse.rays=2" or "preset:fast,diffuse.rays=2": presets, then what `shared` says of settings, then the list's
/// own. `where` starts messages. Throws UsageError.
Settings settingsOfList(const std::string& list, const SceneOptions& shared, const std::string& where);

/// "diffuse.rays=1 trace_screen.step=0.3": what differs from the defaults, as --set takes it.
std::string changedSettings(const Settings& settings);

}  // namespace reflet
