// Lower and upper bounds of the blocker heights around a receiver, from the min/max hierarchy of the shadow map
// (effects/shadow/shadow.h).
// The includer defines, before it includes this: vec2 loadShadowRange(ivec2 cell), of the image that holds all levels.
#ifndef REFLET_SHADOW_RANGE_GLSL
#define REFLET_SHADOW_RANGE_GLSL

#include "effects/levels.glsl"
#include "shaders/shadow_map.glsl"

// Bounds in metres above the receiver, toward the sun, of everything within `radius` metres across the sun's direction.
// The lower bound is -1e9 where the disk leaves the map; both are infinite (-1e9, 1e9) where the disk is larger than
// the cells of the coarsest level. size: of the image that all maps share.
vec2 heightRange(ShadowReceiver r, ivec2 size, float radius) {
    vec2 reach = radius * r.texelsPerMetre;
    ivec2 low = ivec2(floor(r.at - reach));
    ivec2 high = ivec2(floor(r.at + reach));
    bool leaves = outsideMap(low, r.tile.size) || outsideMap(high, r.tile.size);
    low = clamp(low, ivec2(0), r.tile.size - 1) + r.tile.origin;
    high = clamp(high, ivec2(0), r.tile.size - 1) + r.tile.origin;
    int across = max(high.x - low.x, high.y - low.y);
    // The finest level at which 2x2 cells cover the disk.
    int level = max(across > 1 ? findMSB(across - 1) - 1 : 1, 1);
    if (level >= int(shadowRangeLevels)) {
        return vec2(outsideClearance, -outsideClearance);
    }
    int shift = level + 2;
    ivec2 row = ivec2(0, levelRow(levelSize(size, 2), level));
    vec2 a = loadShadowRange((low >> shift) + row);
    vec2 b = loadShadowRange((high >> shift) + row);
    vec2 c = loadShadowRange(ivec2(low.x >> shift, high.y >> shift) + row);
    vec2 d = loadShadowRange(ivec2(high.x >> shift, low.y >> shift) + row);
    float nearest = max(max(a.x, b.x), max(c.x, d.x));
    float farthest = min(min(a.y, b.y), min(c.y, d.y));
    vec2 heights = (vec2(farthest, nearest) - r.s.z) * r.depthRange;
    return leaves ? vec2(outsideClearance, heights.y) : heights;
}

#endif
