// Copies radiance into half floats, finite. In: the host's image. Out: RGBA16F, of the same size.
#version 460
#extension GL_EXT_scalar_block_layout : require
#include "effects/import/import.h"
#include "shaders/half_float.glsl"

layout(constant_id = 0) const uint keepAlpha = 0u;

layout(local_size_x = 8, local_size_y = 8) in;
layout(scalar) uniform ParamsBlock { ImportLightParams params; };
uniform sampler2D hostLight;
layout(rgba16f) uniform writeonly image2D light;

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(pixel, ivec2(params.size)))) {
        return;
    }
    vec4 texel = texelFetch(hostLight, pixel, 0);
    float alpha = keepAlpha != 0u ? clampToHalf(vec3(texel.a)).x : 1.0;
    imageStore(light, pixel, vec4(clampToHalf(texel.rgb), alpha));
}
