// Rasterization for canvas.h, without anti-aliasing: mips smooth the edges.
#include "scene/builtin/canvas.h"

#include "base/color.h"
#include "base/error.h"
#include "scene/builtin/noise.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

namespace reflet::builtin {
namespace {

using Glyph = std::array<uint8_t, 7>;  // one byte per row, bit 4 is the leftmost dot

constexpr std::array<Glyph, 10> digits{{{0x0E, 0x11, 0x13, 0x15, 0x19, 0x11, 0x0E},
                                        {0x04, 0x0C, 0x14, 0x04, 0x04, 0x04, 0x1F},
                                        {0x0E, 0x11, 0x01, 0x06, 0x08, 0x10, 0x1F},
                                        {0x1E, 0x01, 0x01, 0x0E, 0x01, 0x01, 0x1E},
                                        {0x02, 0x06, 0x0A, 0x12, 0x1F, 0x02, 0x02},
                                        {0x1F, 0x10, 0x1E, 0x01, 0x01, 0x11, 0x0E},
                                        {0x06, 0x08, 0x10, 0x1E, 0x11, 0x11, 0x0E},
                                        {0x1F, 0x01, 0x02, 0x04, 0x08, 0x08, 0x08},
                                        {0x0E, 0x11, 0x11, 0x0E, 0x11, 0x11, 0x0E},
                                        {0x0E, 0x11, 0x11, 0x0F, 0x01, 0x02, 0x0C}}};

constexpr std::array<Glyph, 12> capitals{{{0x0E, 0x11, 0x11, 0x1F, 0x11, 0x11, 0x11},
                                          {0x1E, 0x11, 0x11, 0x1E, 0x11, 0x11, 0x1E},
                                          {0x0F, 0x10, 0x10, 0x10, 0x10, 0x10, 0x0F},
                                          {0x1C, 0x12, 0x11, 0x11, 0x11, 0x12, 0x1C},
                                          {0x1F, 0x10, 0x10, 0x1E, 0x10, 0x10, 0x1F},
                                          {0x1F, 0x10, 0x10, 0x1E, 0x10, 0x10, 0x10},
                                          {0x0F, 0x10, 0x10, 0x13, 0x11, 0x11, 0x0F},
                                          {0x11, 0x11, 0x11, 0x1F, 0x11, 0x11, 0x11},
                                          {0x1F, 0x04, 0x04, 0x04, 0x04, 0x04, 0x1F},
                                          {0x0F, 0x02, 0x02, 0x02, 0x02, 0x12, 0x0C},
                                          {0x11, 0x12, 0x14, 0x18, 0x14, 0x12, 0x11},
                                          {0x10, 0x10, 0x10, 0x10, 0x10, 0x10, 0x1F}}};

const Glyph& glyph(char letter) {
    if (letter >= '0' && letter <= '9') {
        return digits[static_cast<size_t>(letter - '0')];
    }
    REFLET_CHECK(letter >= 'A' && letter <= 'L', "no raster for '{}'", letter);
    return capitals[static_cast<size_t>(letter - 'A')];
}

uint8_t channel(Hex color, unsigned index) {
    return static_cast<uint8_t>(color >> (16U - 8U * index));
}

uint8_t toByte(float value) {
    return static_cast<uint8_t>(std::lround(std::clamp(value, 0.0F, 255.0F)));
}

}  // namespace

vec3 linear(Hex color) {
    vec3 result;
    for (unsigned i = 0; i < 3; ++i) {
        result[static_cast<int>(i)] = static_cast<float>(decodeSrgb(channel(color, i) / 255.0));
    }
    return result;
}

Hex mixed(Hex a, Hex b, float t) {
    Hex result = 0;
    for (unsigned i = 0; i < 3; ++i) {
        const float from = channel(a, i);
        const float to = channel(b, i);
        result = (result << 8U) | toByte(from + (to - from) * std::clamp(t, 0.0F, 1.0F));
    }
    return result;
}

Canvas::Canvas(std::string name, uint32_t width, uint32_t height, Hex fill) {
    image.name = std::move(name);
    image.width = width;
    image.height = height;
    image.rgba.resize(size_t{4} * width * height);
    rectangle({0, 0, static_cast<int>(width), static_cast<int>(height)}, fill);
}

void Canvas::set(int x, int y, Hex color, uint8_t alpha) {
    if (x < 0 || y < 0 || x >= width() || y >= height()) {
        return;
    }
    uint8_t* pixel = &image.rgba[4 * (static_cast<size_t>(y) * image.width + static_cast<size_t>(x))];
    for (unsigned i = 0; i < 3; ++i) {
        pixel[i] = channel(color, i);
    }
    pixel[3] = alpha;
}

void Canvas::rectangle(const PixelBox& area, Hex color, uint8_t alpha) {
    for (int y = area.y; y < area.y + area.height; ++y) {
        for (int x = area.x; x < area.x + area.width; ++x) {
            set(x, y, color, alpha);
        }
    }
}

void Canvas::disc(const vec2& center, float radius, Hex color, uint8_t alpha) {
    const glm::ivec2 first(glm::floor(center - radius));
    const glm::ivec2 last(glm::ceil(center + radius));
    for (int y = first.y; y <= last.y; ++y) {
        for (int x = first.x; x <= last.x; ++x) {
            const vec2 d = vec2(x, y) + 0.5F - center;
            if (glm::dot(d, d) <= radius * radius) {
                set(x, y, color, alpha);
            }
        }
    }
}

void Canvas::text(std::string_view letters, const vec2& center, int pixel, Hex color) {
    const int columns = static_cast<int>(letters.size()) * 6 - 1;
    int left = static_cast<int>(center.x) - columns * pixel / 2;
    const int top = static_cast<int>(center.y) - 7 * pixel / 2;
    for (const char letter : letters) {
        const Glyph& rows = glyph(letter);
        for (int y = 0; y < 7; ++y) {
            for (int x = 0; x < 5; ++x) {
                if (((rows[static_cast<size_t>(y)] >> (4 - x)) & 1) != 0) {
                    rectangle({left + x * pixel, top + y * pixel, pixel, pixel}, color);
                }
            }
        }
        left += 6 * pixel;
    }
}

void Canvas::grain(float strength, uint32_t seed) {
    for (int y = 0; y < height(); ++y) {
        for (int x = 0; x < width(); ++x) {
            uint8_t* pixel = &image.rgba[4 * (static_cast<size_t>(y) * image.width + static_cast<size_t>(x))];
            const float change = strength * (2.0F * hash01(x, y, 0, seed) - 1.0F);
            for (unsigned i = 0; i < 3; ++i) {
                pixel[i] = toByte(static_cast<float>(pixel[i]) + change);
            }
        }
    }
}

void Canvas::paint(const std::function<Hex(const vec2& uv)>& color) {
    for (int y = 0; y < height(); ++y) {
        for (int x = 0; x < width(); ++x) {
            set(x, y, color((vec2(x, y) + 0.5F) / vec2(width(), height())));
        }
    }
}

TextureImage normalMap(std::string name, uint32_t size, float metres,
                       const std::function<float(const vec2& uv)>& height) {
    std::vector<float> heights(size_t{size} * size);
    const auto at = [&](uint32_t x, uint32_t y) -> float& { return heights[size_t{y % size} * size + x % size]; };
    for (uint32_t y = 0; y < size; ++y) {
        for (uint32_t x = 0; x < size; ++x) {
            at(x, y) = height((vec2(x, y) + 0.5F) / static_cast<float>(size));
        }
    }
    const float twoPixels = 2.0F * metres / static_cast<float>(size);
    TextureImage image{std::move(name), size, size, std::vector<uint8_t>(heights.size() * 4, 255)};
    for (uint32_t y = 0; y < size; ++y) {
        for (uint32_t x = 0; x < size; ++x) {
            const float toRight = at(x + 1, y) - at(x + size - 1, y);
            const float toTop = at(x, y + size - 1) - at(x, y + 1);  // green points up in the image
            const vec3 n = glm::normalize(vec3(-toRight, -toTop, twoPixels));
            for (int i = 0; i < 3; ++i) {
                image.rgba[4 * (size_t{y} * size + x) + static_cast<size_t>(i)] = toByte(127.5F * n[i] + 127.5F);
            }
        }
    }
    return image;
}

}  // namespace reflet::builtin
