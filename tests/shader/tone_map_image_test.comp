// Colours into an image, row by row.
#version 460
#extension GL_EXT_scalar_block_layout : require

layout(local_size_x = 8, local_size_y = 8) in;
layout(scalar) readonly buffer ColorBlock { vec3 items[]; } colors;
layout(rgba16f) uniform writeonly image2D radiance;

void main() {
    uvec2 pixel = gl_GlobalInvocationID.xy;
    uvec2 size = uvec2(imageSize(radiance));
    if (all(lessThan(pixel, size))) {
        imageStore(radiance, ivec2(pixel), vec4(colors.items[pixel.y * size.x + pixel.x], 1.0));
    }
}
