// Procedural 8-bit images: rectangles, discs, letters, grain, and normal maps from heights.
#pragma once

#include "scene/scene.h"

#include <functional>
#include <string>
#include <string_view>
#include <utility>

namespace reflet::builtin {

/// sRGB colour as 0xRRGGBB.
using Hex = uint32_t;

/// The linear colour of a hex colour, for material factors.
vec3 linear(Hex color);

/// Linear interpolation of two colours in sRGB.
Hex mixed(Hex a, Hex b, float t);

/// Pixel rectangle from x, y; right and lower edge excluded.
struct PixelBox {
    int x = 0;
    int y = 0;
    int width = 0;
    int height = 0;
};

class Canvas {
public:
    Canvas(std::string name, uint32_t width, uint32_t height, Hex fill);

    [[nodiscard]] int width() const { return static_cast<int>(image.width); }
    [[nodiscard]] int height() const { return static_cast<int>(image.height); }

    void set(int x, int y, Hex color, uint8_t alpha = 255);
    void rectangle(const PixelBox& area, Hex color, uint8_t alpha = 255);
    void disc(const vec2& center, float radius, Hex color, uint8_t alpha = 255);

    /// Letters A to L and digits in a 5x7 bitmap font, `pixel` pixels per dot, centred on a point.
    void text(std::string_view letters, const vec2& center, int pixel, Hex color);

    /// Adds noise of at most `strength` (of 255) to every pixel.
    void grain(float strength, uint32_t seed);

    /// Sets every pixel; uv is the pixel's centre.
    void paint(const std::function<Hex(const vec2& uv)>& color);

    TextureImage finish() { return std::move(image); }

private:
    TextureImage image;
};

/// Tangent-space normal map of a tileable height field in metres over the unit square, which is `metres` wide.
TextureImage normalMap(std::string name, uint32_t size, float metres,
                       const std::function<float(const vec2& uv)>& height);

}  // namespace reflet::builtin
