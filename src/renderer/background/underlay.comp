// Lays a colour under the display image, or makes it transparent. In: display image, coverage. Out: display image.
#version 460
#extension GL_EXT_scalar_block_layout : require
#include "renderer/background/background.h"

layout(constant_id = 0) const uint transparent = 0u;

layout(local_size_x = 8, local_size_y = 8) in;
layout(scalar) uniform ParamsBlock { UnderlayParams params; };
uniform sampler2D display;
uniform sampler2D coverage;
layout(rgba8) uniform writeonly image2D displayOver;

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (all(lessThan(uvec2(pixel), params.size))) {
        vec3 c = texelFetch(display, pixel, 0).rgb;
        float covered = clamp(texelFetch(coverage, pixel, 0).r, 0.0, 1.0);
        imageStore(displayOver, pixel, transparent != 0u ? vec4(c, covered) : vec4(mix(params.color, c, covered), 1.0));
    }
}
