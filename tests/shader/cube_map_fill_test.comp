// Fills the faces of a cube array with given colours.
#version 460
#extension GL_EXT_scalar_block_layout : require

layout(local_size_x = 8, local_size_y = 8) in;
layout(scalar) readonly buffer ColorBlock { vec3 items[]; } colors;
layout(rgba16f) uniform writeonly image2DArray faces;

void main() {
    ivec3 at = ivec3(gl_GlobalInvocationID);
    int side = imageSize(faces).x;
    if (all(lessThan(at.xy, ivec2(side)))) {
        imageStore(faces, at, vec4(colors.items[(at.z * side + at.y) * side + at.x], 1.0));
    }
}
