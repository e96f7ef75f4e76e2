// The sun's shadow maps: fitted to the view and its casters, drawn, and drawn again only when something has changed.
#pragma once

#include "effects/shadow/shadow.h"
#include "gpu/pass_list.h"
#include "renderer/draw_list.h"

namespace reflet {

/// The maps for the settings: one by fitSunShadow or centredSunShadow, or cascades. `reach`: extra metres around the
/// visible part for filters; two texels are always added. nearest: of nearestSurface; 0: unknown, and settings that
/// leave the number of cascades open get one map.
SunShadowParams fitSunShadows(const ViewParams& view, const Aabb& sceneBounds, const vec3& direction,
                              const ShadowSettings& settings, float reach = 0.0F, float nearest = 0.0F);

/// Distance in front of the camera before which no surface is in view, by bounding boxes [m]; the largest float: there
/// is none in view.
float nearestSurface(const ViewParams& view, const DrawList& list);

/// Largest filter radius, perpendicular to the sun direction [m]. sunSlope: as in ShadowVisibilityParams.
float filterReach(const Aabb& sceneBounds, const ShadowSettings& settings, float sunSlope);

/// Fits an orthographic map of `resolution` texels to the visible part of `sceneBounds`, with the depth of the whole.
/// direction: direction of travel of the light. Texels snap to a grid, and their size changes in steps of 9 %.
ShadowMapParams fitSunShadow(const mat4& clipToWorld, const Aabb& sceneBounds, const vec3& direction, uint resolution,
                             float reach = 0.0F);

/// The same for all of `sceneBounds`, whatever is visible.
ShadowMapParams wholeSunShadow(const Aabb& sceneBounds, const vec3& direction, uint resolution);

/// One map per cascade. Texels snap to a grid and keep their size under camera rotation, and under translation except
/// for steps of 9 % in the scene's near and far distance.
SunShadowParams fitCascades(const ViewParams& view, const Aabb& sceneBounds, const vec3& direction,
                            const ShadowSettings& settings, float reach = 0.0F, float nearest = 0.0F);

/// A fixed orthographic map of ±extent metres around the world's origin, with the depth of `sceneBounds`.
ShadowMapParams centredSunShadow(const Aabb& sceneBounds, const vec3& direction, float extent, uint resolution);

/// Draws depth from the sun, both sides of every surface: D32, reversed (1 nearest to the sun). A tile per cascade:
/// 1x1, 2x1 or 2x2. opaqueOnly: of blended surfaces only what is opaque; else what has an alpha of blendCutoff.
gpu::Image drawShadowMap(gpu::PassList& f, gpu::KeptImage& own, const DrawList& list, const SunShadowParams& sun,
                         const ShadowSettings& settings, bool opaqueOnly = false);

/// What another map of the same size needs: its size, whether a cached one is still valid, its draws.
uvec2 sunMapSize(const SunShadowParams& sun, const ShadowSettings& settings);
bool holdsSunMap(gpu::PassList& f, gpu::KeptImage& image, const DrawList& list, const SunShadowParams& sun,
                 const ShadowSettings& settings, bool opaqueOnly = false);
void recordSunMap(const gpu::DrawCommands& to, const DrawList& list, const SunShadowParams& sun, uint32_t resolution,
                  const std::function<bool(const Draw&)>& keep, bool bindMaterials = true);

/// lighting::shadowRange of the map. list, sun, settings, opaqueOnly: as for drawShadowMap; reused whenever the map is.
gpu::Image drawShadowRange(gpu::PassList& f, gpu::KeptImage& own, gpu::Image shadowMap, const DrawList& list,
                           const SunShadowParams& sun, const ShadowSettings& settings, bool opaqueOnly = false);

}  // namespace reflet
