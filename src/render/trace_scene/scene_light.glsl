// Light of sun and lamps at a surface, with shadow rays: one place on the sun's disk, one of the lamps and a place on its
// disk. What the reference does at each surface of a path.
// The includer defines, before it includes this: SceneLights sceneLights(), LampParams loadLamp(uint index),
// uint lampCount(), float sunMapVisibility(vec3 p, vec3 normal): 0 or 1, or -1 where a ray must tell; and includes the
// traversal, for anyHit.
#ifndef REFLET_SCENE_LIGHT_GLSL
#define REFLET_SCENE_LIGHT_GLSL

#include "render/trace_scene/trace_scene.h"
#include "shaders/ggx.glsl"
#include "shaders/lamp.glsl"
#include "shaders/luminance.glsl"
#include "shaders/noise.glsl"

const float sceneFar = 1e30;  // metres: farther than anything

// Numbers in [0, 1), one after the other.
float nextRandom(inout uint state) {
    state += 0x9e3779b9u;
    return hashToUnit(hashPcg(state));
}
vec2 nextRandom2(inout uint state) {
    float first = nextRandom(state);
    return vec2(first, nextRandom(state));
}

// A point that is lit and seen.
struct LitPoint {
    vec3 position;         // world space
    vec3 geometricNormal;  // unit, on the side of the viewer
    vec3 normal;           // unit, shading
    vec3 toViewer;         // unit
    float clearance;       // metres off the surface at which rays start
    Surface surface;
};

// Light that reaches the viewer, were nothing in the way of the ray that tells whether something is.
struct LightRay {
    vec3 light;
    vec3 direction;  // the ray ends at `far` times this
    float far;
    bool casts;      // false: nothing can be in its way
    bool sun;
};

// From the sides of the triangle and of the shading normal that are lit.
vec3 reflectToViewer(LitPoint at, vec3 toLight) {
    return dot(toLight, at.geometricNormal) > 0.0 ? brdfTimesCosine(at.surface, at.normal, at.toViewer, toLight)
                                                  : vec3(0.0);
}

vec2 diskPoint(vec2 u) { return sqrt(u.x) * vec2(cos(2.0 * pi * u.y), sin(2.0 * pi * u.y)); }

LightRay drawSun(LitPoint at, inout uint random) {
    SceneLights lights = sceneLights();
    // Uniform in the disk's projection on a plane that faces it: every place brings the same.
    vec2 place = lights.sunSine * diskPoint(nextRandom2(random));
    float z = sqrt(1.0 - dot(place, place));
    LightRay ray;
    ray.direction = basisAround(lights.toSun) * vec3(place, z);
    ray.light = reflectToViewer(at, ray.direction) * lights.sunIrradiance / z;
    ray.far = sceneFar;
    ray.casts = true;
    ray.sun = true;
    return ray;
}

float lampStrength(LitPoint at, uint index, out vec3 irradiance, out vec3 toLamp) {
    irradiance = lampIrradiance(loadLamp(index), at.position, toLamp);
    return dot(toLamp, at.geometricNormal) > 0.0 ? luminance(irradiance) : 0.0;
}

// Toward a place on the lamp's disk, up to where the lamp's clearance begins (docs/conventions.md).
void aimAtLamp(LitPoint at, LampParams lamp, vec3 origin, vec3 toLamp, vec2 u, inout LightRay ray) {
    ray.direction = toLamp;
    ray.far = sceneFar;
    if (lamp.type == lampDirectional) {
        return;
    }
    vec2 place = lamp.radius * diskPoint(u);
    ray.direction = lamp.position + basisAround(toLamp) * vec3(place, 0.0) - origin;
    float way = length(ray.direction);
    float square = dot(place, place);
    float clearance = max(lamp.radius, 1e-3);
    float inward = square / way;  // from the ray's point nearest to the lamp to its end
    float rest = inward * inward + clearance * clearance - square;
    ray.far = 1.0 - (inward + sqrt(max(rest, 0.0))) / way;
}

// One of the lamps, with a chance in proportion to the light that it sends here.
LightRay drawLamp(LitPoint at, inout uint random) {
    float choice = nextRandom(random);
    vec2 u = nextRandom2(random);
    LightRay ray;
    ray.light = vec3(0.0);
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
    return ray.casts && ray.far > 0.0 &&
           anyHit(at.position + at.geometricNormal * at.clearance, ray.direction, 0.0, ray.far);
}

// sunVisible: 1: the sun is not hidden.
vec3 sunAndLamps(LitPoint at, inout uint random, out float sunVisible) {
    vec3 sum = vec3(0.0);
    sunVisible = 0.0;
    for (uint i = 0u; i < 2u; ++i) {  // a loop, so that the traversal is there once
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
