// Tabulates the colour map.
#include "compare/heat_map.h"

#include "base/color.h"
#include "base/error.h"
#include "compare/color.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace reflet {

namespace {

using Color = std::array<uint8_t, 3>;

Color colorOf(float t) {
    const float lightness = 4.0F + 92.0F * t;
    const float chroma = 66.0F * std::sin(std::numbers::pi_v<float> * t);
    const float hue = glm::radians(300.0F + 155.0F * t);
    const vec3 linear = labToLinear({lightness, chroma * std::cos(hue), chroma * std::sin(hue)});
    Color color{};
    for (int c = 0; c < 3; ++c) {
        color[static_cast<size_t>(c)] = static_cast<uint8_t>(std::lround(255.0F * encodeSrgb(linear[c])));
    }
    return color;
}

}  // namespace

Bitmap heatMap(const FloatImage& error) {
    REFLET_CHECK(error.channels.size() == 1, "{} channels", error.channels.size());
    constexpr size_t last = 1023;  // finer than 8 bits can show
    std::array<Color, last + 1> colors{};
    for (size_t i = 0; i <= last; ++i) {
        colors[i] = colorOf(static_cast<float>(i) / last);
    }
    Bitmap map{error.width, error.height, 3, {}};
    map.data.reserve(error.data.size() * 3);
    for (const float value : error.data) {
        const Color& color = colors[static_cast<size_t>(std::lround(std::clamp(value, 0.0F, 1.0F) * last))];
        map.data.insert(map.data.end(), color.begin(), color.end());
    }
    return map;
}

}  // namespace reflet
