// Firefly limit and luminance variance of each tile of 8x8 pixels. One thread per tile.
// In: radiance, depth, material. Out: the limit, in luminance; variance of the luminance. Tiles with a mirror have no
// limit and no variance.
#version 460
#extension GL_EXT_scalar_block_layout : require
#include "effects/denoise/denoise.glsl"

layout(constant_id = 0) const uint lobe = 0u;
layout(constant_id = 1) const uint meanRays = 0u;  // as in denoise_gather.comp

layout(local_size_x = 8, local_size_y = 8) in;
layout(scalar) uniform ParamsBlock { DenoiseTilesParams params; };
uniform sampler2D material;
uniform sampler2D depth;
layout(rgba16f) uniform readonly image2D radiance;
layout(rg32f) uniform writeonly image2D limits;

void main() {
    ivec2 tile = ivec2(gl_GlobalInvocationID.xy);
    ivec2 first = tile * int(denoiseTileSide);
    ivec2 end = min(first + int(denoiseTileSide), ivec2(params.size));
    vec3 sum = vec3(0.0);
    float smoothest = 1.0;
    for (int y = first.y; y < end.y; ++y) {
        for (int i = 0; i < int(denoiseTileSide); ++i) {  // a known number without branches: the loads of a row are under way at once
            ivec2 pixel = ivec2(min(first.x + i, end.x - 1), y);
            vec4 light = imageLoad(radiance, pixel);
            float roughness = lobe == 1u ? texelFetch(material, pixel, 0).r : 1.0;
            bool counts = texelFetch(depth, pixel, 0).r > 0.0 && first.x + i < end.x && (meanRays == 0u || light.a >= 0.0);
            float bright = luminance(clampToHalf(light.rgb));
            sum += counts ? vec3(bright, bright * bright, 1.0) : vec3(0.0);
            smoothest = counts ? min(smoothest, roughness) : smoothest;
        }
    }
    // Bright pixels in a mirror are detail, not noise.
    bool noisy = smoothest > smoothRoughness && sum.z > 0.0;
    vec2 mean = sum.xy / max(sum.z, 1.0);
    float limit = noisy && params.limit > 0.0 ? params.limit * mean.x : 4.0 * largestHalf;
    imageStore(limits, tile, vec4(limit, noisy ? max(mean.y - mean.x * mean.x, 0.0) : 0.0, 0.0, 0.0));
}
