// The host's direct light: Lambert in the sun, and the sky where there is no surface.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "room.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(set = 0, binding = 1) uniform sampler2D depth;
layout(set = 0, binding = 2) uniform sampler2D normal_smoothness;
layout(set = 0, binding = 3) uniform sampler2D color_metallic;
layout(set = 0, binding = 4) uniform sampler2D sun_visibility;
layout(set = 0, binding = 5, rgba16f) uniform writeonly image2D lit;

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(pixel, textureSize(sun_visibility, 0)))) return;  // of the frame's size; images may be larger
    vec3 radiance = camera.sky.rgb;
    if (texelFetch(depth, pixel, 0).r < 1.0) {
        vec3 n = texelFetch(normal_smoothness, pixel, 0).xyz * mat3(camera.world_to_view);
        vec4 material = texelFetch(color_metallic, pixel, 0);
        float sun = max(dot(n, camera.to_sun.xyz), 0.0) * texelFetch(sun_visibility, pixel, 0).r;
        radiance = material.rgb * (1.0 - material.a) / 3.14159265 * sun * vec3(3.2, 3.0, 2.7);
    }
    imageStore(lit, pixel, vec4(radiance, 1.0));
}
