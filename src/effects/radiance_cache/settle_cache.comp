// Takes over what the last frame has fed to each cell of the radiance cache, and frees cells that nothing feeds any
// more.
#version 460
#extension GL_EXT_scalar_block_layout : require
#include "effects/radiance_cache/radiance_cache.glsl"

layout(local_size_x = 64) in;
layout(scalar) uniform ParamsBlock {
    SettleCacheParams params;
};

// A cell without samples is freed after so many frames.
const uint longestIdle = 120u;

const CacheCell noCell = CacheCell(0u, 0u, 0u, 0u, vec3(0.0), 0.0, 0u);

void main() {
    uint slot = gl_GlobalInvocationID.x;
    uint before = cacheKeys.items[slot];
    uint key = before & params.keptSlots;
    if (before == 0u && params.keptSlots != 0u) {
        return;
    }
    CacheCell c = cacheCells.items[slot];
    uint idle = c.count > 0u ? 0u : c.idle + 1u;
    if (key == 0u || idle > longestIdle) {
        cacheKeys.items[slot] = 0u;
        cacheCells.items[slot] = noCell;
        return;
    }
    float kept = c.weight * params.keep;
    if (c.count > 0u) {
        vec3 sum = vec3(c.sumRed, c.sumGreen, c.sumBlue) / cacheScale(c);
        float samples = float(c.count);
        c.mean = (c.mean * kept + sum) / (kept + samples);
        kept += samples;
    }
    cacheCells.items[slot] = CacheCell(0u, 0u, 0u, 0u, c.mean * params.unitChange, kept, idle);
}
