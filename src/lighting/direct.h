// Direct light: visibility of the sun and of lamps, and lighting of surfaces by them and the environment.
#pragma once

#include "effects/direct/direct.h"
#include "effects/direct/lamp_tiles.h"
#include "effects/shadow/import_lamp_map.h"
#include "effects/shadow/lamp_shadow.h"
#include "lighting/settings.h"
#include "lighting/surfaces.h"

#include <cmath>
#include <span>

namespace reflet::lighting {

/// Tangent of half the sun's angular diameter [rad].
inline float sunSlope(float angularDiameter) {
    return std::tan(0.5F * angularDiameter);
}

/// The sun and its shadow maps, rendered or imported by the caller.
struct SunMaps {
    ShadowMap map;          ///< none: everything is lit
    gpu::Image range;       ///< from shadowRange(); none: the blocker search has no early-out
    SunShadowParams sun{};  ///< parameters of the cascades
    vec3 toSun{0.0F};       ///< unit direction
    float slope = 0.0F;     ///< from sunSlope()
    bool contact = false;   ///< the sun casts contact shadows, if the settings have any
};

/// Where a cascade begins to blend into the next (SunShadowParams::blends). begin, end: distances in front of the
/// camera.
inline float cascadeBlend(const ShadowSettings& settings, float begin, float end) {
    return glm::mix(end, begin, settings.cascadeBlend);
}

struct SunShadow {
    gpu::Image visibility;    ///< R8: final visibility, for direct light
    gpu::Image raw;           ///< visibility before denoising
    gpu::Image penumbra;      ///< SunVisibility::penumbra; none with hard shadows
    gpu::Image cascadeIndex;  ///< SunVisibility::cascadeIndex; none with one cascade
};

/// Whether sunShadow reads SunMaps::range.
bool readsShadowRange(const ShadowSettings& settings);
/// Size and format of SunMaps::range for a map.
uvec2 shadowRangeSize(uvec2 map);
constexpr VkFormat shadowRangeFormat = VK_FORMAT_R32G32_SFLOAT;
/// The depth range of a map that is redrawn every frame; none if sunShadow does not read it.
gpu::Image shadowRange(gpu::PassList& f, const ShadowSettings& settings, const ShadowMap& map);
/// Writes the complete depth range of a map: nearest and farthest depth of its cells.
void shadowRange(gpu::PassList& f, const ShadowMap& map, gpu::Image range);

/// Visibility of the sun: shadow map, denoised penumbras, contact shadows. history: of penumbras; none: only this
/// frame.
SunShadow sunShadow(gpu::PassList& f, gpu::HistoryImage* history, const ViewContext& in,
                    const LightingSettings& settings, Surfaces& surfaces, const SunMaps& maps);

/// Contact shadows of a single light: R8, 1: lit. light: see ContactParams.
gpu::Image contactVisibility(gpu::PassList& f, const ViewContext& in, const ContactSettings& settings,
                             Surfaces& surfaces, const vec4& light);

/// Which lamps may light each tile of the screen.
LampTiles lampTiles(gpu::PassList& f, const ViewContext& in, const DirectSettings& settings, const Surfaces& surfaces,
                    const LampBlock& lamps);

/// Visibility of the lamps that cast shadows; none if no lamp does. map: their shadow maps.
gpu::Image lampShadow(gpu::PassList& f, const ViewContext& in, const LightingSettings& settings,
                      const Surfaces& surfaces, const LampTiles& tiles, const LampShadows& shadows, gpu::Image map);

/// A lamp of a host with its shadow map.
struct HostLamp {
    LampShadow shadow{};        ///< lampShadow() sets `index` and `firstTile`
    ImportLampParams import{};  ///< conventions of the host's map; lampShadow() sets the rest
    gpu::Image map;             ///< 2D, or a view of a cube
    bool isCube = false;
};

/// Visibility of a host's lamps, 1 to maxShadowedLamps: RGBA8, four lamps per layer. Throws UsageError if their maps do
/// not fit into one image of the device.
gpu::Image lampShadow(gpu::PassList& f, const ViewContext& in, const LightingSettings& settings,
                      const Surfaces& surfaces, std::span<HostLamp> lamps);

/// Sources of direct light and their visibility.
struct LightSources {
    vec3 toSun{0.0F};          ///< unit direction
    vec3 sunIrradiance{0.0F};  ///< [W/m²]; 0: no sun
    float sunSlope = 0.0F;     ///< from sunSlope()
    const LampBlock& lamps;
    LightVisibility visibility;
};

/// Radiance of direct light, emission and the background environment.
DirectLight directLight(gpu::PassList& f, const ViewContext& in, const Surfaces& surfaces, const LightSources& lights);

}  // namespace reflet::lighting
