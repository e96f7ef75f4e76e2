// The radiance of visible surfaces, as rays and slices read it: of this frame or the last one. Bound by bindScreenLight
// (trace_screen.h).
#ifndef REFLET_SCREEN_LIGHT_GLSL
#define REFLET_SCREEN_LIGHT_GLSL

#include "effects/gbuffer/gbuffer.glsl"
#include "effects/lamps.h"
#include "effects/levels.glsl"
#include "effects/lobe/trace_screen.h"
#include "shaders/half_float.glsl"
#include "shaders/octahedral.glsl"
#include "shaders/projection.glsl"

layout(constant_id = 22) const uint cones = 0u;
layout(constant_id = 29) const uint readsPrevious = 0u;
layout(constant_id = 32) const uint emittersAtHits = EmittersAtHits_all;
layout(constant_id = 33) const uint metalsLeftOut = MetalsLeftOut_none;

layout(scalar) uniform ParamsBlock { TraceScreenParams params; };
uniform sampler2D depth;
uniform usampler2D geometricNormal;
uniform sampler2D motion;
layout(rgba16f) uniform readonly image2D light;
layout(rgba16f) uniform readonly image2D previousLit;
uniform sampler2D lightMips;
uniform sampler2D hitMaterial;
uniform sampler2D hitEmissive;

float loadDepth(ivec2 pixel) { return texelFetch(depth, pixel, 0).r; }

bool fromPrevious() { return readsPrevious != 0u && params.previousValid != 0u; }

// Radiance of the last frame, with the pre-exposure of this one.
vec3 exposedNow(vec3 radiance) { return clampToHalf(params.view.exposureChange * radiance); }

vec3 loadLight(ivec2 cell, int level) {
    if (level > 0) {
        vec3 mean = texelFetch(lightMips, cell + ivec2(0, levelRow(ivec2(params.view.size), level)), 0).rgb;
        return fromPrevious() ? exposedNow(mean) : mean;
    }
    return fromPrevious() ? exposedNow(imageLoad(previousLit, cell).rgb) : imageLoad(light, cell).rgb;
}
#include "effects/lobe/last_frame.glsl"
#include "effects/light_mips/light_mips.glsl"

// Whether the pixel shows a metal that is left out.
bool isLeftOut(ivec2 pixel) {
    MaterialTexel m = unpackMaterial(texelFetch(hitMaterial, pixel, 0));
    bool isMirror = m.roughness <= smoothestMirror;
    return m.metallic > 0.5 && (isMirror || (metalsLeftOut == MetalsLeftOut_smooth && m.roughness < roughestView));
}

// Of what the pixel shows, the radiance that lamps stand for.
vec3 emitterAt(ivec2 pixel) {
    bool emits = (unpackMaterial(texelFetch(hitMaterial, pixel, 0)).flags & materialFlagEmitter) != 0u;
    return emits ? texelFetch(hitEmissive, pixel, 0).rgb : vec3(0.0);
}

// Radiance at the pixel, blurred over `width` pixels. If the last frame is used but did not show the point
// (disocclusion), this frame's light, unblurred.
vec3 allLightAt(ivec2 pixel, float width) {
    vec2 uv = pixelToUv(pixel, params.view.pixel);
    if (fromPrevious()) {
        vec3 p = uvToWorld(uv, loadDepth(pixel), params.view.clipToWorld);
        vec3 n = unpackUnitVector(texelFetch(geometricNormal, pixel, 0).r);
        uv = uvInLastFrame(pixel, uv);
        if (!wasShown(uv, pixel, p, n)) {
            return imageLoad(light, pixel).rgb;
        }
    }
    if (cones != 0u && width > 1.0) {
        return blurredLight(uv * params.view.size, width, ivec2(params.view.size));
    }
    return loadLight(ivec2(uv * params.view.size), 0);
}

// highlighted: of the ray.
vec3 lightAt(ivec2 pixel, float width, bool highlighted) {
    vec3 light = allLightAt(pixel, width);
    if (emittersAtHits != EmittersAtHits_all) {
        bool all = emittersAtHits == EmittersAtHits_notHighlighted && !highlighted;
        light = all ? light : max(light - emitterAt(pixel), vec3(0.0));
    }
    return light;
}

#endif
