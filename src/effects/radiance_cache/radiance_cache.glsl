// Finding, reading and feeding cells of the radiance cache.
#ifndef REFLET_RADIANCE_CACHE_GLSL
#define REFLET_RADIANCE_CACHE_GLSL

#include "effects/radiance_cache/radiance_cache.h"
#include "shaders/noise.glsl"

layout(scalar) buffer CacheKeysBlock {
    uint items[];
}
cacheKeys;
layout(scalar) buffer CacheCellsBlock {
    CacheCell items[];
}
cacheCells;

const uint noCacheSlot = ~0u;

// Fixed point: a cell that is known gets its mean to about 2^12, so that dark cells keep their digits and 2^20 samples
// fit; a sample counts at most 256 times the mean. Powers of two.
float cacheScale(CacheCell c) {
    float brightest = max(c.mean.r, max(c.mean.g, c.mean.b));
    bool known = c.weight > 0.0 && brightest > 0.0;
    return known ? exp2(clamp(12.0 - floor(log2(brightest)), -12.0, 30.0)) : 1024.0;
}
const float largestSample = 1048576.0;

// Side of the cells around a point [m]: the power of two at or below the wanted one.
float cacheCellSide(vec3 p, vec4 eye, float share) {
    float away = eye.w > 0.0 ? distance(p, eye.xyz) : 10.0;
    uint bits = floatBitsToUint(clamp(share * away, 1.0 / 1024.0, 1024.0));
    return uintBitsToFloat(bits & 0xff800000u);
}

// Range of normals: a third by a third of a cube's side.
uint cacheNormalRange(vec3 n) {
    vec3 a = abs(n);
    uint axis = a.x >= a.y && a.x >= a.z ? 0u : a.y >= a.z ? 1u : 2u;
    vec3 turned = axis == 0u ? n.yzx : axis == 1u ? n.zxy : n;
    vec2 side = clamp(turned.xy / max(abs(turned.z), 1e-6), -1.0, 1.0);
    uvec2 third = min(uvec2((side * 0.5 + 0.5) * 3.0), uvec2(2u));
    return (axis * 2u + (turned.z < 0.0 ? 1u : 0u)) * 9u + third.y * 3u + third.x;
}

struct CachePlace {
    uint slot;  // first one to look at
    uint key;   // not 0
};

CachePlace cachePlace(vec3 p, vec3 n, float side) {
    ivec3 cell = ivec3(floor(p / side));
    uint kind = cacheNormalRange(n) | (floatBitsToUint(side) >> 15u);
    uint hash = hashPcg(uint(cell.x) + hashPcg(uint(cell.y) + hashPcg(uint(cell.z) + hashPcg(kind))));
    return CachePlace(
        hash, max(hashPcg(hash ^ hashPcg(uint(cell.x) * 3u + uint(cell.y) * 5u + uint(cell.z) * 7u + kind)), 1u));
}

uint cacheSlot(CachePlace place, uint probe) {
    return (place.slot + probe) & (cacheSlots - 1u);
}

// noCacheSlot: unknown.
uint findCacheCell(CachePlace place) {
    for (uint i = 0u; i < cacheProbes; ++i) {
        uint slot = cacheSlot(place, i);
        if (cacheKeys.items[slot] == place.key) {
            return slot;
        }
    }
    return noCacheSlot;
}

// noCacheSlot: there is no room. All slots that the key may be in are searched first, as slots are freed between full
// ones; a key cannot be added twice, because no slot is freed while others are taken.
uint findOrAddCacheCell(CachePlace place) {
    uint slot = findCacheCell(place);
    for (uint i = 0u; i < cacheProbes && slot == noCacheSlot; ++i) {
        uint there = cacheSlot(place, i);
        uint found = atomicCompSwap(cacheKeys.items[there], 0u, place.key);
        slot = found == 0u || found == place.key ? there : noCacheSlot;
    }
    return slot;
}

// radiance: that reaches the cell along a direction drawn by the cosine. random: 0 to 1, for unbiased rounding.
void feedCache(uint slot, vec3 radiance, float random) {
    CacheCell c = cacheCells.items[slot];
    uvec3 fixedPoint = uvec3(min(max(radiance, vec3(0.0)) * cacheScale(c), vec3(largestSample)) + random);
    atomicAdd(cacheCells.items[slot].count, 1u);
    atomicAdd(cacheCells.items[slot].sumRed, fixedPoint.r);
    atomicAdd(cacheCells.items[slot].sumGreen, fixedPoint.g);
    atomicAdd(cacheCells.items[slot].sumBlue, fixedPoint.b);
}

#endif
