// Windows, doors and shop fronts of the built-in scene "street". What is behind the glass is an image that glows.
#include "scene/builtin/assemble.h"
#include "scene/builtin/noise.h"
#include "scene/builtin/street.h"

#include <array>
#include <cmath>
#include <string>

namespace reflet::builtin::street {
namespace {

// A room seen through a window: a lamp's light that falls off, curtains, sometimes a plant.
TextureImage roomImage(uint32_t number, Hex light, Hex curtain) {
    Canvas canvas("room " + std::to_string(number), 64, 96, 0x000000);
    const vec2 lamp(0.25F + 0.5F * hash01(0, 0, 0, number), 0.25F);
    const float drawn = 0.12F + 0.3F * hash01(1, 0, 0, number);
    canvas.paint([&](const vec2& uv) {
        const float away = glm::length((uv - lamp) * vec2(1.0F, 1.3F));
        const Hex room = mixed(light, 0x1A0E08, std::min(1.0F, 0.2F + 1.1F * away));
        const bool cloth = uv.x < drawn || uv.x > 1.0F - drawn;
        const float fold = 0.5F + 0.5F * std::sin(40.0F * uv.x + 2.0F * uv.y);
        const bool plant = uv.y > 0.72F + 0.2F * noise(vec3(9.0F * uv.x, 5.0F * uv.y, 0), number) && number % 2 == 0;
        const Hex inside = plant ? mixed(room, 0x06120A, 0.85F) : room;
        return cloth ? mixed(mixed(curtain, light, 0.3F), 0x150C08, 0.25F + 0.5F * fold * away + 0.2F * away) : inside;
    });
    return canvas.finish();
}

// A shop: a lit ceiling, shelves with goods of many colours, a counter.
TextureImage shopImage(uint32_t number, Hex light) {
    Canvas canvas("shop " + std::to_string(number), 256, 128, 0x000000);
    canvas.paint([&](const vec2& uv) {
        const float lamps = 0.5F + 0.5F * std::cos(2.0F * pi * 4.0F * uv.x);
        const float down = std::exp(-2.2F * uv.y);
        return mixed(0x1C0C04, light, 0.06F + 0.5F * down + 0.25F * lamps * std::exp(-9.0F * uv.y));
    });
    static constexpr std::array<Hex, 8> goods{0xD84B3A, 0xE9B44C, 0x4C8C6B, 0x3F6FA8,
                                              0xE8DCC0, 0x8A4F7D, 0xC9713B, 0x7FB7B0};
    for (int shelf = 0; shelf < 4; ++shelf) {
        const int y = 34 + 24 * shelf;
        int x = 4;
        while (x < 250) {
            const uint32_t pick = hash(x, shelf, 0, number);
            const int width = 3 + static_cast<int>(pick % 8U);
            const int height = 6 + static_cast<int>(pick / 8U % 12U);
            if (pick % 5U != 0) {
                const Hex color = mixed(goods.at(pick / 128U % goods.size()), 0x140A06, 0.15F);
                canvas.rectangle({x, y - height, width, height},
                                 mixed(color, 0x1A0E08, 0.12F * static_cast<float>(shelf)));
            }
            x += width + 1 + static_cast<int>(pick / 1024U % 4U);
        }
        canvas.rectangle({0, y, 256, 3}, 0x2A1A10);
    }
    for (int i = 0; i < 3; ++i) {  // people
        const int x = 30 + static_cast<int>(hash(i, 1, 0, number) % 190U);
        canvas.disc({static_cast<float>(x), 62.0F}, 7.5F, 0x140B08);
        canvas.rectangle({x - 12, 70, 24, 58}, 0x140B08);
    }
    return canvas.finish();
}

uint32_t addGlassPane(Scene& scene, const std::string& name, const TextureSlot& behind, float radiance) {
    Material m = plain(name, {0x0B0E11, 0.04F});
    m.emissive = vec3(radiance);
    m.emissiveTexture = behind;
    return addMaterial(scene, m);
}

Mesh frameMesh(const vec2& size) {
    Mesh mesh;
    const float z = -Openings::depth + 0.03F;
    const vec2 half = 0.5F * size;
    for (const float s : {-1.0F, 1.0F}) {
        append(mesh, box({0.045F, half.y, 0.035F}), at({s * (half.x - 0.045F), half.y, z}));
        append(mesh, box({half.x, 0.045F, 0.035F}), at({0, half.y + s * (half.y - 0.045F), z}));
    }
    append(mesh, box({0.025F, half.y, 0.025F}), at({0, half.y, z}));
    append(mesh, box({half.x, 0.025F, 0.025F}), at({0, 1.25F * half.y, z}));
    return mesh;
}

TextureImage stripes(Hex color) {
    Canvas canvas("awning", 64, 16, 0xE8E0D0);
    for (int i = 0; i < 4; ++i) {
        canvas.rectangle({16 * i, 0, 8, 16}, color);
    }
    return canvas.finish();
}

// A cloth of 1 m width that hangs over 1.2 m of the pavement, with a scalloped edge.
Mesh awningMesh() {
    Mesh mesh;
    constexpr int columns = 16;
    const std::array<vec2, 4> profile{vec2(0.04F, 0.0F), vec2(0.6F, -0.17F), vec2(1.2F, -0.42F), vec2(1.23F, -0.64F)};
    for (size_t row = 0; row < profile.size(); ++row) {
        for (int column = 0; column <= columns; ++column) {
            const float u = static_cast<float>(column) / columns;
            const float scallop = row + 1 == profile.size() ? 0.07F * std::abs(std::sin(4.0F * pi * u)) : 0.0F;
            const size_t next = std::min(row + 1, profile.size() - 1);
            const vec2 down = glm::normalize(profile[next] - profile[next - 1]);
            addVertex(mesh, {u - 0.5F, profile[row].y + 0.07F - scallop, profile[row].x}, {0, down.x, -down.y},
                      {u, 0.3F * static_cast<float>(row)});
        }
    }
    for (uint32_t row = 0; row + 1 < profile.size(); ++row) {
        for (uint32_t column = 0; column < columns; ++column) {
            const uint32_t a = row * (columns + 1) + column;
            const uint32_t b = a + columns + 1;
            mesh.indices.insert(mesh.indices.end(), {a, b, b + 1, a, b + 1, a + 1});
        }
    }
    finish(mesh);
    return mesh;
}

}  // namespace

Openings::Openings(Scene& scene) : scene_(scene) {
    const uint32_t wood = addMaterial(scene, plain("window frame", {0xC9C2B4, 0.5F}));
    frame_ = addMesh(scene, "window frame", wood, frameMesh(window));
    sill_ = addMesh(scene, "window sill", addMaterial(scene, plain("sill", {0xA39A8C, 0.6F})),
                    boxMapped(roundedBox({0.5F * window.x + 0.1F, 0.06F, 0.16F}, 0.025F, 1), 1.0F));
    const Patch pane{{0, 0.5F * window.y, -depth}, {0.5F * window.x, 0, 0}, {0, 0.5F * window.y, 0}};
    static constexpr std::array<Hex, 6> lights{0xFFC27A, 0xFFD9A0, 0xFFB060, 0xFFE2B8, 0xA8C8FF, 0xFF9A5A};
    static constexpr std::array<Hex, 6> curtains{0xA03C2C, 0xC9B48A, 0x5A6E4A, 0xB0563A, 0x3A4A7A, 0x8A5A3A};
    for (uint32_t i = 0; i < lights.size(); ++i) {
        const uint32_t material = addGlassPane(scene, "lit window " + std::to_string(i),
                                               addTexture(scene, roomImage(i + 1, lights.at(i), curtains.at(i))), 2.6F);
        panes_.push_back(addMesh(scene, "lit window " + std::to_string(i), material, patch(pane)));
    }
    panes_.push_back(
        addMesh(scene, "dark window", addMaterial(scene, plain("dark window", {0x0B0E11, 0.04F})), patch(pane)));
    static constexpr std::array<Hex, 3> shops{0xFFD08A, 0xBFE4FF, 0xFFA66A};
    for (uint32_t i = 0; i < shops.size(); ++i) {
        shopGlass_.push_back(addGlassPane(scene, "shop window " + std::to_string(i),
                                          addTexture(scene, shopImage(i + 51, shops.at(i))), 2.3F));
    }
    static constexpr std::array<Hex, 5> woods{0x1F4A3A, 0x6E1F1C, 0x1D2C4A, 0x2B2320, 0x7A4A1E};
    for (uint32_t i = 0; i < woods.size(); ++i) {
        Material paint = plain("shop front " + std::to_string(i), {woods.at(i), 0.35F});
        shopWood_.push_back(addMaterial(scene, paint));
    }
    static constexpr std::array<Hex, 3> cloths{0xB03028, 0x1F6A5A, 0x2A4A8A};
    for (size_t i = 0; i < cloths.size(); ++i) {
        Material cloth = textured("awning " + std::to_string(i), addTexture(scene, stripes(cloths.at(i))), 0.7F);
        cloth.doubleSided = true;
        awning_[i] = addMesh(scene, cloth.name, addMaterial(scene, cloth), awningMesh());
    }
}

void Openings::addWindow(const mat4& toWorld, uint32_t number) {
    place(scene_, "window frame", frame_, toWorld);
    place(scene_, "window sill", sill_, toWorld * at({0, -0.06F, 0.06F}));
    const bool lit = number % 100U < 38U;
    const size_t pane = lit ? number / 100U % (panes_.size() - 1) : panes_.size() - 1;
    place(scene_, "window", panes_[pane], toWorld);
}

void Openings::addShop(const mat4& toWorld, const vec2& size, uint32_t number) {
    const std::string name = "shop " + std::to_string(number);
    const uint32_t wood = shopWood_.at(number % shopWood_.size());
    const float half = 0.5F * size.x;
    constexpr float plinth = 0.65F;  // of the window's lower edge
    constexpr float top = 2.75F;
    const float doorX = (number % 2 == 0 ? -1.0F : 1.0F) * (half - 1.1F);
    Mesh front;
    append(front, box({half, 0.5F * (size.y - top), 0.08F}, 0.5F), at({0, 0.5F * (size.y + top), 0.0F}));
    append(front, box({half, 0.07F, 0.16F}, 0.5F), at({0, top + 0.06F, 0.1F}));
    append(front, box({half, 0.5F * plinth, 0.07F}, 0.5F), at({0, 0.5F * plinth, -0.02F}));
    const int bays = static_cast<int>(size.x / 1.6F);
    for (int i = 0; i <= bays; ++i) {
        const float x = -half + size.x * static_cast<float>(i) / static_cast<float>(bays);
        append(front, box({0.07F, 0.5F * top, 0.1F}, 0.5F),
               at({glm::clamp(x, 0.07F - half, half - 0.07F), 0.5F * top, 0}));
    }
    append(front, box({half, 0.04F, 0.06F}, 0.5F), at({0, 2.25F, -0.03F}));
    place(scene_, name, wood, front, toWorld);
    place(scene_, name + " glass", shopGlass_.at(number % shopGlass_.size()),
          patch({{0, 0.5F * (plinth + top), -0.12F},
                 {half, 0, 0},
                 {0, 0.5F * (top - plinth), 0},
                 {1, 1},
                 {size.x / 6.0F, 1}}),
          toWorld);
    place(scene_, name + " door", wood, box({0.5F, 1.15F, 0.05F}, 0.5F), toWorld * at({doorX, 1.15F, 0.07F}));
    Mesh glass = patch({{0, 1.35F, 0.125F}, {0.36F, 0, 0}, {0, 0.75F, 0}, {1, 1}, {0.15F, 0.8F}});
    place(scene_, name + " door's glass", shopGlass_.at((number + 1) % shopGlass_.size()), glass,
          toWorld * at({doorX, 0, 0}));
    if (number % 3 != 1) {
        const int pieces = static_cast<int>(size.x / 2.0F) - 1;
        for (int i = 0; i < pieces; ++i) {
            const float x = -static_cast<float>(pieces) + 1.0F + 2.0F * static_cast<float>(i);
            place(scene_, name + " awning", awning_[number % 3],
                  toWorld * at({x, top + 0.05F, 0.1F}) * glm::scale(mat4(1.0F), vec3(2, 1, 1)));
        }
    }
}

}  // namespace reflet::builtin::street
