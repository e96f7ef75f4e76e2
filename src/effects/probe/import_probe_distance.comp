// Resamples a host's cube map of distances into faces of a cube array. In: the host's cube, in metres. Out: 1 / metres,
// 0 for the sky.
#version 460
#extension GL_EXT_scalar_block_layout : require
#include "effects/cube_map/cube_map.glsl"
#include "effects/import/finite.glsl"
#include "effects/probe/import_probes.h"

layout(local_size_x = 8, local_size_y = 8) in;
layout(scalar) uniform ParamsBlock { ImportProbeParams params; };
uniform samplerCube hostCube;
layout(r32f) uniform writeonly image2DArray faces;

void main() {
    int side = imageSize(faces).x;
    ivec2 texel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(texel, ivec2(side)))) {
        return;
    }
    uint face = gl_GlobalInvocationID.z;
    float metres = orZero(textureLod(hostCube, cubeFaceDirection(cubeTexelCenter(texel, side), face), params.level).r);
    imageStore(faces, ivec3(texel, params.firstFace + face), vec4(metres > 0.0 ? 1.0 / max(metres, 1e-6) : 0.0));
}
