// The vertex codec of KHR_meshopt_compression in version 1, which meshoptimizer decodes from its release 0.23 on, and
// its filter COLOR. After: Khronos, KHR_meshopt_compression, 2025, appendices A and B.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace reflet {

/// The first byte of a stream in version 1.
constexpr uint8_t meshoptVertexHeader1 = 0xA1;

/// Decodes `count` elements of `stride` bytes, a multiple of 4 up to 256, to `to`, which has their size. False if the
/// stream is invalid.
bool decodeMeshoptVertices(std::span<const uint8_t> stream, uint64_t stride, uint64_t count, std::span<uint8_t> to);

/// Replaces Y, Co, Cg and alpha of each element by R, G, B and alpha. stride: 4, of 8-bit, or 8, of 16-bit components.
void decodeMeshoptColors(std::span<uint8_t> elements, uint64_t stride);

}  // namespace reflet
