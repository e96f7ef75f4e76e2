// Images as bytes, to compare without any tolerance.
#pragma once

#include "base/math.h"
#include "gpu/vulkan.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cstddef>
#include <cstring>
#include <map>
#include <string>
#include <vector>

namespace reflet::test {

struct RawImage {
    VkFormat format = VK_FORMAT_UNDEFINED;
    uvec2 size{0};
    std::vector<std::byte> texels;
};

using RawImages = std::map<std::string, RawImage>;

inline size_t bytesOfTexel(const RawImage& image) {
    return image.texels.size() / (size_t(image.size.x) * image.size.y);
}

// What the two made of one image.
inline void expectSame(const std::string& where, const RawImage& renderer, const RawImage& library) {
    ASSERT_EQ(renderer.texels.size(), library.texels.size()) << where;
    const size_t stride = bytesOfTexel(renderer);
    size_t others = 0;
    size_t first = 0;
    for (size_t i = 0; i < renderer.texels.size(); i += stride) {
        if (std::memcmp(&renderer.texels[i], &library.texels[i], stride) != 0) {
            first = others == 0 ? i / stride : first;
            ++others;
        }
    }
    const auto text = [&](const RawImage& image) {
        std::string bytes;
        for (size_t k = 0; k < stride; ++k) {
            bytes += fmt::format("{:02x}", static_cast<unsigned>(image.texels[first * stride + stride - 1 - k]));
        }
        return bytes;
    };
    EXPECT_EQ(others, 0U) << where << ": first at " << first % renderer.size.x << ", " << first / renderer.size.x
                          << ": renderer " << text(renderer) << ", library " << text(library);
}

}  // namespace reflet::test
