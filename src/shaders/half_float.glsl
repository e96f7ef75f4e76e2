// Keeps radiance inside what a half float holds, so that no inf or NaN gets into an image that a filter will spread.
#ifndef REFLET_HALF_FLOAT_GLSL
#define REFLET_HALF_FLOAT_GLSL

const float largestHalf = 65504.0;

// Negative values and NaN become 0.
vec3 clampToHalf(vec3 v) {
    v = mix(v, vec3(0.0), isnan(v));
    return clamp(v, vec3(0.0), vec3(largestHalf));
}

// The nearest half floats. A device may cut the rest off when it stores them (llvmpipe does), and a sum that is stored
// after each of its many parts would lose a percent.
vec4 roundToHalf(vec4 v) {
    uvec4 bits = floatBitsToUint(v);
    return uintBitsToFloat((bits + 0xfffu + ((bits >> 13u) & 1u)) & ~0x1fffu);
}

// One of the two nearest half floats of values from 0 to largestHalf, by chance, such that the mean is kept: a mean
// over frames whose steps are smaller than half floats tell apart does not get stuck. What is a half float but for
// rounding stays what it is. random: 32 bits.
vec3 ditherToHalf(vec3 v, uint random) {
    const uint margin = 64u;  // of 8192 steps of floats between two half floats
    uvec3 part = uvec3(random, random >> 10u, random >> 19u) & 0x1fffu;
    uvec3 bits = floatBitsToUint(v) + margin + part - ((part * margin) >> 12u);
    return uintBitsToFloat(bits & ~0x1fffu);
}

#endif
