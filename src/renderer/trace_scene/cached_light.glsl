// How paths through the scene end in the radiance cache, and feed it. Included by trace_scene.glsl.
#ifndef REFLET_CACHED_LIGHT_GLSL
#define REFLET_CACHED_LIGHT_GLSL

#include "effects/radiance_cache/radiance_cache.glsl"

struct CachedLight {
    vec3 radiance;  // incoming, cosine-weighted
    float weight;   // samples that it stands for; 0: unknown
};

const CachedLight noCachedLight = CachedLight(vec3(0.0), 0.0);

// Paths go on past what they would end in for so many bounces more.
const uint bouncesPastCache = 3u;
// A cell of so many samples already ends half of the paths at their first hit: less noise, and fewer rays.
const float manySamples = 16.0;
const float shareOfMany = 0.5;

CachedLight cellLight(vec3 p, vec3 n, float side) {
    uint slot = findCacheCell(cachePlace(p, n, side));
    return slot == noCacheSlot ? noCachedLight : CachedLight(cacheCells.items[slot].mean, cacheCells.items[slot].weight);
}

// From a random place nearby, so that the cells' borders blur.
CachedLight cachedLight(LitPoint at, inout uint random) {
    if (endsInCache == 0u) {
        return noCachedLight;
    }
    float side = cacheCellSide(at.position, params.view.eye, params.cellSize);
    vec2 away = (nextRandom2(random) - 0.5) * side;
    CachedLight near = cellLight(at.position + basisAround(at.geometricNormal) * vec3(away, 0.0), at.normal, side);
    if (near.weight > params.samplesToEnd) {
        return near;
    }
    CachedLight own = cellLight(at.position, at.normal, side);
    return own.weight >= near.weight ? own : near;
}

// Cells on a path, and what was known when it left them: what it finds from there on is a sample of their light.
const uint mostToldCells = 4u;
struct ToldCells {
    uint count;
    uint slots[mostToldCells];
    uvec3 known[mostToldCells];  // radiance of the path before, throughput of what comes after; half floats, as registers are few
};

void tellLater(inout ToldCells told, LitPoint at, vec3 radiance, vec3 throughput) {
    if (endsInCache == 0u || told.count == mostToldCells) {
        return;
    }
    float side = cacheCellSide(at.position, params.view.eye, params.cellSize);
    told.slots[told.count] = findOrAddCacheCell(cachePlace(at.position, at.normal, side));
    vec3 before = clampToHalf(radiance);
    vec3 after = clampToHalf(throughput);
    told.known[told.count] =
        uvec3(packHalf2x16(before.rg), packHalf2x16(vec2(before.b, after.r)), packHalf2x16(after.gb));
    ++told.count;
}

// radiance: of the whole path.
void tellCells(ToldCells told, vec3 radiance, inout uint random) {
    for (uint i = 0u; i < told.count; ++i) {
        if (told.slots[i] != noCacheSlot) {
            vec2 between = unpackHalf2x16(told.known[i].y);
            vec3 before = vec3(unpackHalf2x16(told.known[i].x), between.x);
            vec3 after = vec3(between.y, unpackHalf2x16(told.known[i].z));
            vec3 found = (radiance - before) / max(after, vec3(1e-3));
            feedCache(told.slots[i], found, nextRandom(random));
        }
    }
}

// Whether a path ends at the hit after so many bounces.
bool endsHere(uint bounce, CachedLight known, inout uint random) {
    bool far = bounce >= params.bounces;
    if (endsInCache == 0u) {
        return far;
    }
    if (!far && known.weight >= manySamples) {
        return nextRandom(random) < shareOfMany;
    }
    return far && (bounce >= params.bounces + bouncesPastCache || nextRandom(random) * known.weight >= params.samplesToEnd);
}

#endif
