// Direct light of sun and lamps at a surface with shadow rays: one sample of the sun's disk, and one of a randomly
// chosen lamp's disk. The same estimator as in the reference path tracer.
// The includer first defines SceneLights sceneLights(), LampParams loadLamp(uint index),
// uint lampCount(), float sunMapVisibility(vec3 p, vec3 normal): 0 or 1, or -1 to trace a ray; and includes the
// traversal, for anyHit.
#ifndef REFLET_SCENE_LIGHT_GLSL
#define REFLET_SCENE_LIGHT_GLSL

#include "renderer/trace_scene/trace_scene.h"
#include "shaders/ggx.glsl"
#include "shaders/lamp.glsl"
#include "shaders/luminance.glsl"
#include "shaders/noise.glsl"

const float mirrorClearance = 1e-3;  // of a ray that ends in a mirror, as a share of its length
const float sceneFar = 1e30;  // metres: farther than anything

// Pseudorandom numbers in [0, 1).
float nextRandom(inout uint state) {
    state += 0x9e3779b9u;
    return hashToUnit(hashPcg(state));
}
vec2 nextRandom2(inout uint state) {
    float first = nextRandom(state);
    return vec2(first, nextRandom(state));
}

// A point to be shaded.
struct LitPoint {
    vec3 position;         // world space
    vec3 geometricNormal;  // unit, on the side of the viewer
    vec3 normal;           // unit, shading
    vec3 toViewer;         // unit
    float clearance;       // offset of ray origins from the surface [m]
    Surface surface;
};

// An unoccluded light sample and its shadow ray.
struct LightRay {
    vec3 light;
    vec3 direction;  // the ray ends at `far` times this
    float far;
    vec3 behind;     // direction of a second ray from the first one's end, where a mirror has turned the light; or 0
    bool casts;      // false: needs no shadow ray
    bool sun;
};

// BRDF · cos, zero if the light is behind the geometric normal.
vec3 reflectToViewer(LitPoint at, vec3 toLight) {
    return dot(toLight, at.geometricNormal) > 0.0 ? brdfTimesCosine(at.surface, at.normal, at.toViewer, toLight)
                                                  : vec3(0.0);
}

vec2 diskPoint(vec2 u) { return sqrt(u.x) * vec2(cos(2.0 * pi * u.y), sin(2.0 * pi * u.y)); }

LightRay drawSun(LitPoint at, inout uint random) {
    SceneLights lights = sceneLights();
    // Uniform over the disk's projection, so that all samples have the same weight.
    vec2 place = lights.sunSine * diskPoint(nextRandom2(random));
    float z = sqrt(1.0 - dot(place, place));
    LightRay ray;
    ray.direction = basisAround(lights.toSun) * vec3(place, z);
    ray.light = reflectToViewer(at, ray.direction) * lights.sunIrradiance / z;
    ray.far = sceneFar;
    ray.behind = vec3(0.0);
    ray.casts = true;
    ray.sun = true;
    return ray;
}

float lampStrength(LitPoint at, uint index, out vec3 irradiance, out vec3 toLamp) {
    irradiance = lampIrradiance(loadLamp(index), at.position, toLamp);
    return dot(toLamp, at.geometricNormal) > 0.0 ? luminance(irradiance) : 0.0;
}

// Shadow rays to the mirror and from there to a point of the sun's disk.
void aimAtReflectedSun(LampParams lamp, vec3 origin, vec3 toLamp, vec2 u, inout LightRay ray) {
    vec3 place = vec3(-lamp.radius * lamp.inverseRange * diskPoint(u), 0.0);
    ray.direction = normalize(toLamp + basisAround(toLamp) * place);
    vec3 n = unpackUnitVector(floatBitsToUint(lamp.spotOffset));
    ray.far = distanceToMirror(lamp, origin) * dot(toLamp, n) / min(dot(ray.direction, n), -1e-4);
    ray.behind = reflect(ray.direction, n);
}

// Shadow ray to a point of the lamp's disk, ending at the lamp's clearance (docs/conventions.md). Disks of directional
// lamps are infinitely far away.
void aimAtLamp(LitPoint at, LampParams lamp, vec3 origin, vec3 toLamp, vec2 u, inout LightRay ray) {
    ray.far = sceneFar;
    ray.behind = vec3(0.0);
    if (anyReflected != 0u && lamp.type == lampReflected) {
        aimAtReflectedSun(lamp, origin, toLamp, u, ray);
        return;
    }
    vec2 place = lamp.radius * diskPoint(u);
    vec3 aside = basisAround(toLamp) * vec3(place, 0.0);
    if (lamp.type == lampDirectional) {
        ray.direction = normalize(toLamp + aside);
        return;
    }
    ray.direction = lamp.position + aside - origin;
    float way = length(ray.direction);
    float square = dot(place, place);
    float clearance = max(lamp.radius, 1e-3);
    float inward = square / way;  // from the ray's closest point to the lamp's centre to the ray's end
    float rest = inward * inward + clearance * clearance - square;
    ray.far = 1.0 - (inward + sqrt(max(rest, 0.0))) / way;
}

// Samples one lamp, with probability proportional to its unoccluded luminance here.
LightRay drawLamp(LitPoint at, inout uint random) {
    float choice = nextRandom(random);
    vec2 u = nextRandom2(random);
    LightRay ray;
    ray.light = vec3(0.0);
    ray.behind = vec3(0.0);
    ray.casts = false;
    ray.sun = false;
    vec3 irradiance;
    vec3 toLamp;
    float total = 0.0;
    for (uint i = 0u; i < lampCount(); ++i) {
        total += lampStrength(at, i, irradiance, toLamp);
    }
    float left = choice * total;
    for (uint i = 0u; i < lampCount() && total > 0.0; ++i) {
        float mine = lampStrength(at, i, irradiance, toLamp);
        if (mine > 0.0 && (left < mine || i + 1u == lampCount())) {
            LampParams lamp = loadLamp(i);
            at.surface = surfaceFor(lamp, at.surface);
            ray.light = reflectToViewer(at, toLamp) * irradiance * (total / mine);
            ray.casts = sceneLights().allLampsCast != 0u || lamp.shadow != noLampShadow;
            aimAtLamp(at, lamp, at.position + at.geometricNormal * at.clearance, toLamp, u, ray);
            break;
        }
        left -= mine;
    }
    return ray;
}

bool isHidden(LitPoint at, LightRay ray) {
    if (ray.sun) {
        float known = sunMapVisibility(at.position, at.geometricNormal);
        if (known >= 0.0) {
            return known == 0.0;
        }
    }
    if (!ray.casts || !(ray.far > 0.0)) {
        return false;
    }
    vec3 origin = at.position + at.geometricNormal * at.clearance;
    bool turns = anyReflected != 0u && ray.behind != vec3(0.0);
    float spare = turns ? mirrorClearance * ray.far + at.clearance : 0.0;  // from the mirror, in front of both rays' ends
    bool hidden = false;
    for (uint i = 0u; i < (turns ? 2u : 1u) && !hidden; ++i) {  // a loop, so that the traversal is compiled only once
        vec3 from = i == 0u ? origin : origin + (ray.far - spare) * ray.direction;
        hidden = anyHit(from, i == 0u ? ray.direction : ray.behind, 0.0, i == 0u ? ray.far - spare : sceneFar);
    }
    return hidden;
}

// sunVisible: 1 if the sun is unoccluded.
vec3 sunAndLamps(LitPoint at, inout uint random, out float sunVisible) {
    vec3 sum = vec3(0.0);
    sunVisible = 0.0;
    for (uint i = 0u; i < 2u; ++i) {  // a loop, so that the traversal is compiled only once
        LightRay ray = i == 0u ? drawSun(at, random) : drawLamp(at, random);
        bool faces = i == 0u && dot(ray.direction, at.geometricNormal) > 0.0;
        if ((faces || ray.light != vec3(0.0)) && !isHidden(at, ray)) {
            sum += ray.light;
            sunVisible = faces ? 1.0 : sunVisible;
        }
    }
    return sum;
}

#endif
