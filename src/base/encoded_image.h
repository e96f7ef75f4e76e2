// PNG and JPEG images in memory: PNG by libspng, JPEG by libjpeg-turbo.
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace reflet {

bool isPng(std::span<const uint8_t> bytes);
bool isJpeg(std::span<const uint8_t> bytes);

/// What an image says of itself before its pixels.
struct EncodedImageHeader {
    uint32_t width = 0;
    uint32_t height = 0;
    uint32_t channels = 0;      ///< after decoding: 1 grey, 2 grey and alpha, 3 RGB, 4 RGBA
    uint32_t bitsPerPixel = 0;  ///< of a PNG, before compression; 0: JPEG
    bool deep = false;          ///< PNG of 16 bits per channel; rounded to 8 when it is decoded
};

// Both take bytes for which isPng or isJpeg holds, and throw Error with the reason alone: callers know the name.

/// Sizes are at least 1.
EncodedImageHeader readImageHeader(std::span<const uint8_t> bytes);

/// width · height · 4 bytes of RGBA, 8 bits per channel, not converted to another color space. Decoding takes up to
/// twice as much memory in addition, which callers have checked.
std::vector<uint8_t> decodeRgba(std::span<const uint8_t> bytes, const EncodedImageHeader& header);

/// Encodes width · height · channels bytes, channels: 3 or 4. Throws Error, also with the reason alone.
std::string encodePng(uint32_t width, uint32_t height, uint32_t channels, std::span<const uint8_t> pixels);

/// Whether a file of this size ends with the chunk that ends every PNG.
bool pngHasItsEnd(const std::filesystem::path& file, uint64_t size);

}  // namespace reflet
