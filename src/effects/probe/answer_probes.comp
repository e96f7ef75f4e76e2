// Gives the remaining rays the radiance of reflection probes. In: the list, ray directions, depth, material, cube maps.
// Out: results, sources, the list of remaining rays.
#version 460
#extension GL_EXT_scalar_block_layout : require
#include "effects/lobe/rays.glsl"
#include "effects/probe/answer_probes.h"
#include "shaders/noise.glsl"
#include "shaders/projection.glsl"

layout(constant_id = 0) const uint lobe = 0u;
// Constants, because CPU devices execute the code of all branches.
layout(constant_id = 1) const uint spreads = 0u;
layout(constant_id = 2) const uint parallax = 0u;
layout(constant_id = 3) const uint highlights = 0u;  // rays may be Ray.highlighted

layout(local_size_x = 64) in;
layout(scalar) uniform ParamsBlock {
    AnswerProbesParams params;
};
uniform sampler2D depth;
uniform sampler2D material;
uniform samplerCubeArray probeLobes;
uniform samplerCubeArray probeMatte;  // as probes.diffuse
uniform samplerCubeArray probeDistance;
layout(rg32ui) uniform readonly uimage2DArray direction;
#include "effects/lobe/ray_origin.glsl"
#include "effects/lobe/rays_waiting.glsl"
layout(rgba16f) uniform image2DArray answer;
layout(rgba8) uniform image2DArray source;
uniform sampler2D probeIrradiance;
#include "effects/lobe/rays_answer.glsl"
#include "effects/lobe/rays_append.glsl"
#include "effects/ambient_occlusion/ambient_visibility.glsl"

uint probeCount() { return params.probes.count; }
ProbeParams loadProbe(uint index) { return params.probes.probes[index]; }

bool highlighted = false;  // the ray

vec4 probeRadiance(vec4 at, float level) {
    vec4 radiance = textureLod(probeLobes, at, level);
    if (highlights != 0u) {
        radiance = highlighted ? textureLod(probeMatte, at, 0.0) : radiance;
    }
    return radiance;
}
#define PROBE_RADIANCE(at, level) probeRadiance(at, level)
#include "effects/probe/probes.glsl"

const float seenCertainly = 0.5;

ProbeAnswer askProbes(ivec3 slot, Ray ray) {
    ivec2 pixel = slot.xy;
    highlighted = ray.highlighted;
    float d = texelFetch(depth, pixel, 0).r;
    vec3 p = rayOrigin(slot, d, params.view);
    bool hemisphere = spreads != 0u && lobe == lobeDiffuse && ray.spread > 0.0;
    // Scattered rays are averaged over frames anyway. A mirror's would show the choice as grain.
    uint stream = params.firstRay + uint(slot.z) + hashPcg(params.view.seed + 11u);
    bool one = lobe == lobeDiffuse && !hemisphere;
    float pick = one ? hashToUnit(hashPixel(uvec2(pixel), stream, params.view.frame)) : -1.0;
    ProbeQuery q = ProbeQuery(p, ray.direction, hemisphere ? 0.0 : ray.spread, hemisphere, parallax, 0.0, pick);
    ProbeAnswer a = sampleProbes(q);
    // Occlusion maps stand for nearby geometry that the rays could not hit.
    float occlusion = lobe == lobeDiffuse ? texelFetch(material, pixel, 0).b : 1.0;
    occlusion = min(occlusion, ambientVisibility(pixel, ray));
    a.seen.rgb *= occlusion;
    return a;
}

void main() {
    uint stride = gl_NumWorkGroups.x * listGroupSize;
    for (uint i = gl_GlobalInvocationID.x; i < waiting.count; i += stride) {
        WaitingRay w = unpackWaitingRay(waiting.items[i]);
        if (!isKnownMiss(w)) {  // else the ray is known to reach the sky, which a probe's box would hide
            Ray ray = unpackRay(imageLoad(direction, w.slot).xy);
            ProbeAnswer a = askProbes(w.slot, ray);
            RayAnswer answer = RayAnswer(a.seen.rgb / max(a.seen.a, 1e-4), a.seen.a, a.hitDistance);
            w.rest = addAnswer(w.slot, answer, w.rest, sourceProbe);
            w.lost = w.lost && a.certainty < seenCertainly;  // else what is left is the sky
        }
        if (w.rest > 0.0) {
            appendRay(w);
        }
    }
}
