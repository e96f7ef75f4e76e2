// PNG and JPEG images.
#include "base/encoded_image.h"
#include "base/error.h"
#include "scene/gltf/image_formats.h"

#include <span>

namespace reflet {

namespace {

/// Upper bound on the pixels that so many bytes can encode at any compression.
uint64_t mostPixels(size_t bytes, const EncodedImageHeader& header) {
    constexpr uint64_t maxDeflateRatio = 1032;
    constexpr uint64_t maxJpegPixelsPerByte = 512;  // a block of 8 x 8 takes at least one bit
    return header.bitsPerPixel == 0 ? maxJpegPixelsPerByte * bytes : maxDeflateRatio * bytes * 8 / header.bitsPerPixel;
}

/// What `read` returns; its reason, if it fails, is said of the part.
template <class Read>
auto readOf(const std::string& part, const GltfReport& report, const Read& read) {
    try {
        return read();
    } catch (const Error& error) {
        report.fail(part, "is a broken image: {}", error.what());
    }
}

}  // namespace

TextureImage decodePngOrJpeg(std::span<const uint8_t> bytes, const std::string& part, GltfReport& report) {
    const EncodedImageHeader header = readOf(part, report, [&] { return readImageHeader(bytes); });
    const uint64_t pixels = uint64_t{header.width} * header.height;
    if (pixels > mostPixels(bytes.size(), header)) {
        report.fail(part, "claims {} x {} pixels in only {} bytes", header.width, header.height, bytes.size());
    }
    checkImageSize(header.width, header.height, part, report);
    if (header.deep) {
        report.charge(part, pixels * 8);
    }
    return {.name = "", .width = header.width, .height = header.height, .rgba = readOf(part, report, [&] {
                                                                            return decodeRgba(bytes, header);
                                                                        })};
}

}  // namespace reflet
