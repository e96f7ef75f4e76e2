// Attenuates the light by the medium that the camera is in. In: depth of the nearest surface, glass included; the light.
// Out: the light; its alpha is kept.
#version 460
#extension GL_EXT_scalar_block_layout : require
#include "renderer/glass/camera_medium.h"
#include "shaders/half_float.glsl"
#include "shaders/projection.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(scalar) uniform ParamsBlock { CameraMediumParams params; };
uniform sampler2D depth;
uniform sampler2D behind;
layout(rgba16f) uniform writeonly image2D over;

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(pixel, ivec2(params.view.size)))) {
        return;
    }
    vec4 light = texelFetch(behind, pixel, 0);
    float d = texelFetch(depth, pixel, 0).r;
    if (d > 0.0) {  // a hole of the mesh shows the background as it is
        vec3 p = uvToWorld(pixelToUv(pixel, params.view.pixel), d, params.view.clipToWorld);
        light.rgb *= exp(-params.extinction * distance(p, params.view.eye.xyz));
    }
    imageStore(over, pixel, roundToHalf(light));
}
