// The sun's shadow maps as passes read them: a tile per cascade, cascade i at column i % 2 and row i / 2, depth reversed.
// The includer may define HOST_SHADOW_MAP, for a host's own map with any depth, read in place: a 2D image, or with
// HOST_SHADOW_ARRAY an array with a layer per cascade.
#ifndef REFLET_SHADOW_DEPTH_GLSL
#define REFLET_SHADOW_DEPTH_GLSL

#ifdef HOST_SHADOW_MAP
#include "effects/import/finite.glsl"

layout(constant_id = 30) const uint hostIsReversed = 1u;

float asReversed(float stored) {
    float d = hostIsReversed != 0u ? stored : 1.0 - stored;
    return clamp(orZero(d), 0.0, 1.0);
}
#endif

#ifdef HOST_SHADOW_ARRAY
uniform sampler2DArray shadowMap;

ivec2 shadowAtlasSize() {
    ivec3 size = textureSize(shadowMap, 0);
    return size.xy * ivec2(size.z > 1 ? 2 : 1, size.z > 2 ? 2 : 1);
}
float shadowDepth(ivec2 texel) {
    ivec3 size = textureSize(shadowMap, 0);
    ivec2 tile = texel / size.xy;
    int layer = tile.x + 2 * tile.y;
    return layer < size.z ? asReversed(texelFetch(shadowMap, ivec3(texel - tile * size.xy, layer), 0).r) : 0.0;
}
#else
uniform sampler2D shadowMap;

ivec2 shadowAtlasSize() { return textureSize(shadowMap, 0); }
float shadowDepth(ivec2 texel) {
#ifdef HOST_SHADOW_MAP
    return asReversed(texelFetch(shadowMap, texel, 0).r);
#else
    return texelFetch(shadowMap, texel, 0).r;
#endif
}
#endif

#endif
