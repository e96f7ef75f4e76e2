// Draws text by stb_truetype.
#include "job/label_font.h"

#include "base/file.h"

#include <stb_truetype.h>

#include <array>
#include <cmath>
#include <filesystem>
#include <vector>

namespace reflet {

namespace {

constexpr std::array fontFiles{"/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf", "/usr/share/fonts/TTF/DejaVuSans.ttf",
                               "/usr/share/fonts/dejavu-sans-fonts/DejaVuSans.ttf"};

stbtt_fontinfo infoOf(const std::string& file) {
    stbtt_fontinfo info{};
    stbtt_InitFont(&info, reinterpret_cast<const unsigned char*>(file.data()), 0);
    return info;
}

// Code points of UTF-8; what is invalid becomes U+FFFD.
std::vector<int> codePoints(std::string_view text) {
    constexpr int invalid = 0xFFFD;
    std::vector<int> points;
    for (size_t i = 0; i < text.size();) {
        const auto first = static_cast<unsigned char>(text[i++]);
        const int more = first < 0x80 ? 0 : first >= 0xF0 ? 3 : first >= 0xE0 ? 2 : first >= 0xC0 ? 1 : -1;
        int point = more < 0 ? invalid : more == 0 ? first : first & (0x3F >> more);
        for (int k = 0; k < more; ++k, ++i) {
            if (i >= text.size() || (static_cast<unsigned char>(text[i]) & 0xC0U) != 0x80U) {
                point = invalid;
                break;
            }
            point = point << 6 | (static_cast<unsigned char>(text[i]) & 0x3F);
        }
        points.push_back(point);
    }
    return points;
}

// The start of the character before byte `at`.
size_t characterBefore(std::string_view text, size_t at) {
    while (at > 0 && (static_cast<unsigned char>(text[--at]) & 0xC0U) == 0x80U) {
    }
    return at;
}

size_t characterAfter(std::string_view text, size_t at) {
    while (at < text.size() && ++at < text.size() && (static_cast<unsigned char>(text[at]) & 0xC0U) == 0x80U) {
    }
    return at;
}

void blend(uint8_t& value, uint8_t grey, unsigned char share) {
    value = static_cast<uint8_t>((value * (255 - share) + grey * share + 127) / 255);
}

}  // namespace

LabelFont::LabelFont(float height) : height_(height) {
    for (const char* file : fontFiles) {
        if (std::filesystem::exists(file)) {
            file_ = readFile(file);
            return;
        }
    }
}

uint32_t LabelFont::lineHeight() const {
    return isLoaded() ? static_cast<uint32_t>(std::ceil(height_)) : 0;
}

float LabelFont::widthOf(std::string_view text) const {
    if (!isLoaded()) {
        return 0.0F;
    }
    const stbtt_fontinfo info = infoOf(file_);
    const float scale = stbtt_ScaleForPixelHeight(&info, height_);
    float width = 0.0F;
    for (const int point : codePoints(text)) {
        int advance = 0;
        stbtt_GetCodepointHMetrics(&info, point, &advance, nullptr);
        width += scale * static_cast<float>(advance);
    }
    return width;
}

std::string LabelFont::shortened(std::string_view text, float width) const {
    if (widthOf(text) <= width) {
        return std::string(text);
    }
    constexpr std::string_view ellipsis = "…";
    size_t begin = text.size() / 2;
    begin = characterBefore(text, characterAfter(text, begin));
    size_t end = begin;
    std::string result(ellipsis);
    for (bool left = true; begin > 0 || end < text.size(); left = !left) {
        begin = left ? characterBefore(text, begin) : begin;
        end = left ? end : characterAfter(text, end);
        result = std::string(text.substr(0, begin)).append(ellipsis).append(text.substr(end));
        if (widthOf(result) <= width) {
            break;
        }
    }
    return result;
}

void LabelFont::draw(Bitmap& bitmap, std::string_view text, float left, uint32_t top, uint8_t grey) const {
    if (!isLoaded()) {
        return;
    }
    const stbtt_fontinfo info = infoOf(file_);
    const float scale = stbtt_ScaleForPixelHeight(&info, height_);
    int ascent = 0;
    stbtt_GetFontVMetrics(&info, &ascent, nullptr, nullptr);
    const auto baseline = static_cast<int>(top) + static_cast<int>(std::lround(scale * static_cast<float>(ascent)));
    for (const int point : codePoints(text)) {
        int advance = 0;
        int width = 0;
        int height = 0;
        int x = 0;
        int y = 0;
        stbtt_GetCodepointHMetrics(&info, point, &advance, nullptr);
        const float shift = left - std::floor(left);
        unsigned char* letter =
            stbtt_GetCodepointBitmapSubpixel(&info, scale, scale, shift, 0.0F, point, &width, &height, &x, &y);
        for (int row = 0; row < height; ++row) {
            for (int column = 0; column < width; ++column) {
                const int px = static_cast<int>(std::floor(left)) + x + column;
                const int py = baseline + y + row;
                if (px < 0 || py < 0 || px >= static_cast<int>(bitmap.width) || py >= static_cast<int>(bitmap.height)) {
                    continue;
                }
                const auto at = (static_cast<size_t>(py) * bitmap.width + static_cast<size_t>(px)) * bitmap.channels;
                for (size_t c = 0; c < 3; ++c) {
                    blend(bitmap.data[at + c], grey, letter[row * width + column]);
                }
            }
        }
        stbtt_FreeBitmap(letter, nullptr);
        left += scale * static_cast<float>(advance);
    }
}

}  // namespace reflet
