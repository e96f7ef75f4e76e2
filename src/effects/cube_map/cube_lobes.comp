// Prefilters one level of a cube map with a GGX lobe, with the viewer along the normal, by importance sampling from
// mips that match the samples' solid angle (Křivánek and Colbert, Real-time Shading with Filtered Importance Sampling,
// 2008; Karis, Real Shading in Unreal Engine 4, 2013). Weights are normalised by their sum, so that a constant map is
// unchanged.
// In: sharp (with mips). Out: lobes, one level.
#version 460
#extension GL_EXT_scalar_block_layout : require
#include "effects/cube_map/cube_map.glsl"
#include "shaders/ggx.glsl"
#include "shaders/half_float.glsl"
#include "shaders/not_inlined.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(scalar) uniform ParamsBlock { CubeLobesParams params; };
uniform samplerCubeArray sharp;
layout(rgba16f) uniform writeonly image2DArray lobes;

// Samples overlap: each covers twice its solid angle.
const float overlap = 1.0;

vec4 filterAround(vec3 n, float cube) {
    mat3 frame = basisAround(n);
    float alpha = params.roughness * params.roughness;
    float side = float(textureSize(sharp, 0).x);
    float texels = 6.0 * side * side / (4.0 * pi);  // of level 0, per steradian
    vec4 sum = vec4(0.0);
    float weights = 0.0;
    for (uint i = 0u; i < params.samples; ++i) {
        // Low-discrepancy sequence by the golden ratio.
        vec2 u = vec2((float(i) + 0.5) / float(params.samples), fract(float(i) * 0.618033989));
        vec3 h = sampleGgx(u, alpha);
        vec3 l = vec3(2.0 * h.z * h.xy, 2.0 * h.z * h.z - 1.0);
        if (l.z > 0.0) {
            float solidAngle = 4.0 / (float(params.samples) * ggxDistribution(h.z, alpha));
            float level = max(0.5 * log2(overlap * solidAngle * texels), 0.0);
            float weight = 4.0 * l.z * ggxVisibility(l.z, 1.0, alpha);  // BRDF · cos / pdf
            sum += textureLod(sharp, vec4(frame * l, cube), level) * weight;
            weights += weight;
        }
    }
    return sum / weights;
}

void main() {
    int side = imageSize(lobes).x;
    ivec2 texel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(texel, ivec2(side)))) {
        return;
    }
    uint face = params.firstFace + gl_GlobalInvocationID.z;
    vec3 n = normalize(cubeFaceDirection(cubeTexelCenter(texel, side), face % 6u));
    float cube = float(face / 6u);
    vec4 light = notInlined(floatBitsToUint(params.roughness), gl_GlobalInvocationID.x) == 0u
                     ? textureLod(sharp, vec4(n, cube), 0.0)
                     : filterAround(n, cube);
    imageStore(lobes, ivec3(texel, face), roundToHalf(vec4(clampToHalf(light.rgb), light.a)));
}
