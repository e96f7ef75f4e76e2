// Writes rows of pairs into an image.
#version 460
#extension GL_EXT_scalar_block_layout : require

layout(local_size_x = 8, local_size_y = 8) in;
layout(scalar) readonly buffer InputBlock { vec4 items[]; } inputs;
layout(rg16f) uniform writeonly image2D image;

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    ivec2 size = imageSize(image);
    if (all(lessThan(pixel, size))) {
        imageStore(image, pixel, inputs.items[pixel.y * size.x + pixel.x]);
    }
}
