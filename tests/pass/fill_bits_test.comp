// Writes rows of 32-bit words into an image.
#version 460
#extension GL_EXT_scalar_block_layout : require

layout(local_size_x = 8, local_size_y = 8) in;
layout(scalar) readonly buffer InputBlock { uint items[]; } inputs;
layout(r32ui) uniform writeonly uimage2D image;

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    ivec2 size = imageSize(image);
    if (all(lessThan(pixel, size))) {
        imageStore(image, pixel, uvec4(inputs.items[pixel.y * size.x + pixel.x]));
    }
}
