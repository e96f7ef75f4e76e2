// Puts the layers together at full size. In: radiance, circle of confusion, blurred layers. Out: radiance.
#version 460
#extension GL_EXT_scalar_block_layout : require
#include "effects/depth_of_field/dof_layers.glsl"
#include "shaders/half_float.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(scalar) uniform ParamsBlock { DofSizes params; };
uniform sampler2D radiance;
layout(r32f) uniform readonly image2D coc;
layout(rgba16f) uniform readonly image2D groundOut;
layout(rgba16f) uniform readonly image2D frontOut;
layout(rgba16f) uniform writeonly image2D result;

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(pixel, ivec2(params.size)))) {
        return;
    }
    vec4 sharp = texelFetch(radiance, pixel, 0);
    sharp.rgb = clampToHalf(sharp.rgb);
    float c = imageLoad(coc, min(ivec2((vec2(pixel) + 0.5) * params.toDepth), imageSize(coc) - 1)).r;
    // Bilinear; blurred cells before sharp ones, whose light must not leak.
    ivec2 corner = (pixel - 1) >> 1;
    vec2 part = 0.75 - 0.5 * vec2(pixel & 1);
    ivec2 last = ivec2(params.half2) - 1;
    vec4 behind = vec4(0.0);
    vec4 before = vec4(0.0);
    for (int i = 0; i < 4; ++i) {
        ivec2 side = ivec2(i & 1, i >> 1);
        ivec2 cell = clamp(corner + side, ivec2(0), last);
        vec2 w = mix(1.0 - part, part, vec2(side));
        float weight = w.x * w.y;
        vec4 g = imageLoad(groundOut, cell);
        behind += weight * (sharpWeight + g.a) * vec4(g.rgb, 1.0);
        before += weight * imageLoad(frontOut, cell);
    }
    float blurred = blurredShare(c);
    vec3 light = blurred > 0.0 ? mix(sharp.rgb, behind.rgb / behind.a, blurred) : sharp.rgb;
    imageStore(result, pixel, vec4(light * (1.0 - before.a) + before.rgb, sharp.a));
}
