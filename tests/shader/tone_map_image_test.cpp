// effects/tonemap: the pass on the device and the function on the CPU give the same image.
#include "effects/tonemap/tone_map_image.h"

#include "base/error.h"
#include "shader/directions.h"
#include "shader/harness.h"

#include <algorithm>
#include <cstring>
#include <limits>

namespace reflet::test::tone_map_image_test {
namespace {

constexpr ToneCurve curves[] = {ToneCurve::gamma22, ToneCurve::srgb, ToneCurve::aces, ToneCurve::agx,
                                ToneCurve::neutral};

FloatImage imageOf(uvec2 size, const std::vector<vec3>& colors) {
    FloatImage image{size.x, size.y, {"R", "G", "B"}, {}};
    for (const vec3& c : colors) {
        image.data.insert(image.data.end(), {c.x, c.y, c.z});
    }
    return image;
}

class ToneMapImage : public ShaderTest {
protected:
    static constexpr uvec2 size{256, 128};

    /// Greys, then colours of every hue and saturation, from dark to the largest half.
    static std::vector<vec3> colors() {
        const auto directions = spreadDirections(512);
        std::vector<vec3> result;
        for (uint32_t i = 0; i < size.x * size.y; ++i) {
            const float strength = std::exp2(-20.0F + 36.0F * static_cast<float>(i % 1021) / 1020.0F);
            const vec3 hue = i < 2048 ? vec3(1.0F) : glm::abs(directions[i % 512]);
            result.push_back(glm::min(hue * strength, 65504.0F));
        }
        return result;
    }

    /// RGBA8 texels.
    static std::vector<uint8_t> onDevice(const std::vector<vec3>& colors, const TonemapSettings& settings) {
        const gpu::Buffer upload(device(), colors.size() * sizeof(vec3), VK_BUFFER_USAGE_STORAGE_BUFFER_BIT,
                                 gpu::MemoryUse::upload, "colors");
        std::memcpy(upload.bytes().data(), colors.data(), colors.size() * sizeof(vec3));
        registerTestShaders();
        gpu::Frame& f = frame();
        f.begin();
        const gpu::Image radiance = f.image("radiance", VK_FORMAT_R16G16B16A16_SFLOAT, size);
        f.compute("fill", "tone_map_image_test.comp")
            .read("colors", upload.view())
            .write("radiance", radiance)
            .dispatch(size);
        const gpu::Readback copy = f.readback(tonemap(f, radiance, settings));
        f.submit();
        f.wait();
        const auto bytes = f.bytes(copy);
        std::vector<uint8_t> texels(bytes.size());
        std::memcpy(texels.data(), bytes.data(), bytes.size());
        return texels;
    }
};

TEST_F(ToneMapImage, isWithinOneStepOfTheDevicesForEveryCurve) {
    const auto given = colors();
    for (const ToneCurve curve : curves) {
        for (const float exposure : {0.0F, -3.3F, 5.0F}) {
            const TonemapSettings settings{exposure, curve};
            const auto expected = onDevice(given, settings);
            const Bitmap shown = toneMapped(imageOf(size, given), settings);
            ASSERT_EQ(shown.channels, 3U);
            int largest = 0;
            size_t different = 0;
            for (size_t i = 0; i < shown.data.size(); ++i) {
                const int off = std::abs(int{shown.data[i]} - int{expected[i / 3 * 4 + i % 3]});
                largest = std::max(largest, off);
                different += off > 0 ? 1 : 0;
            }
            EXPECT_LE(largest, 1) << "curve " << static_cast<uint32_t>(curve) << ", exposure " << exposure;
            RecordProperty(fmt::format("share_{}_{}", static_cast<uint32_t>(curve), exposure),
                           fmt::format("{:.5f}", static_cast<double>(different) / shown.data.size()));
        }
    }
}

TEST_F(ToneMapImage, showsEveryFloatingPointNumber) {
    constexpr float infinity = std::numeric_limits<float>::infinity();
    const float nan = std::numeric_limits<float>::quiet_NaN();
    for (const ToneCurve curve : curves) {
        for (const float exposure : {-24.0F, 0.0F, 24.0F}) {
            const std::vector<vec3> extremes = {vec3(infinity), vec3(nan), vec3(-infinity), vec3(3e38F)};
            const Bitmap shown = toneMapped(imageOf({4, 1}, extremes), {exposure, curve});
            const Bitmap limits =
                toneMapped(imageOf({4, 1}, {vec3(3e38F), vec3(0.0F), vec3(-3e38F), vec3(3e38F)}), {exposure, curve});
            EXPECT_EQ(shown.data, limits.data) << static_cast<uint32_t>(curve);
            EXPECT_LE(shown.data[3], 1) << static_cast<uint32_t>(curve);
        }
    }
}

}  // namespace
}  // namespace reflet::test::tone_map_image_test
