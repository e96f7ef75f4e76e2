// Reflections of emitters by rough surfaces: highlights of the lamps that stand for them. Rays find small emitters too rarely
// in wide lobes; in narrow ones they show their shape.
#ifndef REFLET_EMITTER_HIGHLIGHT_GLSL
#define REFLET_EMITTER_HIGHLIGHT_GLSL

#include "effects/lamps.h"
#include "shaders/ggx.glsl"

// Perceptual roughness up to which rays show emitters, and from which lamps alone do. Measured on a ball, a tube and a
// panel: from 0.15 on the error of highlights, whose shape is about the emitter's, is less than that of rays.
const float showsEmitters = 0.1;
const float showsHighlights = 0.15;

// Share of the emitters' reflection that lamps bring. roughest: rougher lobes are read from prefiltered light.
float highlightShare(float roughness, float roughest) {
    float share = clamp((roughness - showsEmitters) / (showsHighlights - showsEmitters), 0.0, 1.0);
    return roughness <= roughest ? share : 0.0;
}

const float twiceVariance = 2.0;
const float halfSpread = 4.0;

// Of a symmetric matrix (xx, yy, xy).
float determinantOf(vec3 m) { return max(m.x * m.y - m.z * m.z, 1e-12); }
float squareOver(vec3 m, vec2 at) {
    return (m.y * at.x * at.x - 2.0 * m.z * at.x * at.y + m.x * at.y * at.y) / determinantOf(m);
}

// An emitter's highlight at p: specular BRDF times cosine, mean over the emitter's points. These spread the slopes of the half
// vector, by their covariance; GGX of that much more than alpha² stands for the mean (as for a Gaussian lobe of slopes,
// of which alpha² is twice the variance; compare Olano and Baker, LEAN Mapping, I3D 2010). toLamp: unit, from p.
vec3 emitterHighlight(LampParams lamp, Surface s, vec3 p, vec3 n, vec3 v, vec3 toLamp) {
    vec3 h = v + toLamp;
    float nl = dot(n, toLamp);
    float hz = max(dot(n, h), 1e-3);
    mat3 frame = s.anisotropy != vec2(0.0) ? anisotropicBasis(n, s.anisotropy) : basisAround(n);
    vec2 slope = (h * frame).xy / hz;
    float scale = lamp.radius / (hz * max(distance(lamp.position, p), 1e-4));  // of slopes by the emitter's points
    vec3 x = scale * (frame[0] - dot(frame[0], toLamp) * toLamp);
    vec3 y = scale * (frame[1] - dot(frame[1], toLamp) * toLamp);
    vec2 a = unpackHalf2x16(floatBitsToUint(lamp.extent.x));
    vec2 b = unpackHalf2x16(floatBitsToUint(lamp.extent.y));
    vec2 c = unpackHalf2x16(floatBitsToUint(lamp.extent.z));
    mat3 extent = mat3(a.x, b.y, c.x, b.y, a.y, c.y, c.x, c.y, b.x);
    float alpha = s.roughness * s.roughness;
    vec2 widths = s.anisotropy != vec2(0.0) ? anisotropicAlpha(alpha, s.anisotropy) : vec2(alpha);
    vec3 extentX = extent * x;
    vec3 own = vec3(widths * widths, 0.0);
    vec3 spread = twiceVariance * vec3(dot(x, extentX), dot(y, extent * y), dot(y, extentX));
    // The mean changes the lobe's middle; its tail stays as it is.
    float far = squareOver(own + spread, slope);
    vec3 wide = own + spread / (1.0 + far * far / (halfSpread * halfSpread));
    float off = 1.0 + squareOver(wide, slope);
    float nh2 = hz * hz / dot(h, h);
    float d = 1.0 / (pi * sqrt(determinantOf(wide)) * off * off * nh2 * nh2);
    float lobe = d * ggxVisibility(max(nl, 0.0), max(dot(n, v), 1e-4), alpha) * max(nl, 0.0);
    return fresnelSchlick(s.f0, s.f90, dot(v, h) * inversesqrt(dot(h, h))) * s.compensation * lobe;
}

#endif
