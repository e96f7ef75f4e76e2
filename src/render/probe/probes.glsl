// Parallax-corrected probe lookup: cube maps are sampled where the ray leaves the probe's box.
// The includer declares `probeLobes`, `probeIrradiance` and `probeDistance`.
#ifndef REFLET_PROBES_GLSL
#define REFLET_PROBES_GLSL

#include "render/cube_map/cube_map.glsl"
#include "render/probe/probes.h"

// 1 inside of the box, fading to 0 at `blend` metres outside. Walls lie on the box itself, so the fade is outside.
float insideBox(ProbeParams probe, vec3 p, float blend) {
    vec3 outside = max(max(probe.boxMin - p, p - probe.boxMax), vec3(0.0));
    float rounding = 1e-3 * length(probe.boxMax - probe.boxMin);  // counts surfaces on the box as inside
    return 1.0 - smoothstep(0.0, max(blend, rounding), length(outside));
}

// Metres along the ray to the box's far side. For a point outside, the box is extended to the point.
float distanceToBox(ProbeParams probe, vec3 p, vec3 direction) {
    bvec3 along = lessThan(abs(direction), vec3(1e-6));  // sides parallel to the ray are never hit
    vec3 d = mix(direction, vec3(1.0), along);
    vec3 far = max((min(probe.boxMin, p) - p) / d, (max(probe.boxMax, p) - p) / d);
    far = mix(far, vec3(1e6), along);
    return min(far.x, min(far.y, far.z));
}

// Nearer probes count more.
float weightOfProbe(ProbeParams probe, vec3 p, float inside) {
    vec3 away = p - probe.position;
    float d2 = dot(away, away) + 1e-4;
    return inside / (d2 * d2);
}

// Probes below this share of the largest weight are ignored; it is subtracted from the others' weights for continuity.
const float smallestShare = 0.05;

// Irradiance / pi for the normal n. rgb: radiance · alpha.
vec4 irradianceOfProbe(uint probe, vec3 n) {
    float[irradianceCoefficients] basis = sphericalHarmonics(n);
    vec4 sum = vec4(0.0);
    for (uint i = 0u; i < irradianceCoefficients; ++i) {
        sum += texelFetch(probeIrradiance, ivec2(i, probe), 0) * basis[i];
    }
    return vec4(max(sum.rgb, vec3(0.0)), clamp(sum.a, 0.0, 1.0));
}

struct ProbeQuery {
    vec3 origin;
    vec3 direction;    // unit
    float roughness;   // perceptual, of the lobe around the direction; 0: the exact direction
    bool hemisphere;   // instead: cosine-weighted hemisphere around the direction
    bool parallax;
    float blend;  // metres
};

// Adds one probe's contribution.
void sampleProbe(uint i, ProbeParams probe, ProbeQuery q, float share, inout vec4 radiance, inout float hitDistance) {
    float t = distanceToBox(probe, q.origin, q.direction);
    vec3 at = q.parallax ? q.origin + t * q.direction - probe.position : q.direction;
    vec4 seen = share * (q.hemisphere ? irradianceOfProbe(i, q.direction)
                                      : textureLod(probeLobes, vec4(at, float(i)), lobeLevel(probeLobes, q.roughness)));
    radiance += seen;
    hitDistance += seen.a * (q.parallax ? t : textureLod(probeDistance, vec4(at, float(i)), 0.0).r);
}

// rgb: radiance · a; a: confidence, 0..1: lower at box borders and toward the sky. Continuous in the origin.
vec4 sampleProbes(ProbeBlock block, ProbeQuery q, out float hitDistance) {
    float inside = 0.0;
    float largest = 0.0;
    for (uint i = 0u; i < block.count; ++i) {
        float b = insideBox(block.probes[i], q.origin, q.blend);
        inside = max(inside, b);
        largest = max(largest, weightOfProbe(block.probes[i], q.origin, b));
    }
    vec4 sum = vec4(0.0);
    float weights = 0.0;
    hitDistance = 0.0;
    for (uint i = 0u; i < block.count && inside > 0.0; ++i) {
        float b = insideBox(block.probes[i], q.origin, q.blend);
        float weight = weightOfProbe(block.probes[i], q.origin, b) / largest - smallestShare;
        if (weight > 0.0) {
            sampleProbe(i, block.probes[i], q, weight, sum, hitDistance);
            weights += weight;
        }
    }
    hitDistance /= max(sum.a, 1e-6);
    sum /= max(weights, 1e-6);
    return inside * sum;
}

#endif
