// KTX 2 textures that are not block-compressed. Layout: "KTX File Format Specification", version 2.0, Khronos, 2021.
#include "scene/gltf/image_formats.h"

#include <zstd.h>

#include <algorithm>
#include <array>

namespace reflet {

namespace {

constexpr size_t formatAt = 12;
constexpr size_t widthAt = 20;
constexpr size_t heightAt = 24;
constexpr size_t depthAt = 28;
constexpr size_t layersAt = 32;
constexpr size_t facesAt = 36;
constexpr size_t schemeAt = 44;
constexpr size_t firstLevelAt = 80;  // byteOffset, byteLength, uncompressedByteLength
constexpr size_t headerBytes = 104;

constexpr uint32_t schemeNone = 0;
constexpr uint32_t schemeBasisLz = 1;
constexpr uint32_t schemeZstandard = 2;

template <class T>
T readLittleEndian(std::span<const uint8_t> bytes, size_t at) {
    T value = 0;
    for (size_t i = 0; i < sizeof(T); ++i) {
        value |= static_cast<T>(T(bytes[at + i]) << (8 * i));
    }
    return value;
}

uint32_t word(std::span<const uint8_t> bytes, size_t at) {
    return readLittleEndian<uint32_t>(bytes, at);
}

/// Bytes per pixel of VK_FORMAT_R8*_UNORM and _SRGB; 0: another format. Which of the two does not matter: a texture's
/// use in the material decides.
uint64_t channelsOf(uint32_t format) {
    switch (format) {
        case 9:   // R8_UNORM
        case 15:  // R8_SRGB
            return 1;
        case 16:  // R8G8_UNORM
        case 22:  // R8G8_SRGB
            return 2;
        case 23:  // R8G8B8_UNORM
        case 29:  // R8G8B8_SRGB
            return 3;
        case 37:  // R8G8B8A8_UNORM
        case 43:  // R8G8B8A8_SRGB
            return 4;
        default:
            return 0;
    }
}

/// The pixels of the largest level, tightly packed.
std::vector<uint8_t> readLevel(std::span<const uint8_t> bytes, uint64_t size, const std::string& part,
                               GltfReport& report) {
    const auto offset = readLittleEndian<uint64_t>(bytes, firstLevelAt);
    const auto length = readLittleEndian<uint64_t>(bytes, firstLevelAt + 8);
    if (offset > bytes.size() || length > bytes.size() - offset) {
        report.fail(part, "is a broken KTX 2 image: its pixels reach past its {} bytes", bytes.size());
    }
    const auto level = bytes.subspan(offset, length);
    const uint32_t scheme = word(bytes, schemeAt);
    report.charge(part, size);
    std::vector<uint8_t> pixels;
    if (scheme == schemeNone) {
        pixels.assign(level.begin(), level.begin() + static_cast<std::ptrdiff_t>(std::min(length, size)));
    } else if (scheme == schemeZstandard) {
        if (ZSTD_getFrameContentSize(level.data(), level.size()) != size) {
            report.fail(part, "is a broken KTX 2 image: its Zstandard data does not claim {} bytes of pixels", size);
        }
        pixels.resize(size);
        const size_t read = ZSTD_decompress(pixels.data(), pixels.size(), level.data(), level.size());
        pixels.resize(ZSTD_isError(read) != 0 ? 0 : read);
    } else {
        report.fail(part,
                    "is a KTX 2 image with supercompression {}, but only none (0) and Zstandard (2) are supported",
                    scheme);
    }
    if (pixels.size() != size) {
        report.fail(part, "is a broken KTX 2 image: it does not hold {} bytes of pixels", size);
    }
    return pixels;
}

}  // namespace

bool isKtx2(std::span<const uint8_t> bytes) {
    constexpr std::array<uint8_t, 12> magic{0xAB, 'K', 'T', 'X', ' ', '2', '0', 0xBB, '\r', '\n', 0x1A, '\n'};
    return bytes.size() >= magic.size() && std::equal(magic.begin(), magic.end(), bytes.begin());
}

bool isBasis(std::span<const uint8_t> bytes) {
    constexpr uint32_t formatUndefined = 0;  // says UASTC in all that glTF allows
    return isKtx2(bytes) && bytes.size() >= schemeAt + 4 &&
           (word(bytes, formatAt) == formatUndefined || word(bytes, schemeAt) == schemeBasisLz);
}

TextureImage decodeKtx2(std::span<const uint8_t> bytes, const std::string& part, GltfReport& report) {
    if (isBasis(bytes)) {
        report.fail(part,
                    "is compressed with Basis Universal, which is not supported: convert it, for example with "
                    "\"ktx transcode --target rgba8\"");
    }
    if (bytes.size() < headerBytes) {
        report.fail(part, "is a broken KTX 2 image: it has only {} bytes", bytes.size());
    }
    const uint64_t channels = channelsOf(word(bytes, formatAt));
    if (channels == 0) {
        report.fail(part, "is a KTX 2 image of VkFormat {}, but only 8-bit R, RG, RGB and RGBA are supported",
                    word(bytes, formatAt));
    }
    if (word(bytes, depthAt) != 0 || word(bytes, layersAt) > 1 || word(bytes, facesAt) != 1) {
        report.fail(part, "is a KTX 2 image with layers, faces or depth, not a two-dimensional one");
    }
    TextureImage image;
    image.width = word(bytes, widthAt);
    image.height = word(bytes, heightAt);
    checkImageSize(image.width, image.height, part, report);
    const uint64_t count = uint64_t(image.width) * image.height;
    const std::vector<uint8_t> pixels = readLevel(bytes, count * channels, part, report);
    image.rgba.assign(count * 4, 0);
    for (uint64_t i = 0; i < count; ++i) {
        std::copy_n(pixels.begin() + static_cast<std::ptrdiff_t>(i * channels), channels,
                    image.rgba.begin() + static_cast<std::ptrdiff_t>(i * 4));
        image.rgba[i * 4 + 3] = channels == 4 ? image.rgba[i * 4 + 3] : 255;
    }
    return image;
}

}  // namespace reflet
