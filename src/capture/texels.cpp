// Decodes read-back images.
#include "capture/texels.h"

#include "base/error.h"
#include "base/octahedral.h"

#include <glm/gtc/packing.hpp>

#include <cstring>

namespace reflet {

namespace {

template <class T>
T loadAs(const std::byte* at) {
    T value{};
    std::memcpy(&value, at, sizeof(T));
    return value;
}

vec4 decode(VkFormat format, const std::byte* at) {
    switch (format) {
        case VK_FORMAT_D32_SFLOAT:
        case VK_FORMAT_R32_SFLOAT:
            return {loadAs<float>(at), 0, 0, 1};
        case VK_FORMAT_R8_UNORM:
            return {static_cast<float>(loadAs<uint8_t>(at)) / 255.0F, 0, 0, 1};
        case VK_FORMAT_R8G8B8A8_UNORM:
            return glm::unpackUnorm4x8(loadAs<uint32_t>(at));
        case VK_FORMAT_A2B10G10R10_UNORM_PACK32:
            return glm::unpackUnorm3x10_1x2(loadAs<uint32_t>(at));
        case VK_FORMAT_B10G11R11_UFLOAT_PACK32:
            return {glm::unpackF2x11_1x10(loadAs<uint32_t>(at)), 1};
        case VK_FORMAT_R16G16_SFLOAT:
            return {glm::unpackHalf2x16(loadAs<uint32_t>(at)), 0, 1};
        case VK_FORMAT_R16G16B16A16_SFLOAT:
            return glm::unpackHalf4x16(loadAs<uint64_t>(at));
        case VK_FORMAT_R32G32_SFLOAT:
            return {loadAs<vec2>(at), 0, 1};
        case VK_FORMAT_R32G32B32A32_SFLOAT:
            return loadAs<vec4>(at);
        case VK_FORMAT_R32_UINT:
            return {unpackUnitVector(loadAs<uint32_t>(at)), 1};
        default:
            break;
    }
    REFLET_CHECK(false, "VkFormat {} cannot be decoded", static_cast<int>(format));
    return {};
}

}  // namespace

std::vector<vec4> decodeTexels(VkFormat format, std::span<const std::byte> bytes) {
    const size_t stride = gpu::bytesPerTexel(format);
    std::vector<vec4> texels(bytes.size() / stride);
    for (size_t i = 0; i < texels.size(); ++i) {
        texels[i] = decode(format, bytes.data() + i * stride);
    }
    return texels;
}

}  // namespace reflet
