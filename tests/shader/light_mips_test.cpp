// effects/light_mips: levels against their definition, and interpolated look-ups.
#include "shader/light_mips_test.h"

#include "effects/levels.h"
#include "effects/light_mips/light_mips.h"
#include "shader/harness.h"

#include <glm/gtc/packing.hpp>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <functional>

namespace reflet::test::light_mips_test {
namespace {

using LightAt = std::function<vec3(uint32_t x, uint32_t y)>;

class LightMips : public ShaderTest {
protected:
    struct Images {
        gpu::KeptImage lightStore{"light"};
        gpu::KeptImage mipsStore{"mips"};
        gpu::Image light{};
        gpu::Image mips{};
        gpu::Readback copy{};  ///< of the mips
    };

    static Images make(uvec2 size, const LightAt& lightAt) {
        std::vector<vec3> colors;
        for (uint32_t i = 0; i < size.x * size.y; ++i) {
            colors.push_back(lightAt(i % size.x, i / size.x));
        }
        const gpu::Buffer upload(device(), colors.size() * sizeof(vec3), VK_BUFFER_USAGE_STORAGE_BUFFER_BIT,
                                 gpu::MemoryUse::upload, "colors");
        std::memcpy(upload.bytes().data(), colors.data(), colors.size() * sizeof(vec3));
        registerTestShaders();
        gpu::Frame& f = frame();
        f.begin();
        Images images;
        images.light = images.lightStore.storage(f, VK_FORMAT_R16G16B16A16_SFLOAT, size);
        f.compute("fill", "tone_map_image_test.comp")
            .read("colors", upload.view())
            .write("radiance", images.light)
            .dispatch(size);
        const gpu::Image made = makeLightMips(f, images.light);
        images.mips = images.mipsStore.storage(f, made.format, made.size);  // outlives the frame
        f.copy(made, images.mips);
        images.copy = f.readback(images.mips);
        f.submit();
        f.wait();
        return images;
    }

    static std::vector<vec3> lookUp(const Images& images, const std::vector<LightLookup>& lookups) {
        return mapOnDevice<vec3>("light_mips_test.comp", lookups, NoParams{}, [&](gpu::ComputePass& pass) {
            pass.read("light", images.light).read("mips", images.mips);
        });
    }

    static vec3 texel(std::span<const std::byte> bytes, size_t index) {
        uint64_t half = 0;
        std::memcpy(&half, bytes.data() + index * sizeof(half), sizeof(half));
        return glm::unpackHalf4x16(half);
    }
};

/// Mean of the pixels under a cell.
glm::dvec3 meanOfCell(uvec2 size, const LightAt& lightAt, uint32_t level, uvec2 cell) {
    const uvec2 first = cell << level;
    const uvec2 end = glm::min((cell + 1U) << level, size);
    glm::dvec3 sum(0.0);
    for (uint32_t y = first.y; y < end.y; ++y) {
        for (uint32_t x = first.x; x < end.x; ++x) {
            sum += glm::dvec3(lightAt(x, y));
        }
    }
    return sum / double((end.x - first.x) * (end.y - first.y));
}

/// Integers, which half floats hold exactly; neighbours differ strongly.
vec3 uneven(uint32_t x, uint32_t y) {
    return {(x * 37 + y * 101 + x * y * 13) % 512, (x * 71 + y * y * 7) % 1024, x + y == 40 ? 2000 : 0};
}

TEST_F(LightMips, everyCellIsTheMeanOfItsPixelsAtOddSizesToo) {
    for (const uvec2 size : {uvec2(64, 32), uvec2(75, 53), uvec2(1, 37), uvec2(13, 1), uvec2(3, 2), uvec2(129, 65)}) {
        const Images images = make(size, uneven);
        const auto bytes = frame().bytes(images.copy);
        uint32_t level = 1;
        for (; levelRow(size, level + 1) <= images.mips.size.y; ++level) {
            const uint32_t row = levelRow(size, level);
            const uvec2 cells = levelSize(size, level);
            for (uint32_t i = 0; i < cells.x * cells.y; ++i) {
                const uvec2 cell(i % cells.x, i / cells.x);
                const vec3 got = texel(bytes, (row + cell.y) * images.mips.size.x + cell.x);
                const glm::dvec3 mean = meanOfCell(size, uneven, level, cell);
                for (int c = 0; c < 3; ++c) {
                    // Every level rounds to the 11 bits of a half float.
                    ASSERT_NEAR(got[c], mean[c], mean[c] * level / 2048.0 + 1e-6)
                        << size.x << "x" << size.y << ", level " << level << ", cell " << cell.x << ", " << cell.y;
                }
            }
        }
        EXPECT_EQ(levelSize(size, level - 1), uvec2(1)) << "the last level is one cell";
    }
}

TEST_F(LightMips, theBrightestLightStaysFinite) {
    const auto brightest = [](uint32_t, uint32_t) { return vec3(65504.0F); };
    const Images images = make({21, 17}, brightest);
    for (const vec3& light : lookUp(images, {{{10, 8}, 1.0F}, {{0, 17}, 6.0F}, {{10, 8}, 1e9F}})) {
        EXPECT_EQ(light, vec3(65504.0F));
    }
}

TEST_F(LightMips, aConstantImageIsConstantEverywhereAtEveryWidth) {
    for (const uvec2 size : {uvec2(1, 1), uvec2(5, 1), uvec2(75, 53)}) {
        const vec3 constant(0.25F, 7.0F, 1023.0F);
        const Images images = make(size, [&](uint32_t, uint32_t) { return constant; });
        std::vector<LightLookup> lookups;
        for (uint32_t i = 0; i < 4000; ++i) {
            const vec2 part = vec2(uvec2(i % 50, i / 50)) / vec2(49.0F, 79.0F);
            lookups.push_back({part * (vec2(size) + 6.0F) - 3.0F, std::exp2(static_cast<float>(i % 97) / 10.0F)});
        }
        for (const vec3& light : lookUp(images, lookups)) {
            ASSERT_LT(glm::length((light - constant) / constant), 1e-3F);
        }
    }
}

TEST_F(LightMips, aRampIsTheRampAtEveryWidthAwayFromTheEdges) {
    constexpr uvec2 size(203, 149);
    const auto ramp = [](uint32_t x, uint32_t y) { return vec3(x + 0.5F, y + 0.5F, 300.0F - x); };
    const Images images = make(size, ramp);
    std::vector<LightLookup> lookups;
    for (uint32_t i = 0; i < 5000; ++i) {
        const float width = std::exp2(4.0F * static_cast<float>(i % 101) / 100.0F);
        const float margin = 40.0F;  // more than two cells of 16: those at the edges, and half of their neighbours
        const vec2 part = vec2(uvec2(i % 71, i / 71)) / 70.0F;
        lookups.push_back({margin + part * (vec2(size) - 2.0F * margin), width});
    }
    const auto found = lookUp(images, lookups);
    for (size_t i = 0; i < lookups.size(); ++i) {
        ASSERT_NEAR(found[i].x, lookups[i].at.x, 1e-3F) << lookups[i].width;
        ASSERT_NEAR(found[i].y, lookups[i].at.y, 1e-3F) << lookups[i].width;
        ASSERT_NEAR(found[i].z, 300.5F - lookups[i].at.x, 1e-3F) << lookups[i].width;
    }
}

TEST_F(LightMips, blurringSpreadsALightOverTheWidthAndLosesNoneOfIt) {
    constexpr uvec2 size(128, 128);
    for (const uint32_t place : {48U, 61U, 70U}) {
        const auto one = [&](uint32_t x, uint32_t y) { return vec3(x == place && y == 64 ? 4096.0F : 0.0F); };
        const Images images = make(size, one);
        for (const float width : {1.0F, 2.0F, 3.0F, 8.0F, 13.0F}) {
            std::vector<LightLookup> lookups;
            for (uint32_t i = 0; i < size.x * size.y; ++i) {
                lookups.push_back({vec2(i % size.x, i / size.x) + 0.5F, width});
            }
            const auto found = lookUp(images, lookups);
            double sum = 0.0;
            double farthest = 0.0;
            for (size_t i = 0; i < found.size(); ++i) {
                sum += found[i].x;
                const vec2 off = glm::abs(lookups[i].at - vec2(place + 0.5F, 64.5F));
                farthest = found[i].x > 0.0F ? std::max<double>(farthest, std::max(off.x, off.y)) : farthest;
            }
            EXPECT_NEAR(sum, 4096.0, 1.0) << width;
            // From the light to the far side of its cell, and on to the centre of the next cell of the coarser level.
            EXPECT_LE(farthest, 1.5 * std::exp2(std::ceil(std::log2(width)))) << width;
            EXPECT_GE(farthest, width < 2.0F ? 0.0 : 0.5 * width) << width;
        }
    }
}

}  // namespace
}  // namespace reflet::test::light_mips_test
