// Parses backgrounds, and blurs environments for them.
#include "scene/background.h"

#include "base/error.h"
#include "base/text.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

namespace reflet {
namespace {

using Mode = Background::Mode;

constexpr std::array<std::pair<const char*, Mode>, 3> modes{
    {{"environment", Mode::environment}, {"blur", Mode::blur}, {"transparent", Mode::transparent}}};
const std::array<std::pair<const char*, vec3>, 7> colors{{{"black", vec3(0.0F)},
                                                          {"white", vec3(1.0F)},
                                                          {"grey", vec3(0.5F)},
                                                          {"gray", vec3(0.5F)},
                                                          {"red", vec3(1, 0, 0)},
                                                          {"green", vec3(0, 1, 0)},
                                                          {"blue", vec3(0, 0, 1)}}};

std::optional<vec3> parseColor(const std::string& text) {
    vec3 color(0.0F);
    const char* at = text.data();
    const char* end = at + text.size();
    for (int channel = 0; channel < 3; ++channel) {
        const auto [rest, error] = std::from_chars(at, end, color[channel]);
        const bool ends = rest == end;
        if (error != std::errc() || ends != (channel == 2) || (!ends && *rest != ',') ||
            !(color[channel] >= 0.0F && color[channel] <= 1.0F)) {
            return std::nullopt;
        }
        at = rest + (ends ? 0 : 1);
    }
    return color;
}

// Rows of an equirectangular image by their height in the blur's smaller grid.
struct Grid {
    uint32_t width;
    uint32_t height;
    std::vector<vec3> values;

    [[nodiscard]] vec2 heightOf(uint32_t row) const {  // sine and cosine of the angle to +Y
        const float angle = pi * (static_cast<float>(row) + 0.5F) / static_cast<float>(height);
        return {std::sin(angle), std::cos(angle)};
    }
    [[nodiscard]] const vec3& wrapped(int row, int column) const {
        const int w = static_cast<int>(width);
        const int y = std::clamp(row, 0, static_cast<int>(height) - 1);
        return values[static_cast<size_t>(y * w + (column % w + w) % w)];
    }
};

// Means over cells, weighted by solid angle; small images are magnified.
Grid reduced(const FloatImage& image, uint32_t width, uint32_t height) {
    Grid grid{width, height, std::vector<vec3>(size_t(width) * height)};
    for (uint32_t y = 0; y < height; ++y) {
        const uint32_t y0 = y * image.height / height;
        const uint32_t y1 = std::max((y + 1) * image.height / height, y0 + 1);
        for (uint32_t x = 0; x < width; ++x) {
            const uint32_t x0 = x * image.width / width;
            const uint32_t x1 = std::max((x + 1) * image.width / width, x0 + 1);
            glm::dvec3 sum(0.0);
            double total = 0.0;
            for (uint32_t row = y0; row < y1; ++row) {
                const double weight = std::sin(glm::pi<double>() * (row + 0.5) / image.height);
                for (uint32_t column = x0; column < x1; ++column) {
                    const float* texel = &image.data[3 * (size_t(row) * image.width + column)];
                    sum += weight * glm::dvec3(texel[0], texel[1], texel[2]);
                }
                total += weight * (x1 - x0);
            }
            grid.values[size_t(y) * width + x] = sum / total;
        }
    }
    return grid;
}

// Values of one row of `to` gather all rows of `from`; the kernel depends on the difference of the azimuths alone.
void convolveRow(const Grid& from, Grid& to, uint32_t y) {
    constexpr float sigma = glm::radians(12.0F);
    const uint32_t stride = to.width / from.width;
    const vec2 mine = to.heightOf(y);
    std::vector<float> kernel(to.width);
    std::vector<vec3> sums(to.width, vec3(0.0F));
    float total = 0.0F;
    for (uint32_t row = 0; row < from.height; ++row) {
        const vec2 other = from.heightOf(row);
        if (std::cos(std::atan2(mine.x, mine.y) - std::atan2(other.x, other.y)) < std::cos(4.0F * sigma)) {
            continue;
        }
        for (uint32_t i = 0; i < to.width; ++i) {
            // Texel i of `to` against the first of `from`: centres are half texels of their own grids off.
            const float turn =
                (static_cast<float>(i) + 0.5F) / static_cast<float>(to.width) - 0.5F / static_cast<float>(from.width);
            const float cosine = mine.x * other.x * std::cos(2.0F * pi * turn) + mine.y * other.y;
            kernel[i] = other.x * std::exp((cosine - 1.0F) / (sigma * sigma));
        }
        for (uint32_t column = 0; column < from.width; ++column) {
            total += kernel[column * stride];
            const vec3 value = from.values[size_t(row) * from.width + column];
            const uint32_t first = column * stride;
            for (uint32_t i = 0; i < to.width; ++i) {
                sums[i] += kernel[i >= first ? i - first : i + to.width - first] * value;
            }
        }
    }
    // The kernel's sum is the same for every column but for the phase within a stride, which a wide kernel hides.
    for (uint32_t i = 0; i < to.width; ++i) {
        to.values[size_t(y) * to.width + i] = sums[i] / total;
    }
}

}  // namespace

Background parseBackground(const std::string& text) {
    for (const auto& [name, mode] : modes) {
        if (text == name) {
            return {mode, vec3(0.0F)};
        }
    }
    for (const auto& [name, color] : colors) {
        if (text == name) {
            return {Mode::color, color};
        }
    }
    if (const auto color = parseColor(text)) {
        return {Mode::color, *color};
    }
    std::vector<std::string> names;
    std::ranges::transform(modes, std::back_inserter(names), [](const auto& m) { return std::string(m.first); });
    std::ranges::transform(colors, std::back_inserter(names), [](const auto& c) { return std::string(c.first); });
    failUsage("the background must be {}, or R,G,B with display values of 0 to 1, is '{}'{}", fmt::join(names, ", "),
              text, suggestion(text, names));
}

std::string backgroundText(const Background& background) {
    for (const auto& [name, mode] : modes) {
        if (background.mode == mode) {
            return name;
        }
    }
    return fmt::format("{},{},{}", background.color.x, background.color.y, background.color.z);
}

FloatImage blurredImage(const FloatImage& image) {
    const Grid coarse = reduced(image, 64, 32);
    Grid fine{256, 128, std::vector<vec3>(size_t{256} * 128)};
    for (uint32_t y = 0; y < fine.height; ++y) {
        convolveRow(coarse, fine, y);
    }
    constexpr uint32_t width = 1024;
    constexpr uint32_t height = 512;
    FloatImage blurred{width, height, {"R", "G", "B"}, {}};
    blurred.data.reserve(size_t{3} * width * height);
    for (uint32_t y = 0; y < height; ++y) {
        for (uint32_t x = 0; x < width; ++x) {
            const vec2 at = (vec2(x, y) + 0.5F) * 0.25F - 0.5F;
            const glm::ivec2 corner(glm::floor(at));
            const vec2 part = at - vec2(corner);
            const vec3 upper = glm::mix(fine.wrapped(corner.y, corner.x), fine.wrapped(corner.y, corner.x + 1), part.x);
            const vec3 lower =
                glm::mix(fine.wrapped(corner.y + 1, corner.x), fine.wrapped(corner.y + 1, corner.x + 1), part.x);
            const vec3 value = glm::mix(upper, lower, part.y);
            blurred.data.insert(blurred.data.end(), {value.x, value.y, value.z});
        }
    }
    return blurred;
}

bool needsBlurredImage(const View& view) {
    return view.background.mode == Mode::blur && view.environment.image;
}

Environment environmentBehind(const View& view, const std::shared_ptr<const FloatImage>& blurred) {
    if (view.background.needsCoverage()) {
        return {};
    }
    Environment behind = view.environment;
    if (needsBlurredImage(view)) {
        behind.image = blurred;
    }
    return behind;
}

}  // namespace reflet
