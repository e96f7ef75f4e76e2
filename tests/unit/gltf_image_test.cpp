// Images of glTF files: WebP, KTX 2 and PNG with 16 bits against the pixels that were encoded.
#include "gltf_encoders.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numeric>

namespace reflet::test::gltf_image_test {
namespace {

using nlohmann::json;

/// A triangle whose material shows that texture.
GltfBuilder showing(const std::function<int(GltfBuilder&)>& addTexture) {
    GltfBuilder b = triangle();
    const int texture = addTexture(b);
    b.document["meshes"][0]["primitives"][0]["material"] =
        b.add("materials", {{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", texture}}}}}});
    return b;
}

TextureImage imageOf(const std::vector<uint8_t>& bytes, const std::string& extension = "") {
    GltfBuilder b = showing([&](GltfBuilder& to) { return addTextureOf(to, bytes, extension); });
    if (!extension.empty()) {
        b.document["extensionsUsed"] = {extension};
        b.document["extensionsRequired"] = {extension};
    }
    const Loaded loaded = load(std::move(b));
    EXPECT_TRUE(loaded.warnings.empty());
    EXPECT_GE(loaded.scene.materials[0].baseColorTexture.image, 0);
    return loaded.scene.images.at(0);
}

std::string complaintAbout(const std::vector<uint8_t>& bytes) {
    return complaint(
        showing([&](GltfBuilder& to) { return addTextureOf(to, bytes); }).writeGltf(testFolder() / "a.gltf"));
}

std::vector<uint8_t> gradient(size_t count) {
    std::vector<uint8_t> values(count);
    std::iota(values.begin(), values.end(), uint8_t(1));
    return values;
}

TEST(GltfImage, AWebpTextureHasThePixelsThatWereEncoded) {
    const std::vector<uint8_t> pixels = gradient(5 * 3 * 4);
    for (const char* extension : {"", "EXT_texture_webp"}) {
        const TextureImage image = imageOf(webpOf(5, 3, pixels), extension);
        EXPECT_EQ(image.width, 5U);
        EXPECT_EQ(image.height, 3U);
        EXPECT_EQ(image.rgba, pixels);
    }
}

TEST(GltfImage, TheWebpImageIsPreferredToItsFallback) {
    GltfBuilder b = showing([](GltfBuilder& to) {
        const int texture = addTextureOf(to, webpOf(1, 1, {1, 2, 3, 255}), "EXT_texture_webp");
        const std::vector<uint8_t> png = pngOf(2, 2, {9, 9, 9, 255});
        to.document["textures"][texture]["source"] =
            to.add("images", {{"bufferView", to.addView(png.data(), png.size())}});
        return texture;
    });
    const Scene scene = load(b).scene;
    ASSERT_EQ(scene.images.size(), 1U) << "the other is not decoded";
    EXPECT_EQ(scene.images[0].rgba, (std::vector<uint8_t>{1, 2, 3, 255}));
}

TEST(GltfImage, KtxTexturesOfOneToFourChannelsAreReadWithAndWithoutZstandard) {
    struct Case {
        uint32_t format;
        size_t channels;
    };
    for (const Case c :
         {Case{9, 1}, Case{15, 1}, Case{16, 2}, Case{22, 2}, Case{23, 3}, Case{29, 3}, Case{37, 4}, Case{43, 4}}) {
        for (const bool zstd : {false, true}) {
            const std::vector<uint8_t> pixels = gradient(3 * 2 * c.channels);
            const TextureImage image = imageOf(ktx2Of(3, 2, c.format, pixels, zstd), "KHR_texture_basisu");
            ASSERT_EQ(image.rgba.size(), 24U);
            for (size_t i = 0; i < 24; ++i) {
                const size_t channel = i % 4;
                const int expected = channel < c.channels ? pixels[i / 4 * c.channels + channel]
                                     : channel == 3       ? 255
                                                          : 0;
                EXPECT_EQ(int(image.rgba[i]), expected) << c.format << ", " << i;
            }
        }
    }
}

TEST(GltfImage, ABasisTextureIsReplacedByItsFallbackOrLeftOutWithAWarning) {
    constexpr uint32_t undefined = 0;
    GltfBuilder b = showing([&](GltfBuilder& to) {
        return addTextureOf(to, ktx2Of(1, 1, undefined, gradient(16), false), "KHR_texture_basisu");
    });
    Loaded loaded = load(b);
    ASSERT_EQ(loaded.warnings.size(), 1U);
    EXPECT_NE(loaded.warnings[0].find("the texture will be missing: images[0] is compressed with Basis Universal"),
              std::string::npos);
    EXPECT_NE(loaded.warnings[0].find("ktx transcode --target rgba8"), std::string::npos);
    EXPECT_LT(loaded.scene.materials[0].baseColorTexture.image, 0);
    const std::vector<uint8_t> png = pngOf(1, 1, {9, 8, 7, 255});
    b.document["textures"][0]["source"] = b.add("images", {{"bufferView", b.addView(png.data(), png.size())}});
    loaded = load(b);
    EXPECT_TRUE(loaded.warnings.empty());
    EXPECT_EQ(loaded.scene.images.at(0).rgba, (std::vector<uint8_t>{9, 8, 7, 255}));
    EXPECT_NE(complaintAbout(ktx2Of(1, 1, undefined, gradient(16), false)).find("Basis Universal"), std::string::npos);
}

TEST(GltfImage, SixteenBitsAreRoundedToEight) {
    std::vector<uint16_t> deep;
    for (uint32_t i = 0; i < 64 * 4; ++i) {
        deep.push_back(static_cast<uint16_t>(i * 257 + (i % 3 == 0 ? 0 : i % 3 == 1 ? 128 : 129)));
    }
    deep.back() = 65535;
    const TextureImage image = imageOf(deepPngOf(8, 8, deep));
    ASSERT_EQ(image.rgba.size(), deep.size());
    for (size_t i = 0; i < deep.size(); ++i) {
        EXPECT_EQ(int(image.rgba[i]), std::lround(deep[i] / 65535.0 * 255.0)) << deep[i];
    }
}

TEST(GltfImage, BrokenOnesAreErrors) {
    const std::vector<uint8_t> webp = webpOf(5, 3, gradient(60));
    EXPECT_NE(complaintAbout({webp.begin(), webp.begin() + 30}).find("images[0]: is a broken WebP"), std::string::npos);
    const auto ktx = [](size_t at, uint8_t value, bool zstd = false) {
        std::vector<uint8_t> bytes = ktx2Of(3, 2, 37, gradient(24), zstd);
        bytes[at] = value;
        return complaintAbout(bytes);
    };
    EXPECT_NE(ktx(12, 145).find("images[0]: is a KTX 2 image of VkFormat 145"), std::string::npos);
    EXPECT_NE(ktx(20, 0).find("has 0 x 2 pixels"), std::string::npos);
    EXPECT_NE(ktx(22, 1).find("has 65539 x 2 pixels"), std::string::npos);
    EXPECT_NE(ktx(20, 4).find("does not hold 32 bytes of pixels"), std::string::npos);
    EXPECT_NE(ktx(20, 4, true).find("does not claim 32 bytes of pixels"), std::string::npos);
    EXPECT_NE(ktx(28, 1).find("layers, faces or depth"), std::string::npos);
    EXPECT_NE(ktx(36, 6).find("layers, faces or depth"), std::string::npos);
    EXPECT_NE(ktx(44, 3).find("supercompression 3"), std::string::npos);
    EXPECT_NE(ktx(87, 255).find("its pixels reach past"), std::string::npos);
    EXPECT_NE(ktx(88, 255).find("its pixels reach past"), std::string::npos);
    EXPECT_NE(ktx(110, 255, true).find("KTX 2"), std::string::npos);
    const std::vector<uint8_t> whole = ktx2Of(3, 2, 37, gradient(24), false);
    for (size_t length = 12; length < whole.size(); ++length) {
        EXPECT_NE(complaintAbout({whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(length)}), "") << length;
    }
}

}  // namespace
}  // namespace reflet::test::gltf_image_test
