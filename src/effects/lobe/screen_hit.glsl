// Screen-space hits: rays marched through the depth buffer, and the radiance at their hits. Bound by bindScreen
// (trace_screen.h).
#ifndef REFLET_SCREEN_HIT_GLSL
#define REFLET_SCREEN_HIT_GLSL

#include "effects/lobe/rays.glsl"
#include "effects/lobe/screen_light.glsl"
#include "shaders/noise.glsl"

layout(constant_id = 20) const uint method = 0u;
layout(constant_id = 21) const uint secondLayer = 0u;
layout(constant_id = 23) const uint tellsMotion = 0u;
// What settings switch off is left out, because CPU devices execute the code of all branches.
layout(constant_id = 24) const uint bisects = 0u;
layout(constant_id = 25) const uint interpolates = 0u;
layout(constant_id = 26) const uint jitters = 0u;
layout(constant_id = 27) const uint rejectsBackfaces = 0u;
layout(constant_id = 28) const uint fades = 0u;
layout(constant_id = 34) const uint certainNext = 0u;

layout(rg32f) uniform readonly image2D pyramid;
#include "effects/pyramid/pyramid.glsl"
uniform sampler2D backDepth;
layout(rg16f) uniform writeonly image2D imageMotion;

float loadBackDepth(ivec2 pixel) { return texelFetch(backDepth, pixel, 0).r; }
vec2 loadCell(ivec2 cell, int level) { return pyramidCell(cell, level, params.view.size); }
#include "effects/lobe/trace_ray.glsl"

// Width of the blur relative to the radius that holds half of the lobe's energy. 1.7 would match the lobe if both were
// Gaussian. Of 1.2, 2.4, 3.4 and 4.8, 3.4 is closest to 64 stochastic rays on gloss (max_roughness 0.2, 1 and 4 rays);
// on colonnade (max_roughness 0.5) narrower is better, 2.4 by 5 % of the relative MSE.
const float coneWidth = 3.4;

// Width in pixels of a cone's footprint at its hit.
float widthOfHit(float roughness, MarchResult hit) {
    if (roughness == 0.0) {
        return 1.0;
    }
    float away = depthToViewDistance(loadDepth(hit.pixel), params.view.depthToDistance);
    float pixelWidth = params.view.pixelAngle * (params.view.eye.w > 0.0 ? away : 1.0);  // metres
    return coneWidth * ggxConeTangent(roughness * roughness) * hit.distance / pixelWidth;
}

// Random length of the first step, in steps, 0..1. number: of the ray in its pixel.
float jitterOf(ivec2 pixel, uint number) {
    if (jitters == 0u) {
        return 1.0;
    }
    return 1.0 - hashToUnit(hashPixel(uvec2(pixel), number * 2u + 1u + hashPcg(params.own.seed), params.own.frame));
}

MarchOptions screenOptions(ivec2 pixel, uint number) {
    MarchOptions o = marchOptions(params.settings, params.longest, secondLayer, jitterOf(pixel, number));
    o.binarySteps = bisects != 0u ? o.binarySteps : 0u;
    o.interpolate = interpolates != 0u;
    return o;
}

// Whether the hit is none: the screen does not show what was hit, or shows of it what the camera alone sees.
bool hitsUnseen(MarchResult hit, vec3 p, Ray ray, MarchOptions o) {
    if (rejectsBackfaces == 0u || hit.outcome != marchHit) {
        return false;
    }
    if (metalsLeftOut != MetalsLeftOut_none && isLeftOut(hit.pixel)) {
        return true;
    }
    vec3 n = unpackUnitVector(texelFetch(geometricNormal, hit.pixel, 0).r);
    return isUnseen(hit, p, ray.direction, n, method, o, certainNext != 0u, params.view);
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

// Radiance of the surface behind which a ray from p passes after `clear` metres: that of the next pixel.
vec3 lightInFront(vec3 p, Ray ray, float clear) {
    vec3 direction = ray.direction;
    vec4 clip = params.view.worldToClip * vec4(p + direction * clear, 1.0);
    vec4 toward = params.view.worldToClip * vec4(direction, 0.0);
    vec2 step = (toward.xy * clip.w - clip.xy * toward.w) * params.view.size;  // any length
    step *= ndcToUv(vec2(1.0)) - ndcToUv(vec2(0.0));
    vec2 at = ndcToUv(clip.xy / clip.w) * params.view.size + 0.5 * step * inversesqrt(max(dot(step, step), 1e-30));
    return lightAt(clamp(ivec2(at), ivec2(0), ivec2(params.view.size) - 1), 1.0, ray.highlighted);
}

// Passes the unoccluded distance on to the next source, unless an earlier source found a longer one.
void updateClearDistance(MarchResult hit, bool unseen, vec3 p, Ray ray, inout WaitingRay w) {
    if (hit.clear >= w.clear) {
        w.clear = hit.clear;
        w.lost = hit.occluded || unseen;
        w.inFront = w.lost ? lightInFront(p, ray, hit.clear) : vec3(0.0);
    }
}

// The radiance at a hit, for a ray from p.
RayAnswer answerOfHit(MarchResult hit, vec3 p, Ray ray) {
    float width = cones != 0u ? widthOfHit(ray.spread, hit) : 1.0;
    float fade = fades != 0u ? fadeOf(hit, p, ray.direction, params.settings, params.longest, params.view).x : 1.0;
    return RayAnswer(lightAt(hit.pixel, width, ray.highlighted), ray.trust * fade, hit.distance);
}

const RayAnswer noAnswer = RayAnswer(vec3(0.0), 0.0, 0.0);

#endif
