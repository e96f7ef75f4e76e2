// Tiled light culling: the lamps that may light a pixel are those of its tile.
// The includer defines, before it includes this: uvec4 loadLampMask(ivec3 texel), by tile and layer.
#ifndef REFLET_LAMP_MASK_GLSL
#define REFLET_LAMP_MASK_GLSL

#include "effects/lamps.h"

// Bit mask of the lamps from layer · lampsPerLayer on.
uvec4 lampMaskAt(ivec2 pixel, uint layer) { return loadLampMask(ivec3(pixel >> int(lampTileShift), layer)); }

// Clears the lowest set bit of 128 and returns its index. At least one bit must be set.
uint popFirstLamp(inout uvec4 bits) {
    uint word = bits.x != 0u ? 0u : bits.y != 0u ? 1u : bits.z != 0u ? 2u : 3u;
    uint first = bits.x != 0u ? bits.x : bits.y != 0u ? bits.y : bits.z != 0u ? bits.z : bits.w;
    uvec4 here = uvec4(equal(uvec4(word), uvec4(0u, 1u, 2u, 3u)));
    bits &= bits - here;
    return 32u * word + uint(findLSB(first));
}

bool lampMayReach(ivec2 pixel, uint lamp) {
    uint word = lampMaskAt(pixel, lamp / lampsPerLayer)[lamp / 32u % 4u];
    return (word >> (lamp % 32u) & 1u) != 0u;
}

#endif
