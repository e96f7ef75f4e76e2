// Decodes images by stb_image, after checking their claimed size.
#include "scene/gltf_image.h"

#include "scene/gltf_uri.h"

#include <stb/stb_image.h>

#include <algorithm>
#include <array>
#include <memory>
#include <span>

namespace reflet {

namespace {

constexpr uint64_t maxImageBytes = 1ULL << 30U;
constexpr int maxSide = 16384;
constexpr uint64_t maxDeflateRatio = 1032;
constexpr uint64_t maxJpegPixelsPerByte = 512;  // a block of 8 x 8 takes at least one bit

bool startsWith(std::span<const uint8_t> bytes, std::span<const uint8_t> magic) {
    return bytes.size() >= magic.size() && std::equal(magic.begin(), magic.end(), bytes.begin());
}

bool isPng(std::span<const uint8_t> bytes) {
    constexpr std::array<uint8_t, 16> magic{0x89, 'P', 'N', 'G', '\r', '\n', 0x1A, '\n',
                                            0,    0,   0,   13,  'I',  'H',  'D',  'R'};
    return startsWith(bytes, magic);
}

bool isJpeg(std::span<const uint8_t> bytes) {
    constexpr std::array<uint8_t, 3> magic{0xFF, 0xD8, 0xFF};
    return startsWith(bytes, magic);
}

/// Upper bound on the pixels that the bytes can encode at any compression.
uint64_t mostPixels(std::span<const uint8_t> bytes) {
    if (isJpeg(bytes)) {
        return maxJpegPixelsPerByte * bytes.size();
    }
    constexpr std::array<uint64_t, 7> channels{1, 1, 3, 1, 2, 1, 4};  // by the PNG header's colour type
    constexpr size_t depthAt = 24;
    const uint64_t depth = std::max<uint64_t>(bytes[depthAt], 1);
    const uint64_t bits = depth * channels.at(std::min<size_t>(bytes[depthAt + 1], 6));
    return maxDeflateRatio * bytes.size() * 8 / bits;
}

std::string reason() {
    const char* text = stbi_failure_reason();
    return text != nullptr ? text : "no reason given";
}

Image decode(std::span<const uint8_t> bytes, const std::string& part, GltfReport& report) {
    if (!isPng(bytes) && !isJpeg(bytes)) {  // stb_image supports more formats than glTF allows
        report.fail(part, "is neither PNG nor JPEG");
    }
    if (bytes.size() > maxImageBytes) {
        report.fail(part, "has {} bytes, more than the limit of {} MiB", bytes.size(), maxImageBytes >> 20U);
    }
    const int size = static_cast<int>(bytes.size());
    int width = 0;
    int height = 0;
    int channels = 0;
    if (stbi_info_from_memory(bytes.data(), size, &width, &height, &channels) == 0 || width <= 0 || height <= 0) {
        report.fail(part, "is a broken image: {}", reason());
    }
    const uint64_t pixels = uint64_t(width) * uint64_t(height);
    if (width > maxSide || height > maxSide) {
        report.fail(part, "has {} x {} pixels, more than the limit of {} per side", width, height, maxSide);
    }
    if (pixels > mostPixels(bytes)) {
        report.fail(part, "claims {} x {} pixels in only {} bytes", width, height, bytes.size());
    }
    report.charge(part, pixels * 4 + bytes.size());  // the bytes limit the total time where images share them
    const std::unique_ptr<stbi_uc, void (*)(void*)> decoded(
        stbi_load_from_memory(bytes.data(), size, &width, &height, &channels, 4), stbi_image_free);
    if (!decoded || uint64_t(width) * uint64_t(height) != pixels) {
        report.fail(part, "is a broken image: {}", reason());
    }
    return {.name = "",
            .width = static_cast<uint32_t>(width),
            .height = static_cast<uint32_t>(height),
            .rgba = {decoded.get(), decoded.get() + pixels * 4}};
}

}  // namespace

Image decodeGltfImage(const GltfDocument& document, size_t index, GltfReport& report) {
    const tinygltf::Image& source = document.model.images[index];
    const std::string part = fmt::format("images[{}]", index);
    Image image;
    if (source.bufferView >= 0) {
        report.use("bufferViews", static_cast<size_t>(source.bufferView));
        const auto& view = document.model.bufferViews[static_cast<size_t>(source.bufferView)];
        const std::span bytes(document.model.buffers[static_cast<size_t>(view.buffer)].data);
        image = decode(bytes.subspan(view.byteOffset, view.byteLength), part, report);
    } else if (!source.uri.empty()) {
        image = decode(readUri(source.uri, document.folder, maxImageBytes + 1, part + ".uri", report), part, report);
    } else {
        report.fail(part, "has neither a uri nor a bufferView");
    }
    image.name = !source.name.empty() || source.uri.starts_with("data:") ? source.name : percentDecoded(source.uri);
    return image;
}

}  // namespace reflet
