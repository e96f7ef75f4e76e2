// The settings of the effects that the library has, under the names that the program has for them.
#pragma once

#include "base/setting_table.h"
#include "effects/ambient_occlusion/ambient_occlusion.h"
#include "effects/contact/contact.h"
#include "effects/denoise/denoise.h"
#include "effects/depth_of_field/depth_of_field.h"
#include "effects/lobe/answer_environment.h"
#include "effects/lobe/rays.h"
#include "effects/lobe/trace_screen.h"
#include "effects/shadow/shadow.h"
#include "effects/temporal/temporal.h"
#include "effects/tonemap/tonemap.h"

#include <string_view>

namespace reflet::api {

struct Settings {
    ShadowSettings shadow;
    ContactSettings contact;
    TraceScreenSettings traceScreen;
    EnvironmentSettings environment;
    DiffuseSettings diffuse;
    SpecularSettings specular;
    AoSettings ao;
    DenoiseSettings denoise;
    TemporalSettings temporal;
    DofSettings dof;
    TonemapSettings tonemap;
};

const SettingTable& settingTable();

/// Throws UsageError for a preset that the library does not have.
void applyPreset(Settings& settings, std::string_view name);

}  // namespace reflet::api
