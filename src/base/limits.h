// Limits on what an input file may make the program take. SECURITY.md lists them all.
#pragma once

#include <cstdint>
#include <string>

namespace reflet {

/// Memory in bytes that one scene, or one image file that is no part of a scene, may ask for: 8 GiB, or the GiB that
/// the environment variable REFLET_MEMORY_LIMIT says (0.001 to 1048576). Throws UsageError if it says anything else.
uint64_t memoryLimit();

/// How to raise memoryLimit() to at least `bytes`, as the end of an error message.
std::string raiseMemoryLimit(uint64_t bytes);

/// What is wrong with an image of this size, as the end of an error message; empty: nothing. A single image may take a
/// quarter of memoryLimit() while it is decoded.
/// bytesPerPixel: peak while decoding, all copies included.
std::string imageExcess(uint64_t width, uint64_t height, uint64_t bytesPerPixel);

/// Peak memory of an 8-bit image until it is a texture, in bytes per pixel: measured on a PNG of 16384 x 16384 pixels,
/// with the inflated rows, the decoded texels, the staging copy and the mipmaps of a device that shares the memory.
constexpr uint64_t textureBytesPerPixel = 22;

}  // namespace reflet
