// Owen-scrambled Sobol' samples in two dimensions, of 32 bits: of 2^n successive ones from a multiple of 2^n, one is in
// each cell of every grid of 2^n equal cells of the unit square.
#pragma once

#include <cstdint>

namespace reflet {

inline uint32_t reverseBits(uint32_t x) {
    x = (x << 16U) | (x >> 16U);
    x = ((x & 0x00ff00ffU) << 8U) | ((x & 0xff00ff00U) >> 8U);
    x = ((x & 0x0f0f0f0fU) << 4U) | ((x & 0xf0f0f0f0U) >> 4U);
    x = ((x & 0x33333333U) << 2U) | ((x & 0xccccccccU) >> 2U);
    return ((x & 0x55555555U) << 1U) | ((x & 0xaaaaaaaaU) >> 1U);
}

/// A hash in which each bit depends only on lower bits; on reversed bits it is an Owen scrambling.
/// (Laine and Karras, Stratified Sampling for Stochastic Transparency, EGSR 2011; constants: Vegdahl 2021)
inline uint32_t owenScrambled(uint32_t x, uint32_t seed) {
    x ^= x * 0x3d20adeaU;
    x += seed;
    x *= (seed >> 16U) | 1U;
    x ^= x * 0x05526c56U;
    x ^= x * 0x53a22864U;
    return x;
}

/// Sobol's second dimension: its generator matrix is Pascal's triangle modulo 2, the fifth Kronecker power of
/// ((1, 1), (0, 1)), so that five steps multiply by it. x: the index with reversed bits. The first dimension is that,
/// too.
inline uint32_t sobolSecond(uint32_t x) {
    x ^= (x & 0x0000ffffU) << 16U;
    x ^= (x & 0x00ff00ffU) << 8U;
    x ^= (x & 0x0f0f0f0fU) << 4U;
    x ^= (x & 0x33333333U) << 2U;
    x ^= (x & 0x55555555U) << 1U;
    return x;
}

}  // namespace reflet
