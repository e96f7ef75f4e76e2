// The sun's shadow maps: fitted to the view and its casters, and redrawn only when something has changed.
#pragma once

#include "effects/shadow/shadow.h"
#include "gpu/pass_list.h"
#include "renderer/draw_list.h"

namespace reflet {

/// The maps for the settings: one by fitSunShadow or centredSunShadow, or cascades. `reach`: extra metres around the
/// visible part for filters; two texels are always added. nearest: from nearestSurface(); 0: unknown: then settings
/// with an automatic number of cascades get one map.
SunShadowParams fitSunShadows(const ViewParams& view, const Aabb& sceneBounds, const vec3& direction,
                              const ShadowSettings& settings, float reach = 0.0F, float nearest = 0.0F);

/// Lower bound of the distance of visible surfaces in front of the camera, by bounding boxes [m]; the largest float: no
/// surface is in view.
float nearestSurface(const ViewParams& view, const DrawList& list);

/// Largest filter radius, perpendicular to the sun direction [m]. sunSlope: as in ShadowVisibilityParams.
float filterReach(const Aabb& sceneBounds, const ShadowSettings& settings, float sunSlope);

/// Fits an orthographic map of `resolution` texels to the visible part of `sceneBounds`, with the depth range of all of
/// it. direction: direction of travel of the light. Texels snap to a grid, and their size changes in steps of 9 %.
ShadowMapParams fitSunShadow(const mat4& clipToWorld, const Aabb& sceneBounds, const vec3& direction, uint resolution,
                             float reach = 0.0F);

/// The same for all of `sceneBounds`, whatever is visible.
ShadowMapParams wholeSunShadow(const Aabb& sceneBounds, const vec3& direction, uint resolution);

/// One map per cascade. Texels snap to a grid and keep their size under camera rotation, and under translation except
/// for steps of 9 % in the scene's near and far distance.
SunShadowParams fitCascades(const ViewParams& view, const Aabb& sceneBounds, const vec3& direction,
                            const ShadowSettings& settings, float reach = 0.0F, float nearest = 0.0F);

/// A fixed orthographic map of ±extent metres around the world's origin, with the depth range of `sceneBounds`.
ShadowMapParams centredSunShadow(const Aabb& sceneBounds, const vec3& direction, float extent, uint resolution);

/// Draws depth from the sun, both sides of every surface: D32, reversed (1 nearest to the sun). A tile per cascade:
/// 1x1, 2x1 or 2x2. opaqueOnly: blended surfaces cast shadows only where they are opaque; otherwise, from an alpha of
/// blendCutoff on.
gpu::Image drawShadowMap(gpu::PassList& f, gpu::KeptImage& own, const DrawList& list, const SunShadowParams& sun,
                         const ShadowSettings& settings, bool opaqueOnly = false);

/// Parts of drawShadowMap, for other maps of the same size: the size, whether a cached map is still valid, the draws.
uvec2 sunMapSize(const SunShadowParams& sun, const ShadowSettings& settings);
bool holdsSunMap(gpu::PassList& f, gpu::KeptImage& image, const DrawList& list, const SunShadowParams& sun,
                 const ShadowSettings& settings, bool opaqueOnly = false);
void recordSunMap(const gpu::DrawCommands& to, const DrawList& list, const SunShadowParams& sun, uint32_t resolution,
                  const std::function<bool(const Draw&)>& keep, bool bindMaterials = true);

/// lighting::shadowRange of the map. list, sun, settings, opaqueOnly: as for drawShadowMap; reused whenever the map is.
gpu::Image drawShadowRange(gpu::PassList& f, gpu::KeptImage& own, gpu::Image shadowMap, const DrawList& list,
                           const SunShadowParams& sun, const ShadowSettings& settings, bool opaqueOnly = false);

}  // namespace reflet
