// effects/exposure: what automatic exposure makes of made-up pictures, on the device and on the CPU.
#include "effects/exposure/exposure.h"

#include "shader/harness.h"

#include <array>
#include <cmath>
#include <cstring>
#include <limits>

namespace reflet::test::exposure_test {
namespace {

constexpr float grey = 0.22F;

// A picture: radiance, and where there is a surface.
struct Seen {
    uvec2 size{64, 32};
    std::vector<vec3> radiance;
    std::vector<bool> surface;

    Seen(uvec2 s, const vec3& fill, bool isSurface)
        : size(s), radiance(size_t(s.x) * s.y, fill), surface(radiance.size(), isSurface) {}

    /// Fills a rectangle.
    Seen& with(uvec2 from, uvec2 to, const vec3& color, bool isSurface = true) {
        for (uint32_t y = from.y; y < to.y; ++y) {
            for (uint32_t x = from.x; x < to.x; ++x) {
                radiance[size_t(y) * size.x + x] = color;
                surface[size_t(y) * size.x + x] = isSurface;
            }
        }
        return *this;
    }
};

float onHost(const Seen& seen) {
    FloatImage radiance{seen.size.x, seen.size.y, {"R", "G", "B"}, {}};
    FloatImage depth{seen.size.x, seen.size.y, {"Y"}, {}};
    for (size_t i = 0; i < seen.radiance.size(); ++i) {
        const vec3& c = seen.radiance[i];
        radiance.data.insert(radiance.data.end(), {c.x, c.y, c.z});
        depth.data.push_back(seen.surface[i] ? 2.0F : 0.0F);
    }
    return meteredExposure(radiance, depth);
}

class Exposure : public ShaderTest {
protected:
    void SetUp() override {
        ShaderTest::SetUp();
        registerTestShaders();
        history.emplace("exposure");
    }
    void TearDown() override {
        history.reset();
        ShaderTest::TearDown();
    }
    static inline std::optional<gpu::HistoryImage> history;

    /// The frame after those so far.
    static float next(const Seen& seen, float elapsed = 0.0F, float adaptation = 0.5F) {
        std::vector<vec3> depths;
        for (const bool surface : seen.surface) {
            depths.emplace_back(surface ? 0.5F : 0.0F);
        }
        const gpu::Buffer colors = upload(seen.radiance);
        const gpu::Buffer depthColors = upload(depths);
        gpu::Frame& f = frame();
        f.begin();
        const gpu::Image radiance = f.image("radiance", VK_FORMAT_R16G16B16A16_SFLOAT, seen.size);
        const gpu::Image depth = f.image("depth", VK_FORMAT_R16G16B16A16_SFLOAT, seen.size);
        fill(f, colors, radiance);
        fill(f, depthColors, depth);
        const gpu::Readback copy = f.readback(measureExposure(f, *history, radiance, depth, elapsed, adaptation));
        f.submit();
        f.wait();
        return exposureOf(f, copy);
    }
    static float first(const Seen& seen) {
        frame().forget();
        return next(seen);
    }
    static void expectBoth(const Seen& seen, float expected, const char* what) {
        EXPECT_NEAR(first(seen), expected, 0.002F) << what;
        EXPECT_NEAR(onHost(seen), expected, 0.002F) << what;
    }

private:
    static gpu::Buffer upload(const std::vector<vec3>& values) {
        gpu::Buffer buffer(device(), values.size() * sizeof(vec3), VK_BUFFER_USAGE_STORAGE_BUFFER_BIT,
                           gpu::MemoryUse::upload, "colors");
        std::memcpy(buffer.bytes().data(), values.data(), values.size() * sizeof(vec3));
        return buffer;
    }
    static void fill(gpu::Frame& f, const gpu::Buffer& colors, gpu::Image image) {
        f.compute("fill", "tone_map_image_test.comp")
            .read("colors", colors.view())
            .write("radiance", image)
            .dispatch(image.size);
    }
};

TEST_F(Exposure, MakesACardMiddleGreyHoweverBright) {
    for (const float radiance : {0.0001F, 0.18F, 1.0F, 3000.0F}) {
        const Seen card({64, 32}, vec3(radiance), true);
        expectBoth(card, std::log2(grey / radiance), "a card");
    }
}

TEST_F(Exposure, IsThatOfTheObjectUnlessItWouldBurnTheBackground) {
    for (const float background : {0.0F, 0.01F, 0.18F, 1.3F, 60.0F}) {
        Seen seen({64, 32}, vec3(background), false);
        seen.with({20, 10}, {32, 20}, vec3(0.5F));  // 6 % of the picture
        expectBoth(seen, std::log2(std::min(grey / 0.5F, 0.6F / std::max(background, 1e-6F))), "an object");
    }
}

TEST_F(Exposure, OfARoomLetsTheWindowBurn) {
    Seen seen({64, 32}, vec3(0.05F), true);
    seen.with({0, 0}, {12, 20}, vec3(1.0F), false);  // 12 % of the picture
    expectBoth(seen, std::log2(grey / 0.05F), "a room");
}

TEST_F(Exposure, LeavesHighlightsTheirDrawing) {
    Seen seen({64, 32}, vec3(0.22F), true);
    seen.with({0, 0}, {64, 1}, vec3(4.0F));  // 3 % of the picture
    expectBoth(seen, std::log2(3.0F / 4.0F), "highlights");
    seen.with({0, 0}, {64, 1}, vec3(3000.0F));
    expectBoth(seen, -1.0F, "a lamp");
}

TEST_F(Exposure, IsThatOfTheBackgroundWhereThereIsNothingElse) {
    const Seen sky({64, 32}, vec3(2.0F), false);
    expectBoth(sky, std::log2(grey / 2.0F), "a sky");
    Seen dot = sky;
    dot.with({5, 5}, {6, 6}, vec3(0.02F));  // 1 of 2048 pixels has a twentieth of the weight
    const float weight = 100.0F / 2048.0F;
    expectBoth(dot, (1.0F - weight) * std::log2(grey / 2.0F) + weight * std::log2(0.6F / 2.0F), "a dot before the sky");
}

TEST_F(Exposure, LeavesOutBlackAndBurntPixels) {
    Seen seen({64, 32}, vec3(0.25F), true);
    seen.with({0, 0}, {64, 16}, vec3(0.0F));       // half of the object is black
    seen.with({0, 30}, {2, 32}, vec3(50000.0F));   // 0.4 % of the rest emits light
    seen.with({30, 30}, {55, 32}, vec3(0.0001F));  // and as much is nearly black
    expectBoth(seen, std::log2(grey / 0.25F), "a lamp and shadows");
}

TEST_F(Exposure, DoesNotBurnWhatIsLitWhereMostIsInShadow) {
    Seen seen({64, 32}, vec3(0.001F), true);
    seen.with({0, 20}, {64, 32}, vec3(2.0F));  // 37 % of the picture
    expectBoth(seen, std::log2(0.6F / 2.0F), "a lit part");
}

TEST_F(Exposure, IsFiniteForEveryPicture) {
    constexpr float infinity = std::numeric_limits<float>::infinity();
    expectBoth(Seen({64, 32}, vec3(0.0F), true), 0.0F, "black");
    expectBoth(Seen({1, 1}, vec3(0.0F), false), 0.0F, "one black pixel");
    expectBoth(Seen({64, 32}, vec3(std::nanf("")), true), 0.0F, "not a number");
    expectBoth(Seen({64, 32}, vec3(-1.0F), true), 0.0F, "negative");
    expectBoth(Seen({64, 32}, vec3(infinity), true), std::log2(grey) - 16.0F, "infinite");
    expectBoth(Seen({1, 1}, vec3(1.0F), true), std::log2(grey), "one pixel");
}

TEST_F(Exposure, OfTheDeviceIsThatOfTheHostAndAlwaysTheSame) {
    for (const uvec2 size : {uvec2(37, 23), uvec2(300, 200), uvec2(800, 450)}) {  // the last one: every second pixel
        Seen seen(size, vec3(0.0F), true);
        for (size_t i = 0; i < seen.radiance.size(); ++i) {
            const auto at = static_cast<float>(i);
            const float strength = std::exp2(-2.0F + 8.0F * std::sin(at * 0.37F) + 4.0F * std::sin(at * 0.0013F));
            seen.radiance[i] = strength * vec3(1.0F, 0.5F + 0.5F * std::sin(at), 0.2F);
            seen.surface[i] = i % 7 != 0;
        }
        const float exposure = first(seen);
        EXPECT_NEAR(exposure, onHost(seen), 0.002F) << size.x;
        EXPECT_EQ(exposure, first(seen)) << size.x;
    }
}

TEST_F(Exposure, IsTheMeanOfTheLastFramesByTheirAge) {
    const Seen dark({64, 32}, vec3(grey / 16.0F), true);  // +4 stops
    const Seen bright({64, 32}, vec3(grey), true);        // 0 stops
    constexpr float elapsed = 0.25F;
    EXPECT_NEAR(next(dark), 4.0F, 0.002F);
    float darkWeight = 1.0F;
    float weights = 1.0F;
    for (uint32_t i = 1; i < exposureFrames; ++i) {
        darkWeight *= std::exp(-elapsed / 0.5F);
        weights = 1.0F + weights * std::exp(-elapsed / 0.5F);
        EXPECT_NEAR(next(bright, elapsed), 4.0F * darkWeight / weights, 0.003F) << i;
    }
    EXPECT_NEAR(next(bright, elapsed), first(bright), 1e-5F) << "the dark frame is forgotten";
}

TEST_F(Exposure, OfTwiceAsManyFramesPerSecondAdaptsInTheSameTime) {
    const Seen dark({64, 32}, vec3(grey / 16.0F), true);
    const Seen bright({64, 32}, vec3(grey), true);
    std::array<float, 2> after{};
    for (uint32_t rate = 1; rate <= 2; ++rate) {
        frame().forget();
        for (uint32_t i = 0; i < 7 * rate; ++i) {
            next(dark, 0.05F / static_cast<float>(rate));
        }
        for (uint32_t i = 0; i < rate; ++i) {
            after[rate - 1] = next(bright, 0.05F / static_cast<float>(rate));
        }
    }
    EXPECT_GT(after[0], 2.0F);
    EXPECT_NEAR(after[0], after[1], 0.2F);
}

TEST_F(Exposure, WithoutAdaptationIsTheFramesOwn) {
    next(Seen({64, 32}, vec3(0.01F), true));
    const Seen bright({64, 32}, vec3(grey), true);
    EXPECT_EQ(next(bright, 0.0F, 0.0F), first(bright));
}

}  // namespace
}  // namespace reflet::test::exposure_test
