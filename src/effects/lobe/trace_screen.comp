// Screen-space ray tracing (SSR, SSGI): marches rays through the depth buffer; a hit takes the radiance stored there.
// The same for planar reflections, with rays that start on the mirror and the mirrored camera's buffers.
// In: depth and geometric normal of the rays' origins; of the traced view: depth of both layers, geometric normal,
// motion, pyramid, light of this and the last frame and mips of one of them; ray directions, the list.
// Out: results, sources, steps, motion of reflected images, the list of misses.
#version 460
#extension GL_EXT_scalar_block_layout : require
#include "effects/lobe/answer_environment.h"
#include "effects/lobe/rays.glsl"
#include "effects/lobe/trace_screen.h"
#include "effects/gbuffer/gbuffer.glsl"
#include "effects/levels.glsl"
#include "effects/pyramid/pyramid.h"
#include "shaders/noise.glsl"
#include "shaders/projection.glsl"

layout(constant_id = 0) const uint method = 0u;
layout(constant_id = 1) const uint secondLayer = 0u;
layout(constant_id = 2) const uint countSteps = 0u;
layout(constant_id = 3) const uint cones = 0u;
layout(constant_id = 4) const uint through = 0u;
layout(constant_id = 5) const uint tellsMotion = 0u;

layout(local_size_x = 64) in;
layout(scalar) uniform ParamsBlock { TraceScreenParams params; };
uniform sampler2D ownDepth;
uniform usampler2D ownGeometricNormal;
uniform sampler2D depth;
uniform usampler2D geometricNormal;
layout(rgba16f) uniform readonly image2D light;
layout(rgba16f) uniform readonly image2D previousLit;
uniform sampler2D motion;
layout(rg32f) uniform readonly image2D pyramid;
uniform sampler2D backDepth;
uniform sampler2D lightMips;
layout(r32f) uniform writeonly image2DArray steps;
layout(rg16f) uniform writeonly image2D imageMotion;
layout(rg32ui) uniform readonly uimage2DArray direction;
#include "effects/lobe/rays_waiting.glsl"
layout(rgba16f) uniform image2DArray answer;
layout(rgba8) uniform image2DArray source;
#include "effects/lobe/rays_append.glsl"
#include "effects/lobe/rays_answer.glsl"

float loadDepth(ivec2 pixel) { return texelFetch(depth, pixel, 0).r; }
float loadBackDepth(ivec2 pixel) { return texelFetch(backDepth, pixel, 0).r; }
vec2 loadCell(ivec2 cell, int level) {
    return imageLoad(pyramid, cell + ivec2(0, levelRow(ivec2(params.view.size), level))).rg;
}
#include "effects/lobe/trace_ray.glsl"

// Width of the blur relative to the radius that holds half of the lobe's energy. 1.7 would match the lobe if both were
// Gaussian. Of 1.2, 2.4, 3.4 and 4.8, 3.4 is closest to 64 stochastic rays on gloss (max_roughness 0.2, 1 and 4 rays);
// on colonnade (max_roughness 0.5) narrower is better, 2.4 by 5 % of the relative MSE.
const float coneWidth = 3.4;

bool fromPrevious() { return params.settings.light == HitLight_previous && params.previousValid != 0u; }

vec3 loadLight(ivec2 cell, int level) {
    if (level > 0) {
        return texelFetch(lightMips, cell + ivec2(0, levelRow(ivec2(params.view.size), level)), 0).rgb;
    }
    return fromPrevious() ? imageLoad(previousLit, cell).rgb : imageLoad(light, cell).rgb;
}
#include "effects/lobe/last_frame.glsl"
#include "effects/light_mips/light_mips.glsl"

// Radiance at the pixel, blurred over `width` pixels. If the last frame is used but did not show the point
// (disocclusion), this frame's light, unblurred.
vec3 lightAt(ivec2 pixel, float width) {
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

// Width in pixels of a cone's footprint at its hit.
float widthOfHit(float roughness, MarchResult hit) {
    if (roughness == 0.0) {
        return 1.0;
    }
    float away = depthToViewDistance(loadDepth(hit.pixel), params.view.depthToDistance);
    float pixelWidth = params.view.pixelAngle * (params.view.eye.w > 0.0 ? away : 1.0);  // metres
    return coneWidth * ggxConeTangent(roughness * roughness) * hit.distance / pixelWidth;
}

MarchResult traceRay(MarchRay ray, MarchOptions o, MarchView view) {
    // On a smooth mirror, rays point straight away from the mirrored camera and stay within one pixel, which stepping
    // would skip.
    if (through == throughMirror && all(lessThan(abs(makeScreenRay(ray, o.maxDistance, view).delta.xy), vec2(1.0)))) {
        return marchExhaustive(ray, o, view);
    }
    return marchBy(method, ray, o, view);
}

const RayAnswer noAnswer = RayAnswer(vec3(0.0), 0.0, 0.0);
#include "effects/planar/mirror_answers.glsl"

// Passes the unoccluded distance on to the next source, unless an earlier source found a longer one.
void updateClearDistance(MarchResult hit, bool lost, inout WaitingRay w) {
    if (hit.clear >= w.clear) {
        w.clear = hit.clear;
        w.lost = lost;
    }
}

// Writes the motion of the reflected image caused by the hit object's own motion.
void writeReflectionMotion(ivec2 pixel, Ray ray, vec3 p, MarchResult hit) {
    vec3 there = uvToWorld(pixelToUv(hit.pixel, params.view.pixel), loadDepth(hit.pixel), params.view.clipToWorld);
    vec3 displacement = displacementAt(hit.pixel, there);
    if (displacement != vec3(0.0)) {
        vec2 moved = mirroredMotion(p, directionToEye(p, params.own.eye), ray.direction, hit.distance, displacement,
                                    params.own.previousWorldToClip);
        imageStore(imageMotion, pixel, vec4(moved, 0.0, 0.0));
    }
}

RayAnswer traceAnswer(ivec3 slot, Ray ray, vec3 p, vec3 n, inout WaitingRay w) {
    float jitter = 1.0;
    if (params.settings.jitter != 0u) {
        uint stream = (params.firstRay + uint(slot.z)) * 2u + 1u + hashPcg(params.own.seed);
        jitter = 1.0 - hashToUnit(hashPixel(uvec2(slot.xy), stream, params.own.frame));
    }
    MarchView view = marchView(params.view);
    // The mirror itself is clipped from its planar view, so no surface there needs to be excluded.
    vec4 ownPlane = through == throughScreen ? planeOnScreen(p, n, params.view.clipToWorld) : vec4(0.0, 0.0, 0.0, 1.0);
    MarchOptions options = marchOptions(params.settings, params.longest, secondLayer, jitter);
    MarchResult hit = traceRay(makeMarchRay(p, ray.direction, ownPlane, view), options, view);
    if (countSteps != 0u) {
        imageStore(steps, slot, vec4(float(hit.steps)));
    }
    // The screen does not show the back of a surface.
    bool facesAway = params.settings.rejectBackfaces != 0u && hit.outcome == marchHit &&
                     dot(unpackUnitVector(texelFetch(geometricNormal, hit.pixel, 0).r), ray.direction) > 0.0;
    updateClearDistance(hit, hit.occluded || facesAway, w);
    if (tellsMotion != 0u && slot.z == 0 && hit.outcome == marchHit && !facesAway) {
        writeReflectionMotion(slot.xy, ray, p, hit);
    }
    if (through == throughMirror) {
        return facesAway ? noAnswer : shadeMirrorHit(hit, p, ray);
    }
    if (hit.outcome != marchHit || facesAway) {
        return noAnswer;
    }
    float width = cones != 0u ? widthOfHit(ray.spread, hit) : 1.0;
    float fade = fadeOf(hit, p, ray.direction, params.settings, params.longest, params.view).x;
    return RayAnswer(lightAt(hit.pixel, width), ray.trust * fade, hit.distance);
}

RayAnswer answerRay(ivec3 slot, Ray ray, inout WaitingRay w) {
    if (through == throughScreen && ray.trust == 0.0) {
        return noAnswer;
    }
    float d = texelFetch(ownDepth, slot.xy, 0).r;
    vec3 p = uvToWorld(pixelToUv(slot.xy, params.own.pixel), d, params.own.clipToWorld);
    vec3 n = unpackUnitVector(texelFetch(ownGeometricNormal, slot.xy, 0).r);
    if (through != throughScreen && !liesOnMirror(p, n)) {
        return noAnswer;
    }
    if (through == throughMirrorLookup) {
        return lookUpMirror(p);
    }
    if (through == throughMirrorCamera) {
        return lookUpCamera(p);
    }
    return traceAnswer(slot, ray, p, n, w);
}

void main() {
    uint stride = gl_NumWorkGroups.x * listGroupSize;
    for (uint i = gl_GlobalInvocationID.x; i < waiting.count; i += stride) {
        WaitingRay w = unpackWaitingRay(waiting.items[i]);
        Ray ray = unpackRay(imageLoad(direction, w.slot).xy);
        RayAnswer a = answerRay(w.slot, ray, w);
        // Not ?: of two vectors: with a specialization constant as condition, Mesa 22 gets all components but x wrong.
        vec4 color = sourcePlanar;
        if (through == throughScreen) {
            color = sourceScreen;
        }
        w.rest = addAnswer(w.slot, a, w.rest, color);
        if (w.rest > 0.0) {
            appendRay(w);
        }
    }
}
