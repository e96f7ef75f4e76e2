// All settings of the frame: one table per effect, here gathered under the names that users type (`effect.name`).
#pragma once

#include "base/setting_info.h"
#include "render/accumulate/accumulate.h"
#include "render/blend/blend.h"
#include "render/bounce/answer_environment.h"
#include "render/bounce/rays.h"
#include "render/bounce/trace_screen.h"
#include "render/composite/composite.h"
#include "render/contact/contact.h"
#include "render/denoise/denoise.h"
#include "render/direct/lamp_tiles.h"
#include "render/gbuffer/gbuffer.h"
#include "render/gbuffer/kept_depth.h"
#include "render/live/live_picture.h"
#include "render/planar/planar.h"
#include "render/probe/probes.h"
#include "render/shadow/shadow.h"
#include "render/temporal/temporal.h"
#include "render/tonemap/tonemap.h"
#include "render/trace_scene/trace_scene.h"

#include <nlohmann/json_fwd.hpp>

#include <string>
#include <string_view>
#include <vector>

namespace reflet {

struct Settings {
    MaterialsSettings materials;
    DepthSettings depth;
    ShadowSettings shadow;
    ContactSettings contact;
    DirectSettings direct;
    TraceScreenSettings traceScreen;
    TraceSceneSettings traceScene;
    ProbesSettings probes;
    PlanarSettings planar;
    LiveSettings live;
    EnvironmentSettings environment;
    DiffuseSettings diffuse;
    SpecularSettings specular;
    DenoiseSettings denoise;
    CompositeSettings composite;
    BlendSettings blend;
    AccumulateSettings accumulate;
    TemporalSettings temporal;
    TonemapSettings tonemap;
};

/// Whether a frame with these settings traces rays against the scene's BVH.
bool tracesScene(const Settings& settings);

/// A setting with its full name and its place in Settings.
struct SettingEntry {
    std::string name;  ///< "trace_screen.max_steps"
    SettingInfo info;  ///< offset counts from the start of Settings
};

/// All of them, in the order of the tables.
const std::vector<SettingEntry>& settingEntries();

/// The one of this name. Throws UsageError for an unknown one: says what it is called now, or names the nearest.
const SettingEntry& findSetting(std::string_view name);

bool sameSettings(const Settings& a, const Settings& b);

/// Sets one from text. Throws UsageError for an unknown name (suggesting the nearest) and for a value of the wrong type
/// or out of range (stating the range).
void setSetting(Settings& settings, std::string_view name, const std::string& value);

/// `key=value`, as given to --set.
void setSetting(Settings& settings, std::string_view assignment);

/// The value as text that setSetting takes.
std::string settingText(const Settings& settings, const SettingEntry& entry);

/// { "description": "what it is for", "trace_screen": { "max_steps": 64, … }, … }: sets what the object names, leaves
/// the rest. Messages start with `where`. Throws Error as setSetting does.
void applySettingsJson(Settings& settings, const nlohmann::json& json, const std::string& where);

/// The differences from `from`, as JSON for applySettingsJson; an empty object if there are none.
nlohmann::ordered_json settingsJson(const Settings& settings, const Settings& from);

/// The allowed values of a setting: "0.001 to 100", "true or false", "gamma22, srgb, …".
std::string rangeText(const SettingInfo& info);

}  // namespace reflet
