// WebP images, by libwebp. Its specification is RFC 9649 (Zern, Massimino and Alakuijala, 2024).
#include "scene/gltf/image_formats.h"

#include <webp/decode.h>

#include <algorithm>
#include <array>
#include <memory>

namespace reflet {

bool isWebp(std::span<const uint8_t> bytes) {
    constexpr std::array<uint8_t, 4> riff{'R', 'I', 'F', 'F'};
    constexpr std::array<uint8_t, 4> webp{'W', 'E', 'B', 'P'};
    return bytes.size() >= 12 && std::equal(riff.begin(), riff.end(), bytes.begin()) &&
           std::equal(webp.begin(), webp.end(), bytes.begin() + 8);
}

TextureImage decodeWebp(std::span<const uint8_t> bytes, const std::string& part, GltfReport& report) {
    WebPBitstreamFeatures features{};
    if (WebPGetFeatures(bytes.data(), bytes.size(), &features) != VP8_STATUS_OK) {
        report.fail(part, "is a broken WebP image");
    }
    if (features.has_animation != 0) {
        report.fail(part, "is an animated WebP image, which glTF does not allow");
    }
    checkImageSize(static_cast<uint64_t>(features.width), static_cast<uint64_t>(features.height), part, report);
    const uint64_t pixels = static_cast<uint64_t>(features.width) * static_cast<uint64_t>(features.height);
    report.charge(part, pixels * 4);
    // Memory of libwebp's own, which costs nothing before it is written: a broken image may claim any size.
    int width = 0;
    int height = 0;
    const std::unique_ptr<uint8_t, void (*)(void*)> decoded(WebPDecodeRGBA(bytes.data(), bytes.size(), &width, &height),
                                                            WebPFree);
    if (!decoded || width != features.width || height != features.height) {
        report.fail(part, "is a broken WebP image");
    }
    return {.name = "",
            .width = static_cast<uint32_t>(width),
            .height = static_cast<uint32_t>(height),
            .rgba = {decoded.get(), decoded.get() + pixels * 4}};
}

}  // namespace reflet
