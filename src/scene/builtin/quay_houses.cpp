// The houses of the built-in scene "quay": gabled boxes with painted fronts, some of whose windows are lit.
#include "scene/builtin/assemble.h"
#include "scene/builtin/noise.h"
#include "scene/builtin/quay.h"

#include <array>
#include <string>

namespace reflet::builtin {
namespace {

constexpr int columns = 4;  // of windows on a front
constexpr int storeys = 4;  // the lowest has doors

// Pixels of a window or door; the image has 64 per column and storey.
PixelBox opening(int column, int storey) {
    const bool door = storey == storeys - 1;
    return {column * 64 + (door ? 14 : 19), storey * 64 + (door ? 8 : 14), door ? 36 : 26, door ? 56 : 36};
}

struct Style {
    Hex wall;
    Hex frame;
    uint32_t seed;
};

Material front(Scene& scene, const std::string& name, const Style& style) {
    Canvas paint(name, columns * 64, storeys * 64, style.wall);
    paint.paint([&](const vec2& uv) {
        const bool joint = static_cast<int>(uv.y * 256.0F) % 8 == 0;
        const float cloud = 0.5F + 0.5F * tilingNoise(uv, 5, 4, style.seed);
        return mixed(mixed(style.wall, 0x3A2E28, 0.35F * cloud), 0x2A2522, joint ? 0.3F : 0.0F);
    });
    Canvas light(name + " light", columns * 64, storeys * 64, 0x000000);
    for (int storey = 0; storey < storeys; ++storey) {
        for (int column = 0; column < columns; ++column) {
            PixelBox b = opening(column, storey);
            paint.rectangle({b.x - 3, b.y - 3, b.width + 6, b.height + 6}, style.frame);
            paint.rectangle(b, 0x15191C);
            if (hash01(column, storey, 3, style.seed) < 0.35F) {
                light.rectangle(b, hash01(column, storey, 4, style.seed) < 0.5F ? 0xFFC27A : 0xFFD9A0);
            }
            const PixelBox bar{b.x + b.width / 2 - 1, b.y, 3, b.height};
            const PixelBox across{b.x, b.y + b.height / 3, b.width, 2};
            for (const PixelBox& part : {bar, across}) {
                paint.rectangle(part, style.frame);
                light.rectangle(part, 0x000000);
            }
        }
    }
    paint.grain(5.0F, style.seed);
    Material m = textured(name, addTexture(scene, paint.finish()), 0.8F);
    m.emissive = vec3(0.9F);
    m.emissiveTexture = addTexture(scene, light.finish());
    return m;
}

// Its front is at x = 0 and faces -x, its gable has the height of half of its width.
struct House {
    float width = 10.0F;
    float height = 7.0F;
    float depth = 9.0F;
};

Mesh wallOf(const House& h) {
    return patch({{0, 0.5F * h.height, 0}, {0, 0, 0.5F * h.width}, {0, 0.5F * h.height, 0}, {1, 1}, {1, 1}});
}

// Gable, roof and sides.
Mesh restOf(const House& h) {
    const float half = 0.5F * h.width;
    const float ridge = h.height + 0.55F * h.width;
    Mesh mesh;
    for (const float side : {-1.0F, 1.0F}) {
        const vec3 middle(0.5F * h.depth - 0.2F, 0.5F * (h.height + ridge), 0.5F * side * half);
        const vec3 along(side * (0.5F * h.depth + 0.2F), 0, 0);
        append(mesh, patch({middle, along, {0, 0.5F * (ridge - h.height), -0.5F * side * half}, {1, 1}, {4, 4}}),
               mat4(1.0F));
        const vec3 wall(0.5F * h.depth, 0.5F * h.height, side * half);
        append(mesh, patch({wall, {side * 0.5F * h.depth, 0, 0}, {0, 0.5F * h.height, 0}, {1, 1}, {4, 4}}), mat4(1.0F));
    }
    finish(mesh);
    return mesh;
}

Mesh gableOf(const House& h) {
    Mesh mesh;
    const float ridge = h.height + 0.55F * h.width;
    addVertex(mesh, {0, h.height, -0.5F * h.width}, {-1, 0, 0}, {0, 1});
    addVertex(mesh, {0, h.height, 0.5F * h.width}, {-1, 0, 0}, {1, 1});
    addVertex(mesh, {0, ridge, 0}, {-1, 0, 0}, {0.5F, 0});
    mesh.indices = {0, 1, 2};
    finish(mesh);
    return mesh;
}

}  // namespace

void addHouses(Scene& scene, const Along& line) {
    static constexpr std::array<Style, 5> styles{{{0xA5543C, 0xE6DFD0, 71U},
                                                  {0xC9A86A, 0x5A3B2A, 72U},
                                                  {0x7C8B86, 0xE9E4D8, 73U},
                                                  {0xB9AC98, 0x3D4A52, 74U},
                                                  {0x8E4A48, 0xD9CDB8, 75U}}};
    std::array<uint32_t, styles.size()> fronts{};
    std::array<uint32_t, styles.size()> gables{};
    for (size_t i = 0; i < styles.size(); ++i) {
        const std::string name = "front " + std::to_string(i);
        fronts[i] = addMaterial(scene, front(scene, name, styles[i]));
        gables[i] = addMaterial(scene, plain("gable " + std::to_string(i), {styles[i].wall, 0.85F}));
    }
    Material slate = plain("slate", {0x4A4440, 0.7F});
    slate.doubleSided = true;
    const uint32_t roof = addMaterial(scene, slate);
    int number = 0;
    for (float z = line.from; z > line.to; ++number) {
        const House h{.width = 8.0F + 5.0F * hash01(number, 0, 0, 76U),
                      .height = 6.5F + 4.5F * hash01(number, 1, 0, 76U)};
        z -= 0.5F * h.width;
        const auto style = size_t(number * 2) % styles.size();
        const std::string name = std::to_string(number);
        place(scene, "front " + name, fronts.at(style), wallOf(h), at({line.x, 0, z}));
        place(scene, "gable " + name, gables.at(style), gableOf(h), at({line.x, 0, z}));
        place(scene, "house " + name, roof, restOf(h), at({line.x, 0, z}));
        z -= 0.5F * h.width + (number % 4 == 2 ? 2.5F : 0.0F);  // an alley
    }
}

}  // namespace reflet::builtin
