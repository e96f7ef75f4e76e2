// Copies a host's shadow maps into Reflet's tiles. In: depth, a layer per cascade. Out: R32F, reversed, cascade i at column i % 2
// and row i / 2.
#version 460
#extension GL_EXT_scalar_block_layout : require
#include "effects/import/finite.glsl"
#include "effects/import/import.h"

layout(constant_id = 0) const uint reversed = 1u;

layout(local_size_x = 8, local_size_y = 8) in;
layout(scalar) uniform ParamsBlock { ImportShadowParams params; };
uniform sampler2DArray hostMap;
layout(r32f) uniform writeonly image2D map;

void main() {
    ivec2 to = ivec2(gl_GlobalInvocationID.xy);
    ivec2 tile = to / ivec2(params.size);
    int cascade = tile.x + 2 * tile.y;
    if (any(greaterThanEqual(to, imageSize(map)))) {
        return;
    }
    if (tile.x > 1 || cascade >= int(params.cascades)) {
        imageStore(map, to, vec4(0.0));
        return;
    }
    ivec2 from = to - tile * ivec2(params.size);
    float stored = texelFetch(hostMap, ivec3(from, cascade), 0).r;
    float d = reversed != 0u ? stored : 1.0 - stored;
    imageStore(map, to, vec4(clamp(orZero(d), 0.0, 1.0)));
}
