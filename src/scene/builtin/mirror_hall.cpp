// A hall under open beams: one long wall and the floor are mirrors, with coloured objects and labelled walls to
// reflect.
#include "scene/builtin/assemble.h"
#include "scene/builtin/patterns.h"
#include "scene/builtin/scenes.h"

#include <array>

namespace reflet::builtin {
namespace {

constexpr vec3 hall{3.5F, 1.75F, 5.0F};  // half size, metres; the floor is at y = 0
constexpr float thick = 0.1F;

/// Roughness alternates between 0 and 0.03 from one slab to the next, in the texture's green channel.
Material mirrorFloor(Scene& scene) {
    Canvas slabs("floor roughness", 64, 64, 0xFF00FF);
    slabs.rectangle({0, 0, 32, 32}, 0xFF08FF);
    slabs.rectangle({32, 32, 32, 32}, 0xFF08FF);
    Sampler sharp;
    sharp.magLinear = false;
    Material m = plain("mirror floor", {0xC4C8CC, 1.0F, 1.0F});
    m.metallicRoughnessTexture = addTexture(scene, slabs.finish(), sharp);
    return m;
}

void addHall(Scene& scene) {
    static constexpr std::array<Hex, 4> colors{0xE9DDC6, 0xDDB98A, 0xC96F4A, 0x7E9C93};
    const LabelledTiles style{
        .size = 1024, .tiles = 8, .colors = colors, .joint = 0x544A40, .letters = 0x33291F, .seed = 11};
    const auto image = addTexture(scene, labelledTiles("wall tiles", style));
    const uint32_t tiled = addMaterial(scene, textured("wall tiles", image, 0.8F));
    const uint32_t plaster = addMaterial(scene, plain("plaster", {0xD9CCB6, 0.9F}));
    const uint32_t mirror = addMaterial(scene, plain("mirror wall", {0xEDEFF0, 0.0F, 1.0F}));
    place(scene, "floor", addMaterial(scene, mirrorFloor(scene)), ground({hall.x, hall.z}, {1, 1}, {3.5F, 5.0F}));
    place(scene, "left wall", tiled,
          patch({{-hall.x, hall.y, 0}, {0, 0, -hall.z}, {0, hall.y, 0}, {4, 2}, {1.43F, 0.5F}}));
    place(scene, "back wall", tiled,
          patch({{0, hall.y, -hall.z}, {hall.x, 0, 0}, {0, hall.y, 0}, {4, 2}, {1.0F, 0.5F}}));
    place(scene, "mirror", mirror, patch({{hall.x, hall.y, 0}, {0, 0, hall.z}, {0, hall.y, 0}, {4, 2}, {1, 1}}));
    place(scene, "front wall", plaster, patch({{0, hall.y, hall.z}, {-hall.x, 0, 0}, {0, hall.y, 0}, {4, 2}, {1, 1}}));
    const Mesh side = box({thick, hall.y, hall.z + 2 * thick});
    place(scene, "left shell", plaster, side, at({-hall.x - thick - 0.01F, hall.y, 0}));
    place(scene, "right shell", plaster, side, at({hall.x + thick + 0.01F, hall.y, 0}));
    const Mesh end = box({hall.x, hall.y, thick});
    place(scene, "back shell", plaster, end, at({0, hall.y, -hall.z - thick - 0.01F}));
    place(scene, "front shell", plaster, end, at({0, hall.y, hall.z + thick + 0.01F}));
    const uint32_t wood = addMaterial(scene, plain("beam", {0x6E4A2E, 0.8F}));
    const Mesh skirting = box({0.03F, 0.06F, hall.z});
    place(scene, "skirting left", wood, skirting, at({0.03F - hall.x, 0.06F, 0}));
    place(scene, "skirting right", wood, skirting, at({hall.x - 0.03F, 0.06F, 0}));
    place(scene, "skirting back", wood, box({hall.x, 0.06F, 0.03F}), at({0, 0.06F, 0.03F - hall.z}));
    place(scene, "corner post", wood, box({0.06F, hall.y, 0.06F}), at({hall.x - 0.06F, hall.y, 0.06F - hall.z}));
    place(scene, "mirror rail", wood, box({0.03F, 0.06F, hall.z}), at({hall.x - 0.03F, 2 * hall.y - 0.06F, 0}));
    const uint32_t beam = addMesh(scene, "beam", wood, box({hall.x + 2 * thick, 0.14F, 0.1F}, 0.5F));
    for (int i = 0; i < 5; ++i) {
        place(scene, "beam " + std::to_string(i), beam,
              at({0, 2 * hall.y + 0.14F, -4.0F + 2.0F * static_cast<float>(i)}));
    }
}

void addThings(Scene& scene) {
    const uint32_t red = addMaterial(scene, plain("red", {0xC73A2B, 0.5F}));
    const uint32_t blue = addMaterial(scene, plain("blue", {0x2B5FB0, 0.5F}));
    const uint32_t yellow = addMaterial(scene, plain("yellow", {0xE9B437, 0.6F}));
    const uint32_t green = addMaterial(scene, plain("green", {0x3E8F5A, 0.6F}));
    const uint32_t gold = addMaterial(scene, plain("brushed gold", {0xF2C66E, 0.25F, 1.0F}));
    place(scene, "red ball", red, sphere(0.55F, 48), at({1.5F, 0.55F, 0.4F}));
    place(scene, "blue block", blue, roundedBox({0.45F, 0.8F, 0.45F}, 0.08F, 4), at({-0.9F, 0.8F, -1.2F}) * turned(30));
    static constexpr std::array<vec2, 3> cone{vec2(0, 0), vec2(0.6F, 0), vec2(0, 1.5F)};
    place(scene, "yellow cone", yellow, lathe(cone, 40), at({1.7F, 0, -2.3F}));
    place(scene, "green drum", green, cylinder(0.5F, 0.7F, 40), at({-2.3F, 0, 0.2F}));
    place(scene, "gold ball", gold, sphere(0.4F, 48), at({-2.3F, 1.1F, 0.2F}));
    const auto board = addTexture(scene, emblem("emblem", "F", 0x33506E, 0xF2E3C4, 0xF8F1E0));
    const uint32_t marked = addMaterial(scene, textured("emblem", board, 0.6F));
    place(scene, "emblem cube", marked, box(vec3(0.55F)), at({0.35F, 0.55F, -3.4F}) * turned(-20));
}

}  // namespace

Scene makeMirrorHall() {
    Scene scene;
    scene.name = "mirror-hall";
    addHall(scene);
    addThings(scene);
    scene.cameras.push_back(camera("main", {-1.9F, 1.75F, 4.6F}, {0.6F, 0.95F, -1.5F}, 52));
    scene.sun = sun({-0.45F, -0.75F, -0.48F}, {5.2F, 4.8F, 4.1F});
    scene.environment.radiance = {0.32F, 0.42F, 0.58F};
    return scene;
}

}  // namespace reflet::builtin
