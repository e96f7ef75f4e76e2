// Draws the images of patterns.h.
#include "scene/builtin/patterns.h"

#include "scene/builtin/noise.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

namespace reflet::builtin {
namespace {

/// Position of a point in the paving: its stone, and the distance to the stone's edge (in units of the whole image).
struct Stone {
    int course = 0;
    int number = 0;
    float toEdge = 0.0F;
};

constexpr int courses = 4;
constexpr std::array<int, courses> stonesInCourse{3, 2, 3, 2};
constexpr float halfJoint = 0.004F;

Stone stoneAt(const vec2& uv) {
    Stone s;
    s.course = std::min(static_cast<int>(uv.y * courses), courses - 1);
    const int stones = stonesInCourse[static_cast<size_t>(s.course)];
    // The joints of a course are evenly spaced, with hashed offsets.
    const auto joint = [&](int i) {
        const float shift = 0.35F * hash01(s.course, (i + stones) % stones, 3, 77U);
        return (static_cast<float>(i) + shift) / static_cast<float>(stones);
    };
    int i = 0;
    while (i < stones && joint(i) <= uv.x) {
        ++i;
    }
    s.number = i % stones;
    const float inCourse = uv.y - static_cast<float>(s.course) / courses;
    const float across = std::min(uv.x - joint(i - 1), joint(i) - uv.x);
    s.toEdge = std::min(across, std::min(inCourse, 1.0F / courses - inCourse));
    return s;
}

float rockHeight(const vec2& uv) {
    const float ridges = 1.0F - std::abs(tilingNoise(uv, 6, 4, 41U));
    return ridges * ridges + 0.5F * tilingNoise(uv, 12, 3, 42U);
}

}  // namespace

TextureImage labelledTiles(std::string name, const LabelledTiles& style) {
    Canvas canvas(std::move(name), style.size, style.size, style.joint);
    const int tile = static_cast<int>(style.size) / style.tiles;
    const int gap = std::max(1, tile / 40);
    const auto colors = static_cast<uint32_t>(style.colors.size());
    for (int row = 0; row < style.tiles; ++row) {
        for (int column = 0; column < style.tiles; ++column) {
            const uint32_t pick = hash(column, row, 0, style.seed) % colors;
            const float shade = 0.10F * hash01(column, row, 1, style.seed);
            const Hex color = mixed(style.colors[pick], 0x000000, shade);
            canvas.rectangle({column * tile + gap, row * tile + gap, tile - 2 * gap, tile - 2 * gap}, color);
            const std::string label = static_cast<char>('A' + column) + std::to_string(row + 1);
            canvas.text(label, (vec2(column, row) + 0.5F) * static_cast<float>(tile), tile / 18, style.letters);
        }
    }
    canvas.grain(style.grain, style.seed);
    return canvas.finish();
}

TextureImage emblem(std::string name, std::string_view label, Hex field, Hex frame, Hex mark) {
    constexpr int size = 512;
    Canvas canvas(std::move(name), size, size, frame);
    canvas.rectangle({28, 28, size - 56, size - 56}, field);
    canvas.rectangle({44, 44, size - 88, size - 88}, mixed(field, 0xFFFFFF, 0.12F));
    canvas.disc({256, 256}, 176, frame);
    canvas.disc({256, 256}, 156, field);
    canvas.text(label, {256, 256}, 24, mark);
    canvas.rectangle({64, 64, 64, 64}, mark);  // marks one corner, to show orientation and mirroring
    canvas.rectangle({64, size - 96, 64, 32}, frame);
    canvas.grain(3.0F, 9U);
    return canvas.finish();
}

TextureImage pavingColors(std::string name, uint32_t size, Hex stone, Hex otherStone, Hex joint) {
    Canvas canvas(std::move(name), size, size, joint);
    canvas.paint([&](const vec2& uv) {
        const Stone s = stoneAt(uv);
        if (s.toEdge < halfJoint) {
            return joint;
        }
        const float cloud = tilingNoise(uv, 8, 4, 51U);
        return mixed(stone, otherStone, hash01(s.course, s.number, 5, 78U) * 0.8F + 0.35F * cloud + 0.1F);
    });
    return canvas.finish();
}

TextureImage pavingNormals(std::string name, uint32_t size, float metres) {
    return normalMap(std::move(name), size, metres, [&](const vec2& uv) {
        const Stone s = stoneAt(uv);
        const float edge = glm::smoothstep(0.0F, 3.0F * halfJoint, s.toEdge);
        const float tilt = (hash01(s.course, s.number, 6, 79U) - 0.5F) * 0.008F;
        return edge * (0.018F + tilt) + 0.004F * tilingNoise(uv, 16, 3, 52U);
    });
}

TextureImage rockColors(std::string name, uint32_t size, Hex dark, Hex light) {
    Canvas canvas(std::move(name), size, size, dark);
    canvas.paint([&](const vec2& uv) {
        const float bend = 0.06F * tilingNoise(uv, 3, 2, 43U);
        const vec2 streaked(uv.x, uv.y + bend - std::floor(uv.y + bend));
        return mixed(dark, light, 0.35F + 0.35F * rockHeight(uv) + 0.5F * tilingNoise(streaked, 5, 3, 44U));
    });
    return canvas.finish();
}

TextureImage rockNormals(std::string name, uint32_t size, float metres) {
    return normalMap(std::move(name), size, metres, [&](const vec2& uv) { return 0.03F * rockHeight(uv); });
}

TextureImage piercedPanel(std::string name, uint32_t size, int repeats, Hex color) {
    Canvas canvas(std::move(name), size, size, color);
    const float cell = static_cast<float>(size) / static_cast<float>(repeats);
    for (int y = 0; y < static_cast<int>(size); ++y) {
        for (int x = 0; x < static_cast<int>(size); ++x) {
            const vec2 p = (vec2(x, y) + 0.5F) / cell;
            const vec2 ring = glm::abs(p - glm::floor(p) - 0.5F);                // from the middle of a cell
            const vec2 star = glm::abs(p + 0.5F - glm::floor(p + 0.5F) - 0.5F);  // from the corner of a cell
            const float root = std::sqrt(star.x) + std::sqrt(star.y);            // an astroid
            if (glm::length(ring) < 0.31F || root < 0.52F) {
                canvas.set(x, y, color, 0);
            }
        }
    }
    const int rim = static_cast<int>(cell * 0.16F);
    const int all = static_cast<int>(size);
    canvas.rectangle({0, 0, all, rim}, color);
    canvas.rectangle({0, all - rim, all, rim}, color);
    canvas.rectangle({0, 0, rim, all}, color);
    canvas.rectangle({all - rim, 0, rim, all}, color);
    return canvas.finish();
}

}  // namespace reflet::builtin
