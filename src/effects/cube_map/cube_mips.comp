// One mip level of a cube map from the finer one: means over solid angle. In: finer. Out: coarser.
#version 460
#extension GL_EXT_scalar_block_layout : require
#include "effects/cube_map/cube_map.glsl"
#include "shaders/half_float.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(scalar) uniform ParamsBlock { CubeMipParams params; };
uniform sampler2DArray finer;
layout(rgba16f) uniform writeonly image2DArray coarser;

// A texel's solid angle relative to one in the middle of the face.
float weightOf(ivec2 texel, int side) {
    vec2 at = cubeTexelCenter(texel, side);
    float distance2 = 1.0 + dot(at, at);
    return inversesqrt(distance2 * distance2 * distance2);
}

void main() {
    int side = imageSize(coarser).x;
    ivec2 texel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(texel, ivec2(side)))) {
        return;
    }
    int face = int(params.firstFace + gl_GlobalInvocationID.z);
    vec4 sum = vec4(0.0);
    float weights = 0.0;
    for (int i = 0; i < 4; ++i) {
        ivec2 child = 2 * texel + ivec2(i & 1, i >> 1);
        float weight = weightOf(child, 2 * side);
        sum += texelFetch(finer, ivec3(child, face), 0) * weight;
        weights += weight;
    }
    sum /= weights;
    imageStore(coarser, ivec3(texel, face), roundToHalf(vec4(clampToHalf(sum.rgb), sum.a)));
}
