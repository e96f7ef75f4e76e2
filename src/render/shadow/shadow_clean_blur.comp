// A pass of the blur that cleans shadows: 3x3 texels, the second time farther apart, as each pixel's kernel weighs them.
// In: texels (visibility, penumbra width; depth), kernels. Out: texels; at last the visibility alone.
#version 460
#extension GL_EXT_scalar_block_layout : require
#include "render/shadow/shadow_clean.h"
#include "shaders/shadow_kernel.glsl"

layout(constant_id = 0) const uint last = 0u;

layout(local_size_x = 8, local_size_y = 8) in;
layout(set = 0, binding = 0, scalar) uniform ParamsBlock { ShadowBlurParams params; };
layout(set = 0, binding = 1, rg32ui) uniform readonly uimage2D from;
layout(set = 0, binding = 2, rgba32ui) uniform readonly uimage2D kernel;
layout(set = 0, binding = 3, rg32ui) uniform writeonly uimage2D blurred;
layout(set = 0, binding = 4, r8) uniform writeonly image2D cleaned;

float visibilityOf(uvec2 texel) { return float(texel.x & 0xffffu) / 65535.0; }
float widthOf(uvec2 texel) { return unpackHalf2x16(texel.x).y; }
float depthOf(uvec2 texel) { return uintBitsToFloat(texel.y); }

// Where penumbras of different widths meet, each keeps its own; what is fully lit or dark belongs to all.
float alike(float width, float other) {
    return other > 0.0 ? min(width, other) / max(width, other) : 1.0;
}

float blur(ivec2 pixel, uvec2 middle) {
    uvec4 bits = imageLoad(kernel, pixel);
    vec3 form = vec3(unpackHalf2x16(bits.x), unpackHalf2x16(bits.y).x);
    ScreenPlane plane = ScreenPlane(unpackHalf2x16(bits.z), uintBitsToFloat(bits.w));
    ivec2 stride = ivec2(1);
    if (last != 0u) {
        stride = max(ivec2(1.4 * inversesqrt(form.xz) + 0.5), ivec2(1));
    }
    float width = widthOf(middle);
    vec2 sum = vec2(visibilityOf(middle), 1.0);
    for (int i = 0; i < 9; ++i) {
        ivec2 o = (ivec2(i % 3, i / 3) - 1) * stride;
        ivec2 at = pixel + o;
        if (i == 4 || any(lessThan(at, ivec2(0))) || any(greaterThanEqual(at, ivec2(params.size)))) {
            continue;
        }
        uvec2 texel = imageLoad(from, at).xy;
        if (onSurface(plane, vec2(o), depthOf(texel) - depthOf(middle))) {
            float weight = exp(-0.5 * quadratic(form, vec2(o))) * alike(width, widthOf(texel));
            sum += weight * vec2(visibilityOf(texel), 1.0);
        }
    }
    return sum.x / sum.y;
}

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(uvec2(pixel), params.size))) {
        return;
    }
    uvec2 middle = imageLoad(from, pixel).xy;
    float visible = widthOf(middle) > 0.0 ? blur(pixel, middle) : visibilityOf(middle);
    if (last != 0u) {
        imageStore(cleaned, pixel, vec4(visible));
    } else {
        imageStore(blurred, pixel, uvec4(uint(visible * 65535.0 + 0.5) | (middle.x & 0xffff0000u), middle.y, 0u, 0u));
    }
}
