// Keeps radiance within the range of half floats, so that no inf or NaN reaches an image that a filter would spread.
#ifndef REFLET_HALF_FLOAT_GLSL
#define REFLET_HALF_FLOAT_GLSL

const float largestHalf = 65504.0;

// Negative values and NaN become 0.
vec3 clampToHalf(vec3 v) {
    v = mix(v, vec3(0.0), isnan(v));
    return clamp(v, vec3(0.0), vec3(largestHalf));
}

// Rounds to the nearest half float. Some devices truncate when they store (llvmpipe does), and a sum that is stored
// after each of many terms would lose a percent.
vec4 roundToHalf(vec4 v) {
    uvec4 bits = floatBitsToUint(v);
    return uintBitsToFloat((bits + 0xfffu + ((bits >> 13u) & 1u)) & ~0x1fffu);
}

// Stochastic rounding to one of the two nearest half floats, for values from 0 to largestHalf. It keeps the mean, so a
// running mean does not stall when its steps are smaller than the spacing of half floats. Values that already are half
// floats, up to rounding, do not change. random: 32 bits.
vec3 ditherToHalf(vec3 v, uint random) {
    const uint margin = 64u;  // of 8192 steps of floats between two half floats
    uvec3 part = uvec3(random, random >> 10u, random >> 19u) & 0x1fffu;
    uvec3 bits = floatBitsToUint(v) + margin + part - ((part * margin) >> 12u);
    return uintBitsToFloat(bits & ~0x1fffu);
}

#endif
