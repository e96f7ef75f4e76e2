// Sun visibility: a shadow map fitted to what the view can see or what casts into it, looked up per pixel.
// Shared by C++ and GLSL.
#ifndef REFLET_RENDER_SHADOW_H
#define REFLET_RENDER_SHADOW_H

#include "base/shared.h"
#include "render/view.h"

SHARED_BEGIN

#define SHADOW_FILTERS(OPTION)    \
    OPTION(ShadowFilter, none, 0) \
    OPTION(ShadowFilter, hard, 1)
CHOICES(ShadowFilter, SHADOW_FILTERS)

#define SHADOW_BIASES(OPTION)    \
    OPTION(ShadowBias, slope, 0) \
    OPTION(ShadowBias, constant, 1)
CHOICES(ShadowBias, SHADOW_BIASES)

#define SHADOW_SETTINGS(VALUE, SWITCH, CHOICE)                                                                         \
    CHOICE(ShadowFilter, filter, hard, "How the sun's shadow map is read; none: the sun casts no shadows.")            \
    VALUE(uint, resolution, 2048, 64, 8192, "Texels along each side of the sun's shadow map.")                         \
    VALUE(float, extent, 0.0, 0.0, 10000.0,                                                                            \
          "Metres from the middle of the map, the world's origin, to each side; what is outside is lit; 0: fitted to " \
          "the view.")                                                                                                 \
    CHOICE(ShadowBias, biasKind, slope,                                                                                \
           "What keeps surfaces from shadowing themselves; slope: they are followed along their own plane to the "     \
           "texel's centre, then `bias`; constant: `constantBias` alone.")                                             \
    VALUE(float, bias, 0.75, 0.0, 16.0,                                                                                \
          "How far above themselves surfaces ask for shadow, in texels of the map (slope).")                           \
    VALUE(float, constantBias, 0.01, 0.0, 10.0,                                                                        \
          "How much nearer to the sun surfaces are taken to be, in metres (constant).")
SETTINGS(ShadowSettings, SHADOW_SETTINGS)

// Shadow space: x, y in clip space of the map, z reversed depth (1 nearest to the sun), all of it linear.
struct ShadowMapParams {
    mat4 worldToShadow;
    vec3 toSun;        // world space, unit
    float texelSize;   // metres that a texel spans (the longer side)
    float depthRange;  // metres from depth 1 to depth 0
};

struct ShadowVisibilityParams {
    ViewParams view;
    ShadowMapParams map;
    ShadowSettings settings;
};

SHARED_END

#ifdef __cplusplus

#include "gpu/frame.h"
#include "render/draw_list.h"
#include "render/gbuffer/gbuffer.h"

namespace reflet {

/// Fits an orthographic map of `resolution` texels to the part of `sceneBounds` that the view sees, and lengthens it
/// toward the sun by all that may cast into it. direction: the way the light travels.
ShadowMapParams fitSunShadow(const mat4& clipToWorld, const Aabb& sceneBounds, const vec3& direction, uint resolution);

/// An orthographic map of ±extent metres around the world's origin, whatever the view sees, as deep as `sceneBounds`.
ShadowMapParams centredSunShadow(const Aabb& sceneBounds, const vec3& direction, float extent, uint resolution);

/// Draws depth as the sun sees it, both sides of every surface: D32, reversed (1 nearest to the sun).
gpu::Image drawShadowMap(gpu::Frame& f, const DrawList& list, const ShadowMapParams& map,
                         const ShadowSettings& settings);

/// R8, 1: lit. The sky is lit. Without a map (filter none): 1 everywhere.
gpu::Image sunVisibility(gpu::Frame& f, const GBuffer& g, gpu::Image shadowMap, const ShadowMapParams& map,
                         const ViewParams& view, const ShadowSettings& settings);

}  // namespace reflet
#endif

#endif
