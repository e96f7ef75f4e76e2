// All settings of the frame: one table per effect, here gathered under the names that users type (`effect.name`).
#pragma once

#include "base/setting_table.h"
#include "effects/accumulate/accumulate.h"
#include "effects/ambient_occlusion/ambient_occlusion.h"
#include "effects/composite/composite.h"
#include "effects/contact/contact.h"
#include "effects/denoise/denoise.h"
#include "effects/depth_of_field/depth_of_field.h"
#include "effects/direct/lamp_tiles.h"
#include "effects/gbuffer/gbuffer.h"
#include "effects/gbuffer/kept_depth.h"
#include "effects/lobe/answer_environment.h"
#include "effects/lobe/rays.h"
#include "effects/lobe/trace_screen.h"
#include "effects/planar/planar.h"
#include "effects/shadow/shadow.h"
#include "effects/temporal/temporal.h"
#include "effects/tonemap/tonemap.h"
#include "renderer/blend/blend.h"
#include "renderer/gbuffer/draw_gbuffer.h"
#include "renderer/glass/glass.h"
#include "renderer/live/live_picture.h"
#include "renderer/probe/probes.h"
#include "renderer/trace_scene/trace_scene.h"

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
    AoSettings ao;
    DiffuseSettings diffuse;
    SpecularSettings specular;
    DenoiseSettings denoise;
    CompositeSettings composite;
    BlendSettings blend;
    TransmissionSettings transmission;
    AccumulateSettings accumulate;
    TemporalSettings temporal;
    DofSettings dof;
    TonemapSettings tonemap;
};

/// Whether a frame with these settings traces rays against the scene's BVH.
bool tracesScene(const Settings& settings);

const SettingTable& settingTable();

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

}  // namespace reflet
