// PNG and JPEG images, by stb_image.
#include "scene/gltf/image_formats.h"

#include "base/jpeg_check.h"
#include "base/png_check.h"

#include <stb/stb_image.h>

#include <algorithm>
#include <array>
#include <memory>
#include <span>
#include <vector>

namespace reflet {

namespace {

constexpr uint64_t maxDeflateRatio = 1032;
constexpr size_t depthAt = 24;                  // of the PNG header's bits per channel; the colour type follows
constexpr uint64_t maxJpegPixelsPerByte = 512;  // a block of 8 x 8 takes at least one bit

bool startsWith(std::span<const uint8_t> bytes, std::span<const uint8_t> magic) {
    return bytes.size() >= magic.size() && std::equal(magic.begin(), magic.end(), bytes.begin());
}

/// Upper bound on the pixels that the bytes can encode at any compression.
uint64_t mostPixels(std::span<const uint8_t> bytes) {
    if (isJpeg(bytes)) {
        return maxJpegPixelsPerByte * bytes.size();
    }
    constexpr std::array<uint64_t, 7> channels{1, 1, 3, 1, 2, 1, 4};  // by the PNG header's colour type
    const uint64_t depth = std::max<uint64_t>(bytes[depthAt], 1);
    const uint64_t bits = depth * channels.at(std::min<size_t>(bytes[depthAt + 1], 6));
    return maxDeflateRatio * bytes.size() * 8 / bits;
}

std::string reason() {
    const char* text = stbi_failure_reason();
    return text != nullptr ? text : "no reason given";
}

/// Frees what stb_image returns.
struct Free {
    void operator()(void* pixels) const { stbi_image_free(pixels); }
};

/// 16 bits per channel, rounded to 8.
std::vector<uint8_t> decodeDeep(std::span<const uint8_t> bytes, uint64_t pixels) {
    int width = 0;
    int height = 0;
    int channels = 0;
    const std::unique_ptr<stbi_us, Free> decoded(
        stbi_load_16_from_memory(bytes.data(), static_cast<int>(bytes.size()), &width, &height, &channels, 4));
    if (!decoded || uint64_t(width) * uint64_t(height) != pixels) {
        return {};
    }
    std::vector<uint8_t> rgba(pixels * 4);
    std::transform(decoded.get(), decoded.get() + pixels * 4, rgba.begin(),
                   [](uint32_t value) { return static_cast<uint8_t>((value * 255 + 32767) / 65535); });
    return rgba;
}

std::vector<uint8_t> decodeShallow(std::span<const uint8_t> bytes, uint64_t pixels) {
    int width = 0;
    int height = 0;
    int channels = 0;
    const std::unique_ptr<stbi_uc, Free> decoded(
        stbi_load_from_memory(bytes.data(), static_cast<int>(bytes.size()), &width, &height, &channels, 4));
    if (!decoded || uint64_t(width) * uint64_t(height) != pixels) {
        return {};
    }
    return {decoded.get(), decoded.get() + pixels * 4};
}

}  // namespace

bool isPng(std::span<const uint8_t> bytes) {
    constexpr std::array<uint8_t, 16> magic{0x89, 'P', 'N', 'G', '\r', '\n', 0x1A, '\n',
                                            0,    0,   0,   13,  'I',  'H',  'D',  'R'};
    return startsWith(bytes, magic);
}

bool isJpeg(std::span<const uint8_t> bytes) {
    return startsAsJpeg(bytes);
}

TextureImage decodeStb(std::span<const uint8_t> bytes, const std::string& part, GltfReport& report) {
    if (isPng(bytes) && bytes.size() < depthAt + 2) {  // stb takes what is missing for zeros
        report.fail(part, "is a broken image: its header is truncated");
    }
    if (const std::string problem = isJpeg(bytes) ? jpegProblem(bytes) : pngProblem(bytes); !problem.empty()) {
        report.fail(part, "is a broken image: {}", problem);
    }
    const int size = static_cast<int>(bytes.size());  // at most 2^30
    int width = 0;
    int height = 0;
    int channels = 0;
    if (stbi_info_from_memory(bytes.data(), size, &width, &height, &channels) == 0 || width <= 0 || height <= 0) {
        report.fail(part, "is a broken image: {}", reason());
    }
    const uint64_t pixels = uint64_t(width) * uint64_t(height);
    if (pixels > mostPixels(bytes)) {
        report.fail(part, "claims {} x {} pixels in only {} bytes", width, height, bytes.size());
    }
    checkImageSize(static_cast<uint64_t>(width), static_cast<uint64_t>(height), part, report);
    const bool deep = stbi_is_16_bit_from_memory(bytes.data(), size) != 0;
    if (deep) {
        report.charge(part, pixels * 8);
    }
    TextureImage image{.name = "",
                       .width = static_cast<uint32_t>(width),
                       .height = static_cast<uint32_t>(height),
                       .rgba = deep ? decodeDeep(bytes, pixels) : decodeShallow(bytes, pixels)};
    if (image.rgba.empty()) {
        report.fail(part, "is a broken image: {}", reason());
    }
    return image;
}

}  // namespace reflet
