// Parallax-corrected probe lookup: cube maps are sampled where the ray leaves the probe's box.
// The includer declares `probeLobes`, `probeIrradiance`, `probeDistance`, uint probeCount() and ProbeParams
// loadProbe(uint index).
#ifndef REFLET_PROBES_GLSL
#define REFLET_PROBES_GLSL

// The includer may define it to read other cubes.
#ifndef PROBE_RADIANCE
#define PROBE_RADIANCE(at, level) textureLod(probeLobes, at, level)
#endif

#include "effects/cube_map/cube_map.glsl"
#include "effects/probe/probes.h"

// 1 inside of the box, fading to 0 outside of it over its blend distance, but at least leastBlend metres. Walls lie on the box itself, so the fade is outside.
float insideBox(ProbeParams probe, vec3 p, float leastBlend) {
    vec3 outside = max(max(probe.boxMin - p, p - probe.boxMax), vec3(0.0));
    float rounding = 1e-3 * length(probe.boxMax - probe.boxMin);  // counts surfaces on the box as inside
    return 1.0 - smoothstep(0.0, max(max(probe.blend, leastBlend), rounding), length(outside));
}

// Metres along the ray to the far side of the box that stands for the surroundings. For a point outside, the box is
// extended to the point.
float distanceToBox(ProbeParams probe, vec3 p, vec3 direction) {
    bvec3 along = lessThan(abs(direction), vec3(1e-6));  // sides parallel to the ray are never hit
    vec3 d = mix(direction, vec3(1.0), along);
    vec3 far = max((min(probe.parallaxMin, p) - p) / d, (max(probe.parallaxMax, p) - p) / d);
    far = mix(far, vec3(1e6), along);
    return min(far.x, min(far.y, far.z));
}

// Nearer probes count more.
float weightOfProbe(ProbeParams probe, vec3 p, float inside) {
    vec3 away = p - probe.position;
    vec3 size = probe.boxMax - probe.boxMin;
    float d2 = dot(away, away) + min(1e-4, 1e-6 * dot(size, size));
    return inside / (d2 * d2);
}

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
    uint parallax;     // ProbeParallax, the most exact one of all probes, which each may lower
    float blend;       // metres, at least, over which probes fade out
    float pick;        // 0..1: one probe answers, chosen by this number in proportion to the weights; -1: all do
};

// Probes below this share of the largest weight are ignored; it is subtracted from the others' weights for continuity.
const float smallestShare = 0.05;
float shareOfProbe(ProbeParams probe, ProbeQuery q, float largest) {
    float weight = weightOfProbe(probe, q.origin, insideBox(probe, q.origin, q.blend));
    return max(weight / max(largest, 1e-30) - smallestShare, 0.0);
}

// Where a ray ends in a probe's view.
struct ProbePoint {
    vec3 direction;  // from the probe, any length
    float distance;  // metres along the ray; 0: sky
    float certainty;
};

const uint probeSteps = 10u;
const uint probeRefinements = 6u;
const float sameSurface = 1.15;  // a ray farther than the surface by a larger factor passes behind its edge
const float inFront = 1.02;      // the ray counts as seen where it is nearer than the surface by this factor
const float enough = 0.5;        // certainty at which no other probe is asked, if one answers
const float uncertain = 0.05;    // certainty where the probe sees nothing of the ray

// A ray's point: part 0 is its start, part 1 infinitely far. Returns 1 / distance from the probe.
float alongRay(vec3 first, vec3 direction, float nearness, float part, out vec3 fromProbe) {
    fromProbe = mix(first, direction, part);
    return (1.0 - part) * nearness * inversesqrt(max(dot(fromProbe, fromProbe), 1e-12));
}

// Marches the ray through the probe's distances: it ends where it passes from the space that the probe sees to behind a
// surface, or in the sky (Szirmay-Kalos, Aszódi, Lazányi and Premecz, Approximate Ray-Tracing on the GPU with Distance
// Impostors, 2005; McGuire, Mara, Nowrouzezahrai and Luebke, Real-Time Global Illumination using Precomputed Light Field
// Probes, I3D 2017). start: from the probe.
bool marchProbe(uint probe, vec3 start, vec3 direction, out ProbePoint point) {
    float from = max(length(start), 1e-9);
    vec3 first = start / from;
    float nearness = 1.0 / from;
    bool inSight = false;
    float near = 0.0;
    float far = 1.0;
    float seenFar = 0.0;
    uint stepped = 0u;
    uint refining = 0u;  // bisections left between near and far; one loop for both, because each lane has its own turn
    vec3 at;
    while (stepped < probeSteps || refining > 0u) {
        bool bisects = refining > 0u;
        float part = bisects ? 0.5 * (near + far) : float(stepped + 1u) / float(probeSteps);
        float mine = alongRay(first, direction, nearness, part, at);
        float seen = textureLod(probeDistance, vec4(at, float(probe)), 0.0).r;
        bool behind = mine <= seen && (bisects || (inSight && seen > 0.0));
        far = behind ? part : far;
        seenFar = behind ? seen : seenFar;
        near = behind ? near : part;
        refining = bisects ? refining - 1u : (behind ? probeRefinements : 0u);
        if (bisects && refining == 0u) {
            if (seenFar <= sameSurface * alongRay(first, direction, nearness, far, at)) {
                point = ProbePoint(at, from * far / max(1.0 - far, 1e-6), 1.0);
                return true;
            }
            inSight = false;  // it passed behind an edge
            near = float(stepped) / float(probeSteps);
        }
        stepped += bisects ? 0u : 1u;
        inSight = inSight || (!bisects && mine > inFront * seen);
    }
    point = ProbePoint(direction, 0.0, 1.0);
    return inSight;
}

// 1 where the probe sees the point, less where something hides it.
float inSightOf(uint i, vec3 fromProbe) {
    float seen = textureLod(probeDistance, vec4(fromProbe, float(i)), 0.0).r;
    return mix(uncertain, 1.0, 1.0 - smoothstep(1.05, 1.25, seen * length(fromProbe)));
}

ProbePoint endOfRay(uint i, ProbeParams probe, ProbeQuery q) {
    vec3 start = q.origin - probe.position;
    ProbePoint point;
    if (q.parallax == ProbeParallax_none || probe.parallax == ProbeParallax_none) {
        float seen = textureLod(probeDistance, vec4(q.direction, float(i)), 0.0).r;
        return ProbePoint(q.direction, seen > 0.0 ? 1.0 / seen : 0.0, 1.0);
    }
    bool marches = q.parallax == ProbeParallax_depth && probe.parallax == ProbeParallax_depth;
    if (marches && marchProbe(i, start, q.direction, point)) {
        return point;
    }
    float t = distanceToBox(probe, q.origin, q.direction);
    return ProbePoint(start + t * q.direction, t, marches ? uncertain : 1.0);
}

// Adds one probe's contribution.
void sampleProbe(uint i, ProbeParams probe, ProbeQuery q, inout float share, inout vec4 radiance,
                 inout float hitDistance) {
    if (q.hemisphere) {
        share *= q.parallax == ProbeParallax_depth && probe.parallax == ProbeParallax_depth ? inSightOf(i, q.origin - probe.position) : 1.0;
        vec4 seen = share * irradianceOfProbe(i, q.direction) * vec4(vec3(probe.radianceScale), 1.0);
        radiance += seen;
        hitDistance += seen.a * distanceToBox(probe, q.origin, q.direction);
        return;
    }
    ProbePoint point = endOfRay(i, probe, q);
    share *= point.certainty;
    vec4 seen = share * PROBE_RADIANCE(vec4(point.direction, float(i)), lobeLevel(probeLobes, q.roughness));
    seen.rgb *= probe.radianceScale;
    radiance += seen;
    hitDistance += seen.a * point.distance;
}

struct ProbeAnswer {
    vec4 seen;          // rgb: radiance · a; a: confidence, 0..1: lower at box borders and toward the sky
    float hitDistance;  // metres
    float certainty;    // 0..1: how much of the answer was seen by probes rather than guessed from their boxes
};

// Continuous in the origin, or, if one probe answers, in the mean.
ProbeAnswer sampleProbes(ProbeQuery q) {
    uint count = probeCount();
    float inside = 0.0;
    float largest = 0.0;
    float total = 0.0;
    for (uint i = 0u; i < count; ++i) {
        ProbeParams probe = loadProbe(i);
        float b = insideBox(probe, q.origin, q.blend);
        inside = max(inside, b);
        largest = max(largest, weightOfProbe(probe, q.origin, b));
    }
    for (uint i = 0u; i < count; ++i) {
        total += shareOfProbe(loadProbe(i), q, largest);
    }
    vec4 sum = vec4(0.0);
    float weights = 0.0;
    float asked = 0.0;   // the same without their certainty
    float before = 0.0;  // the weight of the probes before this one
    float hitDistance = 0.0;
    bool one = q.pick >= 0.0;
    float chosen = one ? q.pick * total : 0.0;
    // If the chosen one does not see the ray, the next may. In turn around the probes; !one: once.
    uint turns = inside > 0.0 ? (one ? 2u : 1u) * count : 0u;
    uint k = 0u;
    while (k < turns) {
        // First finds the next probe to ask, which costs little, so that neighbouring rays ask theirs together.
        uint i = 0u;
        float weight = 0.0;
        while (k < turns && weight == 0.0) {
            i = k < count ? k : k - count;
            float share = shareOfProbe(loadProbe(i), q, largest);
            before += share;
            weight = before > chosen ? share : 0.0;
            k = before >= chosen + total ? turns : k + 1u;  // then all were asked
        }
        if (weight > 0.0) {
            float share = weight;
            sampleProbe(i, loadProbe(i), q, share, sum, hitDistance);
            weights += share;
            asked = one ? max(asked, weight) : asked + weight;
            k = one && share > enough * weight ? turns : k;
        }
    }
    hitDistance /= max(sum.a, 1e-6);
    sum /= max(weights, 1e-6);
    return ProbeAnswer(inside * sum, hitDistance, min(weights / max(asked, 1e-6), 1.0));
}

#endif
