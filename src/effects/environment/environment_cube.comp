// Converts an equirectangular image to a cube map, by supersampling each texel. In: texels. Out: faces.
#version 460
#extension GL_EXT_scalar_block_layout : require
#include "effects/cube_map/cube_map.glsl"
#include "effects/environment/equirectangular.glsl"
#include "shaders/half_float.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
uniform sampler2D texels;
layout(rgba16f) uniform writeonly image2DArray faces;

// Samples per axis. For a cube of 256 pixels a side they match the columns of an image of width 8192.
const int places = 8;

void main() {
    int side = imageSize(faces).x;
    ivec2 texel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(texel, ivec2(side)))) {
        return;
    }
    vec3 sum = vec3(0.0);
    for (int i = 0; i < places * places; ++i) {
        vec2 at = cubeTexelCenter(places * texel + ivec2(i % places, i / places), places * side);
        sum += equirectangularTexel(texels, cubeFaceDirection(at, gl_GlobalInvocationID.z));
    }
    vec3 mean = sum / float(places * places);
    imageStore(faces, ivec3(texel, gl_GlobalInvocationID.z), roundToHalf(vec4(clampToHalf(mean), 1.0)));
}
