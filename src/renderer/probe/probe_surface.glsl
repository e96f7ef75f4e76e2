// The surface that a probe's texel shows, in 16 bytes, to be lit by other probes.
#ifndef REFLET_PROBE_SURFACE_GLSL
#define REFLET_PROBE_SURFACE_GLSL

#include "shaders/octahedral.glsl"

struct ProbeSurface {
    vec3 normal;
    float roughness;  // perceptual
    vec3 diffuse;     // albedo, occluded
    vec3 specular;    // directional albedo toward the probe
    vec3 byLamps;     // emission that lamps stand for (lampEmitter), up to the largest half float
};

// By the square root, so that dark colours keep their digits.
uint packAlbedo(vec3 albedo) {
    uvec3 bits = uvec3(round(sqrt(clamp(albedo, vec3(0.0), vec3(1.0))) * vec3(2047.0, 2047.0, 1023.0)));
    return bits.r | bits.g << 11u | bits.b << 22u;
}
vec3 unpackAlbedo(uint bits) {
    vec3 root = vec3(bits & 2047u, bits >> 11u & 2047u, bits >> 22u) / vec3(2047.0, 2047.0, 1023.0);
    return root * root;
}

// Three numbers of 9 bits with one exponent.
uint packSharedExponent(vec3 v) {
    float largest = max(max(v.r, v.g), v.b);
    int exponent = clamp(int(ceil(log2(max(largest, 1e-6) * (512.0 / 511.0)))), -15, 16);
    uvec3 bits = min(uvec3(round(v * exp2(float(9 - exponent)))), uvec3(511u));
    return bits.r | bits.g << 9u | bits.b << 18u | uint(exponent + 15) << 27u;
}
vec3 unpackSharedExponent(uint bits) {
    return vec3(bits & 511u, bits >> 9u & 511u, bits >> 18u & 511u) * exp2(float(int(bits >> 27u) - 15 - 9));
}

// The normal to 0.03 degrees.
uvec4 packProbeSurface(ProbeSurface s) {
    uvec2 n = uvec2(round((octahedralEncode(s.normal) * 0.5 + 0.5) * 4095.0));
    uint roughness = uint(round(clamp(s.roughness, 0.0, 1.0) * 255.0));
    return uvec4(n.x | n.y << 12u | roughness << 24u, packAlbedo(s.diffuse), packAlbedo(s.specular),
                 packSharedExponent(s.byLamps));
}
ProbeSurface unpackProbeSurface(uvec4 bits) {
    vec3 n = octahedralDecode(vec2(bits.x & 4095u, bits.x >> 12u & 4095u) / 4095.0 * 2.0 - 1.0);
    return ProbeSurface(n, float(bits.x >> 24u) / 255.0, unpackAlbedo(bits.y), unpackAlbedo(bits.z),
                        unpackSharedExponent(bits.w));
}

#endif
