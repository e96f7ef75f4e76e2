// Irradiance from the lamps of KHR_lights_punctual.
#ifndef REFLET_LAMP_GLSL
#define REFLET_LAMP_GLSL

#include "effects/lamps.h"
#include "shaders/ggx.glsl"
#include "shaders/octahedral.glsl"

// CPU devices execute the code of all branches.
layout(constant_id = 50) const uint anyEmitters = 1u;
layout(constant_id = 51) const uint anyReflected = 1u;

// Share of its intensity that an emitter sends along `away`, a unit vector.
float emitterProfile(LampParams lamp, vec3 away) {
    vec2 a = unpackHalf2x16(floatBitsToUint(lamp.spotScale));
    vec2 b = unpackHalf2x16(floatBitsToUint(lamp.spotOffset));
    vec2 c = unpackHalf2x16(floatBitsToUint(lamp.cosOuter));
    vec3 turned = vec3(a.x, b.y, c.x) * away.x + vec3(b.y, a.y, c.y) * away.y + vec3(c.x, c.y, b.x) * away.z;
    return max(dot(lamp.toLamp, away) + length(turned), 0.0);
}

// Where the ray from p toward a reflected sun meets the mirror's plane: metres along it; negative: behind the mirror.
float distanceToMirror(LampParams lamp, vec3 p) {
    vec3 n = unpackUnitVector(floatBitsToUint(lamp.spotOffset));
    vec3 centre = lamp.position + lamp.toLamp / lamp.inverseRange;
    return dot(p - centre, n) / max(-dot(lamp.toLamp, n), 1e-4);
}

// Share of the sun's disk that p sees in the mirror, by its width along either side of the mirror.
float shareInMirror(LampParams lamp, vec3 p) {
    float away = distanceToMirror(lamp, p);
    vec3 n = unpackUnitVector(floatBitsToUint(lamp.spotOffset));
    vec3 upward = abs(n.y) < 0.99 ? vec3(0.0, 1.0, 0.0) : vec3(0.0, 0.0, -1.0);  // as up of FlatPiece
    vec3 up = normalize(upward - n * dot(upward, n));
    vec3 at = p + away * lamp.toLamp - (lamp.position + lamp.toLamp / lamp.inverseRange);
    vec2 within = unpackHalf2x16(floatBitsToUint(lamp.spotScale)) - abs(vec2(dot(at, cross(up, n)), dot(at, up)));
    float blur = max(-away * lamp.radius * lamp.inverseRange, 1e-4);
    vec2 share = clamp(0.5 + 0.5 * within / blur, 0.0, 1.0);
    return away > 0.0 ? share.x * share.y : 0.0;
}

// Irradiance on a surface at p that faces the lamp. toLamp: unit, from p.
vec3 lampIrradiance(LampParams lamp, vec3 p, out vec3 toLamp) {
    if (lamp.type == lampDirectional) {
        toLamp = lamp.toLamp;
        return lamp.intensity;
    }
    if (anyReflected != 0u && lamp.type == lampReflected) {
        toLamp = lamp.toLamp;
        return lamp.intensity * shareInMirror(lamp, p);
    }
    vec3 d = lamp.position - p;
    float square = max(dot(d, d), 1e-8);
    toLamp = d * inversesqrt(square);
    if (anyEmitters != 0u && lamp.type == lampEmitter) {
        return lamp.intensity * (emitterProfile(lamp, -toLamp) / (square - lamp.inverseRange));
    }
    float reach = square * lamp.inverseRange * lamp.inverseRange;
    float window = clamp(1.0 - reach * reach, 0.0, 1.0);
    float factor = window / square;
    if (lamp.type == lampSpot) {
        float cone = clamp(dot(toLamp, lamp.toLamp) * lamp.spotScale + lamp.spotOffset, 0.0, 1.0);
        factor *= cone * cone;
    }
    return lamp.intensity * factor;
}

// The part of the surface that the lamp lights.
Surface surfaceFor(LampParams lamp, Surface s) {
    bool showsItself = anyEmitters != 0u && lamp.type == lampEmitter;
    bool betweenMirrors = anyReflected != 0u && lamp.type == lampReflected && s.roughness <= smoothestMirror;
    s.compensation = showsItself || betweenMirrors ? vec3(0.0) : s.compensation;
    return s;
}

#endif
