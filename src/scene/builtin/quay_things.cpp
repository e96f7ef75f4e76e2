// Things on and off the quay of the built-in scene "quay": stalls, cloth, boats, cargo.
#include "scene/builtin/animate.h"
#include "scene/builtin/assemble.h"
#include "scene/builtin/patterns.h"
#include "scene/builtin/quay.h"

#include <array>
#include <cmath>
#include <string>

namespace reflet::builtin {
namespace {

// Cloth that lets part of the light through.
uint32_t cloth(Scene& scene, const std::string& name, Hex color, Hex stripe, float alpha) {
    Canvas canvas(name, 128, 128, color);
    for (int i = 0; i < 4; ++i) {
        canvas.rectangle({32 * i + 16, 0, 16, 128}, stripe);
    }
    Material m = textured(name, addTexture(scene, canvas.finish()), 0.8F);
    m.baseColor.a = alpha;
    m.blended = true;
    m.alphaCutoff = blendCutoff;
    m.doubleSided = true;
    return addMaterial(scene, m);
}

// Swings about its upper end by `degrees` to both sides, once in `seconds`.
int32_t addSwingingNode(Scene& scene, const vec3& pivot, const vec3& axis, double degrees, float seconds) {
    const int32_t node = addNode(scene, pivot);
    Channel channel{
        .target = Channel::Target::rotation, .interpolation = Interpolation::linear, .times = {}, .values = {}};
    constexpr int keys = 16;
    for (int i = 0; i <= keys; ++i) {
        const double t = double(i) / keys;
        channel.times.push_back(static_cast<float>(t) * seconds);
        channel.values.push_back(rotation(degrees * std::sin(2.0 * glm::pi<double>() * (t + 0.15)), axis));
    }
    animate(scene, node, std::move(channel));
    return node;
}

// A table under an awning, open to the water.
void addStalls(Scene& scene) {
    const uint32_t wood = addMaterial(scene, plain("stall", {0x7A5B3C, 0.75F}));
    const std::array<uint32_t, 3> awnings{cloth(scene, "red awning", 0xB8392B, 0xEDE3CF, 0.8F),
                                          cloth(scene, "blue awning", 0x2C5E8A, 0xE9E4D6, 0.75F),
                                          cloth(scene, "green awning", 0x3E7A4C, 0xE6DDC4, 0.8F)};
    Mesh stall;
    append(stall, box({0.55F, 0.04F, 1.5F}, 0.5F), at({0, 0.86F, 0}));
    for (int i = 0; i < 4; ++i) {
        const bool front = i < 2;
        const float height = front ? 1.15F : 1.4F;
        append(stall, box({0.04F, height, 0.04F}), at({front ? -0.9F : 0.9F, height, i % 2 == 0 ? -1.5F : 1.5F}));
    }
    append(stall, box({0.5F, 0.42F, 1.4F}, 0.5F), at({0.02F, 0.42F, 0}));
    finish(stall);
    const uint32_t stallMesh = addMesh(scene, "stall", wood, stall);
    const Mesh awning = patch({{0.95F, -0.24F, 0}, {0, 0, 1.6F}, {1.1F, 0.3F, 0}, {1, 1}, {2, 1}});
    static constexpr std::array<Hex, 4> goods{0xD9822B, 0xB6302A, 0x8FA63A, 0xE3C44E};
    for (size_t s = 0; s < 5; ++s) {
        const vec3 foot(7.4F, 0, 4.5F - 5.2F * static_cast<float>(s));
        const std::string name = std::to_string(s);
        place(scene, "stall " + name, stallMesh, at(foot));
        // Hinged at its front edge.
        place(scene, "awning " + name, awnings.at(s % awnings.size()), awning);
        scene.instances.back().node =
            addSwingingNode(scene, foot + vec3(-1.0F, 2.38F, 0), {0, 0, 1}, 2.5, 3.0F + 0.4F * static_cast<float>(s));
        for (size_t k = 0; k < goods.size(); ++k) {
            const uint32_t fruit = addMaterial(scene, plain("fruit", {goods.at((k + s) % goods.size()), 0.4F}));
            Mesh heap;
            for (int i = 0; i < 9; ++i) {
                append(heap, sphere(0.085F, 10),
                       at({0.17F * float(i % 3) - 0.17F, 0.07F, 0.17F * float(i / 3) - 0.17F}));
            }
            finish(heap);
            place(scene, "fruit", fruit, heap, at(foot + vec3(-0.2F, 0.9F, -1.05F + 0.7F * static_cast<float>(k))));
        }
    }
}

// Between the posts of the quay and above the paving: what is behind shows through.
void addBanners(Scene& scene) {
    const uint32_t gold = cloth(scene, "gold cloth", 0xD39A2C, 0xB4472A, 0.55F);
    const uint32_t violet = cloth(scene, "violet cloth", 0x5B4A9A, 0x8E7CC3, 0.5F);
    const uint32_t wood = addMaterial(scene, plain("pole", {0x6A5440, 0.7F}));
    Mesh pole;
    append(pole, cylinder(0.035F, 3.3F, 10), mat4(1.0F));
    append(pole, cylinder(0.018F, 0.9F, 8), between({0, 3.2F, 0}, {0.9F, 3.2F, 0}));
    finish(pole);
    const uint32_t poleMesh = addMesh(scene, "pole", wood, pole);
    const Mesh flag = patch({{0.48F, -0.95F, 0}, {0.4F, 0, 0}, {0, 0.93F, 0}, {1, 1}, {1, 1}});
    for (int i = 0; i < 6; ++i) {
        const vec3 foot(-2.9F, 0, 6.0F - 7.5F * static_cast<float>(i));
        const std::string name = std::to_string(i);
        place(scene, "pole " + name, poleMesh, at(foot));
        place(scene, "banner " + name, i % 2 == 0 ? gold : violet, flag);
        scene.instances.back().node = addSwingingNode(scene, foot + vec3(0, 3.18F, 0), {1, 0, 0}, 12.0, 2.4F);
    }
}

void addBoats(Scene& scene) {
    static constexpr std::array<vec2, 8> hull{vec2(0, -0.6F),    vec2(0.5F, -0.55F), vec2(0.85F, -0.1F),
                                              vec2(1, 0.6F),     vec2(0.94F, 0.6F),  vec2(0.9F, 0.3F),
                                              vec2(0.6F, 0.28F), vec2(0, 0.28F)};
    const Mesh shape = lathe(hull, 40);
    const uint32_t mast = addMaterial(scene, plain("mast", {0x9A7F5C, 0.6F}));
    const uint32_t sail = cloth(scene, "sail", 0xD8CBB0, 0xCFC0A2, 0.85F);
    static constexpr std::array<Hex, 4> paints{0x2F4F63, 0xC8C2B4, 0x7A2E28, 0x3F5B46};
    for (size_t i = 0; i < 6; ++i) {
        const std::string name = std::to_string(i);
        const float z = 0.0F - 12.5F * static_cast<float>(i);
        const vec3 at0(-7.6F - (i % 2 == 0 ? 0.0F : 1.2F), -1.1F, z);
        const uint32_t paint = addMaterial(scene, plain("hull " + name, {paints.at(i % paints.size()), 0.35F}));
        place(scene, "boat " + name, paint, shape, glm::scale(at(at0), {1.3F, 1.2F, 4.2F}));
        place(scene, "mast " + name, mast, cylinder(0.06F, 7.0F, 10), at(at0 + vec3(0, 0.3F, 0.4F)));
        place(scene, "boom " + name, mast, cylinder(0.04F, 3.4F, 8),
              between(at0 + vec3(0, 1.5F, 0.4F), at0 + vec3(0, 1.6F, 3.8F)));
        if (i % 3 == 1) {
            const Mesh canvas = patch({{0, -2.0F, 0.7F}, {0, 0, 0.65F}, {0, 1.9F, 0}, {1, 1}, {1, 1}});
            place(scene, "sail " + name, sail, canvas);
            scene.instances.back().node = addSwingingNode(scene, at0 + vec3(0, 6.0F, 0.5F), {0, 1, 0}, 14.0, 4.0F);
        }
    }
}

void addCargo(Scene& scene) {
    const uint32_t plank =
        addMaterial(scene, textured("planks", addTexture(scene, rockColors("planks", 128, 0x6B4E30, 0xA88458)), 0.75F));
    const uint32_t crate = addMesh(scene, "crate", plank, roundedBox(vec3(0.4F), 0.03F, 2));
    struct Put {
        vec3 place;
        float turn;
    };
    static constexpr std::array<Put, 7> crates{{{{-3.4F, 0.4F, -2.2F}, 8},
                                                {{-3.3F, 0.4F, -3.2F}, -14},
                                                {{-3.35F, 1.2F, -2.65F}, 27},
                                                {{-1.9F, 0.4F, -9.0F}, 35},
                                                {{3.6F, 0.4F, -16.0F}, 12},
                                                {{4.5F, 0.4F, -16.6F}, -7},
                                                {{4.0F, 1.2F, -16.3F}, 21}}};
    for (size_t i = 0; i < crates.size(); ++i) {
        place(scene, "crate " + std::to_string(i), crate, at(crates[i].place) * turned(crates[i].turn));
    }
    static constexpr std::array<vec2, 6> outline{vec2(0, 0),        vec2(0.26F, 0),    vec2(0.34F, 0.4F),
                                                 vec2(0.34F, 0.5F), vec2(0.26F, 0.9F), vec2(0, 0.9F)};
    const uint32_t oak = addMaterial(scene, plain("oak", {0x6E4A2C, 0.55F}));
    const uint32_t barrel = addMesh(scene, "barrel", oak, lathe(outline, 24));
    for (int i = 0; i < 5; ++i) {
        place(scene, "barrel " + std::to_string(i), barrel,
              at({3.3F + 0.75F * float(i % 2), 0, -4.0F - 0.8F * float(i)}));
    }
    const uint32_t steel = addMaterial(scene, plain("buoy", {0xC7431F, 0.2F}));
    place(scene, "buoy", steel, sphere(0.3F, 32), at({-1.7F, 0.3F, 4.6F}));
}

}  // namespace

void addQuayThings(Scene& scene) {
    addStalls(scene);
    addBanners(scene);
    addBoats(scene);
    addCargo(scene);
}

}  // namespace reflet::builtin
