// Neon signs of the built-in scene "street": letters bent of tubes, boards, arrows.
#include "base/error.h"
#include "scene/builtin/assemble.h"
#include "scene/builtin/street.h"

#include <array>
#include <cmath>
#include <vector>

namespace reflet::builtin::street {
namespace {

struct Letter {
    char name;
    std::string_view strokes;  ///< points "xy" with x in 0..4 and y in 0..6; '|' starts another stroke
};

constexpr std::array<Letter, 16> letters{{{'A', "0026|2640|1232"},
                                          {'B', "00063645443303|3342413000"},
                                          {'C', "45351605020120304041"},
                                          {'E', "46060040|0333"},
                                          {'F', "460600|0333"},
                                          {'H', "0006|0343|4046"},
                                          {'I', "2026"},
                                          {'J', "464120100102"},
                                          {'L', "060040"},
                                          {'N', "0006|0640|4046"},
                                          {'O', "2010010516263645413020"},
                                          {'P', "00063645443303"},
                                          {'R', "00063645443303|2340"},
                                          {'T', "0646|2026"},
                                          {'Z', "0646|4600|0040"},
                                          {'K', "0006|460340"}}};

std::string_view strokesOf(char letter) {
    for (const Letter& l : letters) {
        if (l.name == letter) {
            return l.strokes;
        }
    }
    fail("no neon letter '{}'", letter);
}

// Corners bent to arcs of about the radius, less where the line is short.
std::vector<vec3> rounded(const std::vector<vec3>& line, float radius) {
    std::vector<vec3> result{line.front()};
    for (size_t i = 1; i + 1 < line.size(); ++i) {
        const vec3& p = line[i];
        const float before = std::min(radius, 0.45F * glm::distance(p, line[i - 1]));
        const float after = std::min(radius, 0.45F * glm::distance(p, line[i + 1]));
        const vec3 from = p + before * glm::normalize(line[i - 1] - p);
        const vec3 to = p + after * glm::normalize(line[i + 1] - p);
        for (int k = 0; k <= 4; ++k) {  // a parabola
            const float t = 0.25F * static_cast<float>(k);
            result.push_back(glm::mix(glm::mix(from, p, t), glm::mix(p, to, t), t));
        }
    }
    result.push_back(line.back());
    return result;
}

using Line = std::vector<vec3>;

void addLetter(std::vector<Line>& lines, char letter, const vec2& origin) {
    Line line;
    const auto flush = [&] {
        if (line.size() >= 2) {
            lines.push_back(rounded(line, 0.16F));
        }
        line.clear();
    };
    const std::string_view strokes = strokesOf(letter);
    for (size_t i = 0; i < strokes.size();) {
        if (strokes[i] == '|') {
            flush();
            ++i;
        } else {
            const vec2 p(static_cast<float>(strokes[i] - '0') / 6.0F, static_cast<float>(strokes[i + 1] - '0') / 6.0F);
            line.emplace_back(origin + p, 0.0F);
            i += 2;
        }
    }
    flush();
}

struct Sign {
    std::string_view text;
    vec3 color;    ///< radiance [W/(m² sr)]
    mat4 toWorld;  ///< of its middle; its front faces +z
    float height = 0.5F;
    bool upright = false;
};

// The middles of the tubes; letters have the height 1 and the sign its middle at the origin.
std::vector<Line> linesOf(const Sign& s) {
    std::vector<Line> lines;
    const auto n = static_cast<float>(s.text.size());
    constexpr float advance = 0.92F;
    for (size_t i = 0; i < s.text.size(); ++i) {
        const auto k = static_cast<float>(i);
        const vec2 origin = s.upright ? vec2(-0.333F, 1.25F * (0.5F * n - k - 1.0F) + 0.125F)
                                      : vec2(advance * (k - 0.5F * n) + 0.13F, -0.5F);
        addLetter(lines, s.text[i], origin);
    }
    return lines;
}

vec2 sizeOf(const Sign& s) {
    const auto n = static_cast<float>(s.text.size());
    return s.upright ? vec2(1.1F, 1.25F * n + 0.25F) : vec2(0.92F * n + 0.25F, 1.45F);
}

// The light of the tubes on the board behind them.
TextureImage boardGlow(const std::string& name, const std::vector<Line>& lines, const vec2& size) {
    constexpr float dots = 40.0F;  // per unit
    const auto pixels = glm::uvec2(size * dots);
    Canvas canvas(name, pixels.x, pixels.y, 0x000000);
    canvas.paint([&](const vec2& uv) {
        const vec2 p = (uv - 0.5F) * vec2(1, -1) * size;
        float nearest = 1e3F;
        for (const Line& line : lines) {
            for (size_t i = 0; i + 1 < line.size(); ++i) {
                const vec2 a(line[i]);
                const vec2 ab = vec2(line[i + 1]) - a;
                const float t = glm::clamp(glm::dot(p - a, ab) / glm::dot(ab, ab), 0.0F, 1.0F);
                nearest = std::min(nearest, glm::distance(p, a + t * ab));
            }
        }
        return mixed(0x101010, 0xFFFFFF, std::exp(-nearest / 0.13F));
    });
    return canvas.finish();
}

void addSign(Scene& scene, const Sign& s, uint32_t board, uint32_t number) {
    const std::string name = "sign " + std::string(s.text) + " " + std::to_string(number);
    const mat4 scale = glm::scale(mat4(1.0F), vec3(s.height));
    const std::vector<Line> lines = linesOf(s);
    Mesh tubes;
    for (const Line& line : lines) {
        append(tubes, tube(line, 0.042F, 8), mat4(1.0F));
    }
    place(scene, name, addGlow(scene, name, s.color), tubes, s.toWorld * at({0, 0, 0.1F}) * scale);
    const vec2 half = 0.5F * s.height * sizeOf(s);
    place(scene, name + " board", board, roundedBox({half.x, half.y, 0.05F}, 0.04F, 2), s.toWorld);
    Material lit = plain(name + " glow", {0x101114, 0.4F});
    lit.emissive = 0.2F * s.color;
    lit.emissiveTexture =
        addTexture(scene, boardGlow(lit.name, lines, sizeOf(s)), {.wrapU = Wrap::clamp, .wrapV = Wrap::clamp});
    place(scene, lit.name, addMaterial(scene, lit), patch({{0, 0, 0}, {half.x, 0, 0}, {0, half.y, 0}}),
          s.toWorld * at({0, 0, 0.053F}));
    const Line rim = rounded({vec3(0, -half.y, 0), vec3(half.x, -half.y, 0), vec3(half.x, half.y, 0),
                              vec3(-half.x, half.y, 0), vec3(-half.x, -half.y, 0), vec3(0, -half.y, 0)},
                             0.06F);
    const vec3 other = 0.6F * vec3(s.color.z, s.color.x, s.color.y) + 0.1F * s.color;
    place(scene, name + " rim", addGlow(scene, name + " rim", other), tube(rim, 0.018F, 8),
          s.toWorld * at({0, 0, 0.06F}));
}

// A sign that stands off a front, seen along the street from the camera.
mat4 acrossStreet(bool left, float z, float y, float out) {
    return at({left ? -frontX + out : frontX - out, y, z});
}

mat4 onFront(bool left, float z, float y) {
    return side(left, z) * at({0, y, 0.1F});
}

// An arrow of bulbs that bends down to a door.
void addArrow(Scene& scene, const mat4& toWorld) {
    const std::array<vec3, 4> shaft{vec3(-0.9F, 0.8F, 0), vec3(0.3F, 0.8F, 0), vec3(0.6F, 0.5F, 0),
                                    vec3(0.6F, -0.6F, 0)};
    const std::array<vec3, 3> head{vec3(0.3F, -0.25F, 0), vec3(0.6F, -0.65F, 0), vec3(0.9F, -0.25F, 0)};
    Mesh mesh;
    append(mesh, tube(rounded({shaft.begin(), shaft.end()}, 0.2F), 0.03F, 8), mat4(1.0F));
    append(mesh, tube(head, 0.03F, 8), mat4(1.0F));
    place(scene, "arrow", addGlow(scene, "arrow", {9.0F, 5.2F, 0.7F}), mesh, toWorld);
}

}  // namespace

void addSigns(Scene& scene) {
    const uint32_t board = addMaterial(scene, plain("sign board", {0x15161A, 0.25F}));
    const vec3 pink(13.0F, 1.2F, 5.2F);
    const vec3 cyan(0.9F, 8.5F, 11.0F);
    const vec3 amber(13.0F, 6.0F, 0.8F);
    const vec3 green(1.2F, 10.5F, 3.2F);
    const vec3 violet(5.2F, 1.8F, 13.0F);
    const vec3 red(13.5F, 1.1F, 0.7F);
    const std::array<Sign, 11> signs{{
        {"HOTEL", pink, acrossStreet(true, -8.5F, 5.9F, 0.85F), 0.66F, true},
        {"BAR", cyan, acrossStreet(true, -2.6F, 4.2F, 0.9F), 0.62F},
        {"REFLET", red, onFront(true, -5.6F, 3.26F), 0.5F},
        {"CAFE", amber, acrossStreet(true, -12.0F, 4.1F, 1.5F), 0.66F},
        {"NEON", green, acrossStreet(true, -19.0F, 6.6F, 0.85F), 0.85F, true},
        {"JAZZ", violet, acrossStreet(false, -7.6F, 5.2F, 0.95F), 0.75F, true},
        {"OPEN", cyan, onFront(false, -3.4F, 3.26F), 0.42F},
        {"PIZZA", amber, acrossStreet(false, -13.5F, 4.2F, 1.6F), 0.62F},
        {"BAR", pink, acrossStreet(false, -21.5F, 6.2F, 0.95F), 0.9F, true},
        {"TOTO", green, acrossStreet(true, -31.0F, 5.8F, 1.0F), 0.95F, true},
        {"HOTEL", red, acrossStreet(false, -31.0F, 7.2F, 1.0F), 0.95F, true},
    }};
    for (size_t i = 0; i < signs.size(); ++i) {
        addSign(scene, signs.at(i), board, static_cast<uint32_t>(i));
    }
    addArrow(scene, acrossStreet(true, -2.5F, 3.15F, 1.15F));
}

}  // namespace reflet::builtin::street
