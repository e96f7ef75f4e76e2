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
    uint parallax;     // ProbeParallax
    float blend;  // metres
};

// Where a ray ends in a probe's view.
struct ProbePoint {
    vec3 direction;  // from the probe, any length
    float distance;  // metres along the ray; 0: sky
    float certainty;
};

const uint probeSteps = 16u;
const uint probeRefinements = 5u;
const float sameSurface = 1.15;  // a ray farther than the surface by a larger factor passes behind its edge
const float inFront = 1.02;    // the ray counts as seen where it is nearer than the surface by this factor
const float uncertain = 0.05;  // certainty where the probe sees nothing of the ray

// Marches the ray through the probe's distances: it ends where it passes from the space that the probe sees to behind a
// surface, or in the sky (Szirmay-Kalos, Aszódi, Lazányi and Premecz, Approximate Ray-Tracing on the GPU with Distance
// Impostors, 2005; McGuire, Mara, Nowrouzezahrai and Luebke, Real-Time Global Illumination using Precomputed Light Field
// Probes, I3D 2017). Seen from the probe, the ray is an arc of a great circle from its origin to its direction. Steps are
// equal angles on it; by the sine rule, the ray's distance from the probe there is |start| · sin(all) / sin(all - angle).
bool marchProbe(uint probe, vec3 start, vec3 direction, out ProbePoint point) {
    float from = max(length(start), 1e-4);
    vec3 first = start / from;
    float cosine = dot(first, direction);
    float sine = length(cross(first, direction));
    if (sine < 1e-3) {
        float seen = textureLod(probeDistance, vec4(direction, float(probe)), 0.0).r;
        point = ProbePoint(direction, seen > 0.0 ? max(1.0 / seen - cosine * from, 0.0) : 0.0, 1.0);
        return cosine > 0.0;
    }
    float all = atan(sine, cosine);
    vec3 aside = (direction - cosine * first) / sine;  // unit, in the arc's plane
    float reciprocal = 1.0 / (from * sine);
    bool inSight = false;
    float near = 0.0;
    for (uint i = 1u; i <= probeSteps; ++i) {
        float angle = all * (float(i) / float(probeSteps));
        vec3 at = cos(angle) * first + sin(angle) * aside;
        float seen = textureLod(probeDistance, vec4(at, float(probe)), 0.0).r;
        float mine = sin(all - angle) * reciprocal;  // 1 / distance of the ray from the probe
        if (inSight && seen > 0.0 && mine <= seen) {
            float far = angle;
            for (uint k = 0u; k < probeRefinements; ++k) {
                float middle = 0.5 * (near + far);
                at = cos(middle) * first + sin(middle) * aside;
                float seenThere = textureLod(probeDistance, vec4(at, float(probe)), 0.0).r;
                bool behind = sin(all - middle) * reciprocal <= seenThere;
                near = behind ? near : middle;
                far = behind ? middle : far;
                seen = behind ? seenThere : seen;
            }
            if (seen <= sameSurface * sin(all - far) * reciprocal) {
                at = cos(far) * first + sin(far) * aside;
                point = ProbePoint(at, from * sin(far) / max(sin(all - far), 1e-6), 1.0);
                return true;
            }
            inSight = false;
        }
        inSight = inSight || mine > inFront * seen;
        near = angle;
    }
    point = ProbePoint(direction, 0.0, 1.0);
    return inSight;
}

ProbePoint endOfRay(uint i, ProbeParams probe, ProbeQuery q) {
    vec3 start = q.origin - probe.position;
    ProbePoint point;
    if (q.parallax == ProbeParallax_none) {
        float seen = textureLod(probeDistance, vec4(q.direction, float(i)), 0.0).r;
        return ProbePoint(q.direction, seen > 0.0 ? 1.0 / seen : 0.0, 1.0);
    }
    if (q.parallax == ProbeParallax_depth && marchProbe(i, start, q.direction, point)) {
        return point;
    }
    float t = distanceToBox(probe, q.origin, q.direction);
    return ProbePoint(start + t * q.direction, t, q.parallax == ProbeParallax_depth ? uncertain : 1.0);
}

// Adds one probe's contribution.
void sampleProbe(uint i, ProbeParams probe, ProbeQuery q, inout float share, inout vec4 radiance,
                 inout float hitDistance) {
    if (q.hemisphere) {
        vec4 seen = share * irradianceOfProbe(i, q.direction);
        radiance += seen;
        hitDistance += seen.a * distanceToBox(probe, q.origin, q.direction);
        return;
    }
    ProbePoint point = endOfRay(i, probe, q);
    share *= point.certainty;
    vec4 seen = share * textureLod(probeLobes, vec4(point.direction, float(i)), lobeLevel(probeLobes, q.roughness));
    radiance += seen;
    hitDistance += seen.a * point.distance;
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
            sampleProbe(i, block.probes[i], q, weight, sum, hitDistance);  // may lower the weight
            weights += weight;
        }
    }
    hitDistance /= max(sum.a, 1e-6);
    sum /= max(weights, 1e-6);
    return inside * sum;
}

#endif
