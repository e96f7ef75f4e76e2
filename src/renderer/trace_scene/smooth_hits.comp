// Smooths the light that hits of smooth reflections and of paths through clear glass reflect (split_hit.glsl), over pixels
// whose hits face the same way at the same distance, and adds it to the rays' answers. In: that light, the factor on it with the
// hit's distance from the eye, the hits' normals. Out: the answers.
#version 460
#extension GL_EXT_scalar_block_layout : require
#include "renderer/trace_scene/smooth_hits.h"
#include "shaders/blur_disk.glsl"
#include "shaders/half_float.glsl"
#include "shaders/noise.glsl"
#include "shaders/octahedral.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(scalar) uniform ParamsBlock { SmoothHitsParams params; };
layout(rgba16f) uniform readonly image2DArray hitLight;
layout(rgba16f) uniform readonly image2DArray hitFactor;
layout(r32ui) uniform readonly uimage2DArray hitNormal;
layout(rgba16f) uniform image2DArray answer;

const int taps = 16;
const float sameDistance = 0.05;  // relative

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    ivec2 size = ivec2(params.size);
    ivec3 slot = ivec3(pixel, int(gl_GlobalInvocationID.z));
    if (any(greaterThanEqual(pixel, size))) {
        return;
    }
    vec4 light = imageLoad(hitLight, slot);
    if (light.a <= 0.0) {
        return;
    }
    vec4 factor = imageLoad(hitFactor, slot);
    vec3 normal = unpackUnitVector(imageLoad(hitNormal, slot).r);
    float turn = 6.2831853 * hashToUnit(hashPixel(uvec2(pixel), 97u + uint(slot.z), params.frame));
    vec2 spoke = firstSpoke(params.radius, taps, turn);
    vec4 sum = light;
    float near = firstTapWeight(taps);
    float falls = near * near;
    for (int i = 0; i < taps; ++i) {
        ivec2 at = pixel + ivec2(round(tapReach(i) * spoke));
        spoke = nextSpoke(spoke);
        ivec3 other = ivec3(at, slot.z);
        vec4 there = all(greaterThanEqual(at, ivec2(0))) && all(lessThan(at, size)) ? imageLoad(hitLight, other) : vec4(0.0);
        if (there.a > 0.0) {
            float away = imageLoad(hitFactor, other).a;
            float facing = max(dot(unpackUnitVector(imageLoad(hitNormal, other).r), normal), 0.0);
            float same = exp2(-abs(away - factor.a) / (sameDistance * max(max(away, factor.a), 1e-6)));
            sum += near * pow(facing, 8.0) * same * there;
        }
        near *= falls;
    }
    vec4 found = imageLoad(answer, slot);
    found.rgb = clampToHalf(found.rgb + factor.rgb * sum.rgb / sum.a);
    imageStore(answer, slot, found);
}
