// Files of 8 bits per channel.
#include "base/image_file.h"

#include "base/encoded_image.h"
#include "base/error.h"
#include "base/file.h"
#include "base/limits.h"
#include "base/message.h"

#include <span>

namespace reflet {
namespace {

Bitmap decodeBitmap(std::span<const uint8_t> bytes) {
    const EncodedImageHeader header = readImageHeader(bytes);
    constexpr uint64_t bytesPerPixel = 16;  // RGBA of 16 bits, RGBA of 8 bits, the result
    if (const std::string excess = imageExcess(header.width, header.height, bytesPerPixel); !excess.empty()) {
        fail("it {}", excess);
    }
    Bitmap bitmap{header.width, header.height, header.channels, decodeRgba(bytes, header)};
    if (header.channels == 4) {
        return bitmap;
    }
    const bool hasAlpha = header.channels == 2;
    auto out = bitmap.data.begin();
    for (size_t i = 0; i < bitmap.data.size(); i += 4) {
        for (size_t c = 0; c < header.channels; ++c) {
            *out++ = bitmap.data[i + (hasAlpha && c == 1 ? 3 : c)];
        }
    }
    bitmap.data.resize(size_t{header.width} * header.height * header.channels);
    return bitmap;
}

}  // namespace

void writePng(const std::filesystem::path& path, const Bitmap& bitmap) {
    const size_t stride = size_t{bitmap.width} * bitmap.channels;
    REFLET_CHECK(bitmap.channels == 3 || bitmap.channels == 4, "{} channels", bitmap.channels);
    REFLET_CHECK(bitmap.width > 0 && bitmap.height > 0 && bitmap.data.size() == stride * bitmap.height,
                 "{}x{}, {} bytes", bitmap.width, bitmap.height, bitmap.data.size());
    writeFileAtomically(path, encodePng(bitmap.width, bitmap.height, bitmap.channels, bitmap.data));
}

Bitmap readBitmap(const std::filesystem::path& path) {
    const std::string content = readFile(path, memoryLimit());
    const std::span bytes(reinterpret_cast<const uint8_t*>(content.data()), content.size());
    if (!isPng(bytes) && !isJpeg(bytes)) {
        fail("{}: cannot be read as an image: it is neither PNG nor JPEG", path.string());
    }
    try {
        return decodeBitmap(bytes);
    } catch (const Error& error) {
        fail("{}: cannot be read as an image: {}", path.string(), error.what());
    }
}

}  // namespace reflet
