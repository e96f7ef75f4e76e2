// All settings of the frame: one table per effect, here gathered under the names that users type (`effect.name`).
#pragma once

#include "base/setting_table.h"
#include "effects/probe/probes.h"
#include "lighting/direct.h"
#include "lighting/picture.h"
#include "lighting/settings.h"
#include "lighting/surfaces.h"
#include "renderer/blend/blend.h"
#include "renderer/draw_gbuffer/draw_gbuffer.h"
#include "renderer/glass/glass.h"
#include "renderer/live/live_picture.h"
#include "renderer/trace_scene/trace_scene.h"

#include <nlohmann/json_fwd.hpp>

#include <string>
#include <string_view>
#include <vector>

namespace reflet {

/// The settings of the stages, and those of the renderer.
struct Settings : LightingSettings {
    MaterialsSettings materials;
    DepthSettings depth;
    DirectSettings direct;
    TraceSceneSettings traceScene;
    ProbesSettings probes;
    PlanarSettings planar;
    LiveSettings live;
    CompositeSettings composite;
    BlendSettings blend;
    TransmissionSettings transmission;
    AccumulateSettings accumulate;
};

/// Whether a frame with these settings traces rays against the scene's BVH.
bool tracesScene(const Settings& settings);

/// Whether lamps replace emitters: requires lamp shadows, and diffuse rays, which then ignore emitters.
bool lightsByEmitters(const Settings& settings);

/// Maximum number of reflected suns; 0 without lamp shadows or with materials.lambert_only.
uint32_t mostReflectedSuns(const Settings& settings);

const SettingTable& settingTable();

/// All of them, in the order of the tables.
const std::vector<SettingEntry>& settingEntries();

/// The setting of this name. Throws UsageError for an unknown name, with its new name or the nearest one.
const SettingEntry& findSetting(std::string_view name);

bool sameSettings(const Settings& a, const Settings& b);

/// Sets a value from text. Throws UsageError for an unknown name (suggesting the nearest) and for a value of the wrong
/// type or out of range (stating the range).
void setSetting(Settings& settings, std::string_view name, const std::string& value);

/// `key=value`, as given to --set.
void setSetting(Settings& settings, std::string_view assignment);

/// The value as text that setSetting takes.
std::string settingText(const Settings& settings, const SettingEntry& entry);

/// { "description": "what it is for", "trace_screen": { "max_steps": 64, … }, … }: changes only the settings in the
/// object. Messages start with `where`. Throws Error as setSetting does.
void applySettingsJson(Settings& settings, const nlohmann::json& json, const std::string& where);

/// The differences from `from`, as JSON for applySettingsJson; an empty object if there are none.
nlohmann::ordered_json settingsJson(const Settings& settings, const Settings& from);

}  // namespace reflet
