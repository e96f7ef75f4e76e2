// Reads the bytes of an image of a glTF file and decodes them by their format.
#include "scene/gltf/image.h"

#include "base/encoded_image.h"
#include "base/limits.h"
#include "scene/gltf/image_formats.h"
#include "scene/gltf/uri.h"

#include <span>

namespace reflet {

namespace {

constexpr uint64_t maxImageBytes = 1ULL << 30U;
constexpr uint64_t maxSide = 16384;
constexpr uint64_t formatBytes = 64;  // tell what isBasis asks

TextureImage decode(std::span<const uint8_t> bytes, const std::string& part, GltfReport& report) {
    if (bytes.size() > maxImageBytes) {
        report.fail(part, "has {} bytes, more than the limit of {} MiB", bytes.size(), maxImageBytes >> 20U);
    }
    report.charge(part, bytes.size());  // limits the total time where images share them
    if (isWebp(bytes)) {
        return decodeWebp(bytes, part, report);
    }
    if (isKtx2(bytes)) {
        return decodeKtx2(bytes, part, report);
    }
    if (!isPng(bytes) && !isJpeg(bytes)) {
        report.fail(part, "is not a PNG, JPEG, WebP or KTX 2 image");
    }
    return decodePngOrJpeg(bytes, part, report);
}

std::span<const uint8_t> bytesOfView(const GltfDocument& document, int index, GltfReport& report) {
    report.use("bufferViews", static_cast<size_t>(index));
    const auto& view = document.model.bufferViews[static_cast<size_t>(index)];
    const std::span bytes(document.model.buffers[static_cast<size_t>(view.buffer)].data);
    return bytes.subspan(view.byteOffset, view.byteLength);
}

}  // namespace

void checkImageSize(uint64_t width, uint64_t height, const std::string& part, GltfReport& report) {
    if (width == 0 || height == 0 || width > maxSide || height > maxSide) {
        report.fail(part, "has {} x {} pixels, but each side must have 1 to {}", width, height, maxSide);
    }
    if (const std::string excess = imageExcess(width, height, textureBytesPerPixel); !excess.empty()) {
        report.fail(part, "{}", excess);
    }
    report.charge(part, width * height * 4);
}

TextureImage decodeGltfImage(const GltfDocument& document, size_t index, GltfReport& report) {
    const tinygltf::Image& source = document.model.images[index];
    const std::string part = fmt::format("images[{}]", index);
    TextureImage image;
    if (source.bufferView >= 0) {
        image = decode(bytesOfView(document, source.bufferView, report), part, report);
    } else if (!source.uri.empty()) {
        image = decode(readUri(source.uri, document.folder, maxImageBytes + 1, part + ".uri", report), part, report);
    } else {
        report.fail(part, "has neither a uri nor a bufferView");
    }
    image.name = !source.name.empty() || source.uri.starts_with("data:") ? source.name : percentDecoded(source.uri);
    return image;
}

GltfImagePlace placeOfGltfImage(const GltfDocument& document, size_t index, const GltfReport& report) {
    const tinygltf::Image& source = document.model.images[index];
    if (source.bufferView < 0) {
        return {.uri = source.uri};
    }
    report.use("bufferViews", static_cast<size_t>(source.bufferView));
    const auto& view = document.model.bufferViews[static_cast<size_t>(source.bufferView)];
    return {.uri = {}, .buffer = view.buffer, .offset = view.byteOffset, .length = view.byteLength};
}

bool gltfImageIsBasis(const GltfDocument& document, size_t index, GltfReport& report) {
    const tinygltf::Image& source = document.model.images[index];
    if (source.bufferView >= 0) {
        return isBasis(bytesOfView(document, source.bufferView, report));
    }
    return !source.uri.empty() &&
           isBasis(readUri(source.uri, document.folder, formatBytes, fmt::format("images[{}].uri", index), report));
}

}  // namespace reflet
