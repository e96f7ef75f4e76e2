// Blur pass of the shadow denoiser: 3x3 taps weighted by each pixel's kernel, with a larger stride in the second pass.
// In: tiles, texels, kernels, depth, raw visibility. Out: texels; in the last pass the visibility alone.
#version 460
#extension GL_EXT_scalar_block_layout : require
#include "effects/shadow/shadow_clean.h"
#include "shaders/shadow_kernel.glsl"

layout(constant_id = 0) const uint last = 0u;

layout(local_size_x = 8, local_size_y = 8) in;
layout(scalar) uniform ParamsBlock { ShadowBlurParams params; };
layout(r32ui) uniform readonly uimage2D from;
layout(rgba32ui) uniform readonly uimage2D kernel;
uniform sampler2D depth;
layout(r8) uniform readonly image2D visibility;
layout(r32ui) uniform writeonly uimage2D blurred;
layout(r8) uniform writeonly image2D cleaned;
layout(scalar) readonly buffer TilesBlock {
    uint groups[3];
    uint count;
    uint items[];
} tiles;

float visibilityOf(uint texel) { return float(texel & 0xffffu) / 65535.0; }
float widthOf(uint texel) { return unpackHalf2x16(texel).y; }

// Similarity of penumbra widths, so that penumbras of different width are not blurred together; fully lit or dark
// pixels match any width.
float alike(float width, float other) {
    return other > 0.0 ? min(width, other) / max(width, other) : 1.0;
}

float blurAt(ivec2 pixel, uint middle) {
    uvec4 bits = imageLoad(kernel, pixel);
    vec3 form = vec3(unpackHalf2x16(bits.x), unpackHalf2x16(bits.y).x);
    ScreenPlane plane = ScreenPlane(unpackHalf2x16(bits.z), uintBitsToFloat(bits.w));
    ivec2 stride = last != 0u ? max(ivec2(1.4 * inversesqrt(form.xz) + 0.5), ivec2(1)) : ivec2(1);
    float width = widthOf(middle);
    float visible = visibilityOf(middle);
    float d = texelFetch(depth, pixel, 0).r;
    vec2 sum = vec2(visible, 1.0);
    for (int i = 0; i < 9; ++i) {
        ivec2 o = (ivec2(i % 3, i / 3) - 1) * stride;
        ivec2 at = pixel + o;
        if (i == 4 || any(lessThan(at, ivec2(0))) || any(greaterThanEqual(at, ivec2(params.size)))) {
            continue;
        }
        uint texel = imageLoad(from, at).x;
        if (onSurface(plane, vec2(o), texelFetch(depth, at, 0).r - d)) {
            float v = texel != 0u ? visibilityOf(texel) : imageLoad(visibility, at).r;
            float weight = exp(-0.5 * quadratic(form, vec2(o))) * alike(width, widthOf(texel)) *
                           similarity(v - visible, params.samples);
            sum += weight * vec2(v, 1.0);
        }
    }
    return sum.x / sum.y;
}

void blur(ivec2 pixel) {
    uint middle = imageLoad(from, pixel).x;
    if (middle != 0u) {
        float visible = blurAt(pixel, middle);
        if (last != 0u) {
            imageStore(cleaned, pixel, vec4(visible));
        } else {
            imageStore(blurred, pixel, uvec4(uint(visible * 65535.0 + 0.5) | (middle & 0xffff0000u)));
        }
    }
}

void main() {
    for (uint i = gl_WorkGroupID.x; i < tiles.count; i += gl_NumWorkGroups.x) {
        ivec2 tile = ivec2(tiles.items[i] & 0xffffu, tiles.items[i] >> 16u);
        ivec2 pixel = tile * int(shadowTileSide) + ivec2(gl_LocalInvocationID.xy);
        if (all(lessThan(pixel, ivec2(params.size)))) {
            blur(pixel);
        }
    }
}
