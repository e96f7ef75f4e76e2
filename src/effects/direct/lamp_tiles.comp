// Tiled light culling: finds the lamps that reach the surfaces of a tile. One group per tile: its threads first find
// the nearest and farthest surface, then test the lamps in parallel. In: depth, lamps. Out: lamp bit mask; number of
// lamps.
#version 460
#extension GL_EXT_scalar_block_layout : require
#include "effects/direct/lamp_tiles.h"
#include "shaders/lamp_reach.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(constant_id = 0) const uint all = 0u;  // 1: every tile gets all lamps
layout(scalar) uniform ParamsBlock { LampTilesParams params; };
layout(scalar) uniform LampUniforms { LampBlock lampBlock; };
uniform sampler2D depth;
layout(rgba32ui) uniform writeonly uimage2DArray masks;
layout(r32f) uniform writeonly image2D lampCount;

const int groupSide = 8;
const uint threads = 64u;
const uint words = 4u * ((maxLamps + lampsPerLayer - 1u) / lampsPerLayer);

shared uint nearest;   // depth as bits, which sort like the depths; 0: no surface
shared uint farthest;
shared uint mask[words];

void findDepths(ivec2 first) {
    ivec2 last = ivec2(params.view.size) - 1;
    float highest = 0.0;
    float lowest = 2.0;
    for (int y = 0; y < int(lampTileSide); y += groupSide) {
        for (int x = 0; x < int(lampTileSide); x += groupSide) {
            ivec2 pixel = first + ivec2(gl_LocalInvocationID.xy) + ivec2(x, y);
            float d = texelFetch(depth, min(pixel, last), 0).r;
            highest = max(highest, d);
            lowest = d > 0.0 ? min(lowest, d) : lowest;
        }
    }
    atomicMax(nearest, floatBitsToUint(highest));
    atomicMin(farthest, floatBitsToUint(lowest));
}

void main() {
    uint thread = gl_LocalInvocationIndex;
    if (thread < words) {
        mask[thread] = 0u;
    }
    if (thread == 0u) {
        nearest = 0u;
        farthest = floatBitsToUint(2.0);
    }
    barrier();
    ivec2 first = ivec2(gl_WorkGroupID.xy * lampTileSide);
    findDepths(first);
    barrier();
    if (nearest > 0u || all != 0u) {
        vec2 uvMin = vec2(first) * params.view.pixel;
        vec2 uvMax = min(uvMin + float(lampTileSide) * params.view.pixel, vec2(1.0));
        TileBounds tile = tileBounds(uvMin, uvMax, uintBitsToFloat(uvec2(nearest, farthest)), params.view);
        for (uint i = thread; i < lampBlock.count; i += threads) {
            if (all != 0u || lampReaches(lampBlock.lamps[i], tile, params.view.viewPlane)) {
                atomicOr(mask[i / 32u], 1u << (i % 32u));
            }
        }
    }
    barrier();
    if (thread == 0u) {
        uint count = 0u;
        for (uint layer = 0u; layer * lampsPerLayer < lampBlock.count; ++layer) {
            uvec4 bits = uvec4(mask[4u * layer], mask[4u * layer + 1u], mask[4u * layer + 2u], mask[4u * layer + 3u]);
            imageStore(masks, ivec3(gl_WorkGroupID.xy, layer), bits);
            ivec4 ones = bitCount(bits);
            count += uint(ones.x + ones.y + ones.z + ones.w);
        }
        imageStore(lampCount, ivec2(gl_WorkGroupID.xy), vec4(float(count)));
    }
}
