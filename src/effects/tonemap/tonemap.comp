// Exposure, tone curve and display encoding. In: radiance. Out: display.
#version 460
#extension GL_EXT_scalar_block_layout : require
#include "effects/tonemap/display_color.glsl"

layout(constant_id = 0) const uint curve = 0u;  // a constant, because CPU devices would compute all branches

layout(local_size_x = 8, local_size_y = 8) in;
layout(scalar) uniform ParamsBlock { TonemapParams params; };
uniform sampler2D radiance;  // RGBA16F, or RGBA32F if accumulated
layout(rgba8) uniform writeonly image2D display;

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (all(lessThan(uvec2(pixel), params.size))) {
        vec3 c = texelFetch(radiance, pixel, 0).rgb;
        imageStore(display, pixel, vec4(displayColor(c, curve, params.settings.exposure), 1.0));
    }
}
