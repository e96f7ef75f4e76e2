// The depth pyramid of random depth, at even and odd sizes, against brute force over the pixels of each cell.
#include "effects/pyramid/pyramid.h"
#include "effects/levels.h"

#include "device/frame.h"
#include "device/upload.h"
#include "pass/test_shaders.h"
#include "support/device_fixture.h"

#include <algorithm>
#include <cstring>
#include <random>

namespace reflet::test::pyramid_test {
namespace {

constexpr uvec2 sizes[] = {{1, 1}, {2, 2}, {3, 5}, {17, 9}, {64, 64}, {319, 181}};

/// Depth with sky (0), and of the second layer with pixels that have none (0).
struct Layers {
    uvec2 size;
    std::vector<float> front;
    std::vector<float> back;
};

Layers randomLayers(uvec2 size) {
    std::mt19937 random(11);
    std::uniform_real_distribution<float> unit(0.0F, 1.0F);
    Layers layers{size, {}, {}};
    for (uint32_t y = 0; y < size.y; ++y) {
        for (uint32_t x = 0; x < size.x; ++x) {
            const bool sky = unit(random) < 0.3F || (x / 8 + y / 8) % 5 == 0;  // pixels, and whole small cells
            const float front = 1e-6F + 0.9F * unit(random);
            const bool closed = unit(random) < 0.5F;
            layers.front.push_back(sky ? 0.0F : front);
            layers.back.push_back(!sky && closed ? front * (0.1F + 0.9F * unit(random)) : 0.0F);
        }
    }
    return layers;
}

uvec2 cellsOf(uvec2 size, uint32_t level) {
    const uint32_t side = 1U << level;
    return {(size.x + side - 1) / side, (size.y + side - 1) / side};
}

vec2 extremesOf(const Layers& layers, bool second, uvec2 cell, uint32_t level) {
    if (level == 0) {
        const size_t i = size_t(cell.y) * layers.size.x + cell.x;
        return {layers.front[i], second ? layers.back[i] : 0.0F};
    }
    vec2 extremes(0.0F, 1.0F);
    bool sky = false;
    for (uint32_t y = cell.y << level; y < std::min((cell.y + 1) << level, layers.size.y); ++y) {
        for (uint32_t x = cell.x << level; x < std::min((cell.x + 1) << level, layers.size.x); ++x) {
            const size_t i = size_t(y) * layers.size.x + x;
            if (layers.front[i] > 0.0F) {
                extremes.x = std::max(extremes.x, layers.front[i]);
                extremes.y = std::min(extremes.y, second && layers.back[i] > 0.0F ? layers.back[i] : layers.front[i]);
            } else {
                sky = true;
            }
        }
    }
    return {extremes.x, sky ? -extremes.y : extremes.y};
}

class Pyramid : public DeviceTest {
protected:
    static gpu::Image fill(gpu::Frame& f, uvec2 size, const gpu::Buffer& values) {
        const gpu::Image image = f.image("depth", VK_FORMAT_R32_SFLOAT, size);
        f.compute("fill", "fill_image_test.comp").read("inputs", values.view()).write("image", image).dispatch(size);
        return image;
    }

    static gpu::Buffer upload(const std::vector<float>& values) {
        return gpu::uploadBuffer(device(), std::as_bytes(std::span(values)), VK_BUFFER_USAGE_STORAGE_BUFFER_BIT,
                                 "values");
    }

    /// All levels, one after another, each by rows.
    static std::vector<vec2> build(const Layers& layers, bool second) {
        addPassTestShaders(device());
        const gpu::Buffer front = upload(layers.front);
        const gpu::Buffer back = upload(layers.back);
        gpu::Frame& f = frame();
        f.begin();
        const gpu::Image depth = fill(f, layers.size, front);
        const gpu::Image backDepth = second ? fill(f, layers.size, back) : gpu::Image{};
        const gpu::Image pyramid = makePyramid(f, depth, backDepth);
        const gpu::Readback readback = f.readback(pyramid);
        f.submit();
        f.wait();
        std::vector<vec2> image(size_t(pyramid.size.x) * pyramid.size.y);
        std::memcpy(image.data(), f.bytes(readback).data(), image.size() * sizeof(vec2));
        std::vector<vec2> cells;
        for (uint32_t level = 0; level < pyramidLevels; ++level) {
            for (uint32_t y = 0; y < cellsOf(layers.size, level).y; ++y) {
                const uvec2 at = level == 0 ? uvec2(0, y) : uvec2(layers.size.x, levelRow(layers.size, level) + y);
                const auto first = image.begin() + static_cast<std::ptrdiff_t>(size_t(at.y) * pyramid.size.x + at.x);
                cells.insert(cells.end(), first, first + cellsOf(layers.size, level).x);
            }
        }
        return cells;
    }

    static void expectExtremes(const Layers& layers, bool second) {
        const auto cells = build(layers, second);
        size_t i = 0;
        for (uint32_t level = 0; level < pyramidLevels; ++level) {
            for (uint32_t y = 0; y < cellsOf(layers.size, level).y; ++y) {
                for (uint32_t x = 0; x < cellsOf(layers.size, level).x; ++x, ++i) {
                    ASSERT_EQ(cells[i], extremesOf(layers, second, {x, y}, level))
                        << layers.size.x << " x " << layers.size.y << ", level " << level << ": " << x << ' ' << y;
                }
            }
        }
        EXPECT_EQ(i, cells.size());
    }
};

TEST_F(Pyramid, holdsTheNearestAndTheFarthestOfEveryCellAndWhetherItShowsTheSky) {
    for (const uvec2 size : sizes) {
        expectExtremes(randomLayers(size), false);
    }
}

TEST_F(Pyramid, holdsTheFarthestOfTheBackFacesWhereThereAreAny) {
    for (const uvec2 size : sizes) {
        expectExtremes(randomLayers(size), true);
    }
}

TEST_F(Pyramid, ofNothingButSkyCanBeHitNowhere) {
    const std::vector<float> nothing(594, 0.0F);
    const Layers sky{{33, 18}, nothing, nothing};
    const std::vector<vec2> cells = build(sky, false);
    for (size_t i = 0; i < cells.size(); ++i) {
        ASSERT_EQ(cells[i], vec2(0.0F, i < nothing.size() ? 0.0F : -1.0F)) << i;
    }
}

}  // namespace
}  // namespace reflet::test::pyramid_test
