// Tells PNG from JPEG.
#include "base/encoded_image.h"

#include "base/jpeg.h"
#include "base/png.h"

#include <algorithm>
#include <array>

namespace reflet {

namespace {

bool startsWith(std::span<const uint8_t> bytes, std::span<const uint8_t> magic) {
    return bytes.size() >= magic.size() && std::equal(magic.begin(), magic.end(), bytes.begin());
}

}  // namespace

bool isPng(std::span<const uint8_t> bytes) {
    constexpr std::array<uint8_t, 8> magic{0x89, 'P', 'N', 'G', '\r', '\n', 0x1A, '\n'};
    return startsWith(bytes, magic);
}

bool isJpeg(std::span<const uint8_t> bytes) {
    constexpr std::array<uint8_t, 3> magic{0xFF, 0xD8, 0xFF};
    return startsWith(bytes, magic);
}

EncodedImageHeader readImageHeader(std::span<const uint8_t> bytes) {
    return isJpeg(bytes) ? readJpegHeader(bytes) : readPngHeader(bytes);
}

std::vector<uint8_t> decodeRgba(std::span<const uint8_t> bytes, const EncodedImageHeader& header) {
    return isJpeg(bytes) ? decodeJpeg(bytes, header) : decodePng(bytes, header);
}

}  // namespace reflet
