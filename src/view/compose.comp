// Draws the window below its user interface: copies the left and the right image into their rectangle.
// In: both images, display-encoded. Out: the window.
#version 460
#extension GL_EXT_scalar_block_layout : require
#include "view/canvas.h"

layout(local_size_x = 8, local_size_y = 8) in;
layout(scalar) uniform ParamsBlock { ComposeParams params; };
uniform sampler2D left;
uniform sampler2D right;
layout(rgba8) uniform writeonly image2D window;

const vec3 outside = vec3(0.08);

void main() {
    uvec2 pixel = gl_GlobalInvocationID.xy;
    if (any(greaterThanEqual(pixel, params.size))) {
        return;
    }
    vec2 uv = (vec2(pixel) + 0.5 - params.corner) / max(params.extent, vec2(1e-6));
    vec3 color = outside;
    if (all(greaterThanEqual(uv, vec2(0.0))) && all(lessThan(uv, vec2(1.0)))) {
        // The centre of a texel, unless they are interpolated.
        bool isLeft = float(pixel.x) < params.divider;
        vec2 size = isLeft ? params.sizeA : params.sizeB;
        vec2 at = params.linear != 0u ? uv : (floor(uv * size) + 0.5) / size;
        color = isLeft ? textureLod(left, at, 0.0).rgb : textureLod(right, at, 0.0).rgb;
    }
    imageStore(window, ivec2(pixel), vec4(params.swapped != 0u ? color.bgr : color, 1.0));
}
