// The shadow maps of lamps: assigns them to lamps, and draws them.
#pragma once

#include "effects/shadow/lamp_shadow.h"
#include "gpu/pass_list.h"
#include "renderer/draw_list.h"
#include "renderer/draw_shadows/distant_lamp.h"

#include <functional>
#include <string>

namespace reflet {

/// Assigns tiles to as many lamps as `settings` allow: the strongest by the largest of red, green and blue intensity
/// (directional lamps: the intensity that gives their irradiance from 5 metres away), independent of the view, so that
/// shadows do not pop as the camera moves. Sets the lamps' `shadow`. Tiles are halved in size until the atlas has at
/// most `largestSide` texels per side. Reflected suns come first; those without a tile are switched off. `warn`
/// receives messages about lamps left out.
LampShadows planLampShadows(LampBlock& lamps, const ShadowSettings& settings, uint32_t largestSide,
                            const LampShadowScene& scene, const std::function<void(const std::string&)>& warn);

/// Draws depth from the lamps, both sides of every surface: D32, reversed (near / distance along the tile's axis).
gpu::Image drawLampShadowMap(gpu::PassList& f, gpu::KeptImage& own, const DrawList& list, const LampShadows& shadows);

}  // namespace reflet
