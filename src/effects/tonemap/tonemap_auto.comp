// As tonemap.comp, with automatic exposure. In: radiance, exposure. Out: display.
#version 460
#extension GL_EXT_scalar_block_layout : require
#include "effects/exposure/exposure.h"
#include "effects/tonemap/display_color.glsl"

layout(constant_id = 0) const uint curve = 0u;  // a constant, because CPU devices would compute all branches

layout(local_size_x = 8, local_size_y = 8) in;
layout(scalar) uniform ParamsBlock { TonemapParams params; };
uniform sampler2D radiance;  // RGBA16F, or RGBA32F if accumulated
layout(rgba8) uniform writeonly image2D display;
layout(rg32f) uniform readonly image2D exposure;

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (all(lessThan(uvec2(pixel), params.size))) {
        float stops = params.settings.exposure + imageLoad(exposure, ivec2(exposureFrames, 0)).r;
        imageStore(display, pixel, vec4(displayColor(texelFetch(radiance, pixel, 0).rgb, curve, stops), 1.0));
    }
}
