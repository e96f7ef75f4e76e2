// Draws contact sheets.
#include "job/contact_sheet.h"

#include "base/color.h"
#include "base/error.h"
#include "job/label_font.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace reflet {

namespace {

constexpr uint32_t largestSide = 16384;  // pixels
constexpr float letterHeight = 15.0F;    // pixels of a line
constexpr uint8_t letterGrey = 220;
constexpr uint32_t aboveName = 5;  // pixels
constexpr double sheetAspect = 16.0 / 9.0;
constexpr float largestByte = 255.0F;

uint8_t toByte(float value) {
    return static_cast<uint8_t>(std::lround(std::clamp(value, 0.0F, 1.0F) * largestByte));
}

const std::array<float, 256>& linearOfByte() {
    static const std::array<float, 256> table = [] {
        std::array<float, 256> values{};
        for (size_t i = 0; i < values.size(); ++i) {
            values.at(i) = decodeSrgb(static_cast<float>(i) / largestByte);
        }
        return values;
    }();
    return table;
}

// The mean over [x0, x1) x [y0, y1) in pixels: light premultiplied by alpha, and alpha.
vec4 meanOf(const Bitmap& bitmap, double x0, double x1, double y0, double y1) {
    vec4 sum(0.0F);
    float weights = 0.0F;
    for (auto y = static_cast<uint32_t>(y0); y < bitmap.height && y < y1; ++y) {
        const double high = std::min<double>(y + 1, y1) - std::max<double>(y, y0);
        for (auto x = static_cast<uint32_t>(x0); x < bitmap.width && x < x1; ++x) {
            const auto weight = static_cast<float>(high * (std::min<double>(x + 1, x1) - std::max<double>(x, x0)));
            const uint8_t* p = &bitmap.data[(size_t(y) * bitmap.width + x) * bitmap.channels];
            const float alpha = bitmap.channels == 4 ? static_cast<float>(p[3]) / largestByte : 1.0F;
            const vec3 light(linearOfByte()[p[0]], linearOfByte()[p[1]], linearOfByte()[p[2]]);
            sum += weight * vec4(alpha * light, alpha);
            weights += weight;
        }
    }
    return sum / std::max(weights, 1e-12F);
}

void paste(Bitmap& sheet, const Bitmap& picture, uvec2 at, uint8_t grey) {
    for (uint32_t y = 0; y < picture.height; ++y) {
        for (uint32_t x = 0; x < picture.width; ++x) {
            const uint8_t* from = &picture.data[(size_t(y) * picture.width + x) * picture.channels];
            uint8_t* to = &sheet.data[(size_t(at.y + y) * sheet.width + at.x + x) * 3];
            const int alpha = picture.channels == 4 ? from[3] : 255;
            for (size_t c = 0; c < 3; ++c) {
                to[c] = static_cast<uint8_t>((from[c] * alpha + grey * (255 - alpha) + 127) / 255);
            }
        }
    }
}

}  // namespace

Bitmap fitted(const Bitmap& bitmap, uvec2 most) {
    const double scale = std::min(double(most.x) / bitmap.width, double(most.y) / bitmap.height);
    if (scale >= 1.0) {
        return bitmap;
    }
    Bitmap result{std::max(static_cast<uint32_t>(std::lround(scale * bitmap.width)), 1U),
                  std::max(static_cast<uint32_t>(std::lround(scale * bitmap.height)), 1U),
                  bitmap.channels,
                  {}};
    const double across = double(bitmap.width) / result.width;
    const double down = double(bitmap.height) / result.height;
    for (uint32_t y = 0; y < result.height; ++y) {
        for (uint32_t x = 0; x < result.width; ++x) {
            const vec4 mean = meanOf(bitmap, x * across, (x + 1) * across, y * down, (y + 1) * down);
            for (int c = 0; c < 3; ++c) {
                result.data.push_back(toByte(encodeSrgb(mean[c] / std::max(mean.w, 1e-6F))));
            }
            if (bitmap.channels == 4) {
                result.data.push_back(toByte(mean.w));
            }
        }
    }
    return result;
}

uint32_t sheetColumns(const SheetOptions& options, size_t count) {
    if (options.columns > 0) {
        return options.columns;
    }
    const double cells = double(count) * options.cell.y / options.cell.x * sheetAspect;
    return static_cast<uint32_t>(std::clamp(std::lround(std::sqrt(cells)), 1L, static_cast<long>(count)));
}

Bitmap contactSheet(std::span<const SheetPicture> pictures, const SheetOptions& options) {
    const LabelFont font(letterHeight);
    const uint32_t columns = sheetColumns(options, pictures.size());
    const auto rows = static_cast<uint32_t>((pictures.size() + columns - 1) / columns);
    const uint32_t nameHeight = font.isLoaded() ? aboveName + font.lineHeight() : 0;
    const uvec2 step = options.cell + uvec2(options.gap, options.gap + nameHeight);
    const glm::u64vec2 size = glm::u64vec2(step) * glm::u64vec2(columns, rows) + uint64_t(options.gap);
    if (size.x > largestSide || size.y > largestSide) {
        failUsage(
            "the sheet would have {}x{} pixels; it can have {} a side: choose a smaller --cell, or other --columns",
            size.x, size.y, largestSide);
    }
    Bitmap sheet{static_cast<uint32_t>(size.x), static_cast<uint32_t>(size.y), 3, {}};
    sheet.data.assign(size_t(size.x) * size.y * 3, options.grey);
    for (size_t i = 0; i < pictures.size(); ++i) {
        const uvec2 place(i % columns, i / columns);
        const uvec2 cell = uvec2(options.gap) + place * step;
        const Bitmap& bitmap = pictures[i].bitmap;
        REFLET_CHECK(bitmap.width <= options.cell.x && bitmap.height <= options.cell.y, "{}", pictures[i].name);
        paste(sheet, bitmap, cell + (options.cell - uvec2(bitmap.width, bitmap.height)) / 2U, options.grey);
        const auto width = static_cast<float>(options.cell.x);
        const std::string name = font.shortened(pictures[i].name, width);
        const float left = static_cast<float>(cell.x) + 0.5F * (width - font.widthOf(name));
        font.draw(sheet, name, left, cell.y + options.cell.y + aboveName, letterGrey);
    }
    return sheet;
}

}  // namespace reflet
