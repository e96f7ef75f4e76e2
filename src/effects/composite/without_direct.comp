// Subtracts the direct light from all light. In: both. Out: what remains, with the fourth channel of all light.
#version 460

layout(local_size_x = 8, local_size_y = 8) in;
layout(rgba16f) uniform readonly image2D lit;
layout(rgba16f) uniform readonly image2D direct;
layout(rgba16f) uniform writeonly image2D remaining;

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(pixel, imageSize(lit)))) {
        return;
    }
    vec4 all = imageLoad(lit, pixel);
    imageStore(remaining, pixel, vec4(max(all.rgb - imageLoad(direct, pixel).rgb, vec3(0.0)), all.a));
}
