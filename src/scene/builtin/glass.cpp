// Glass on labelled tiles before a labelled wall: a clear and a frosted ball, a block that absorbs light, a clear and a
// frosted pane thinner than a pixel, a bottle with liquid, and a varnished ball.
#include "scene/builtin/assemble.h"
#include "scene/builtin/patterns.h"
#include "scene/builtin/scenes.h"

#include <array>

namespace reflet::builtin {
namespace {

struct Glass {
    Hex color = 0xFFFFFF;
    float roughness = 0.0F;
    float thickness = 0.0F;  ///< metres; 0: a pane
    float ior = 1.5F;
    vec3 attenuationColor{1.0F};
    float attenuationDistance = 1.0F;  ///< metres
};

uint32_t addGlass(Scene& scene, const std::string& name, const Glass& glass) {
    Material m = plain(name, {glass.color, glass.roughness});
    m.ior = glass.ior;
    m.transmission.factor = 1.0F;
    m.transmission.thickness = glass.thickness;
    m.transmission.attenuationColor = glass.attenuationColor;
    m.transmission.attenuationDistance = glass.attenuationDistance;
    m.doubleSided = glass.thickness == 0.0F;
    return addMaterial(scene, m);
}

void addRoom(Scene& scene) {
    static constexpr std::array<Hex, 4> floorColors{0xD8CDB8, 0x8FA3A6, 0xB9825A, 0x5E6E78};
    const LabelledTiles floor{
        .size = 1024, .tiles = 8, .colors = floorColors, .joint = 0x2E2C2A, .letters = 0x1E1C1B, .seed = 12};
    const uint32_t tiles =
        addMaterial(scene, textured("floor tiles", addTexture(scene, labelledTiles("floor tiles", floor)), 0.6F));
    place(scene, "floor", tiles, ground({4, 3.5F}, {8, 7}, {1, 0.875F}));
    static constexpr std::array<Hex, 5> wallColors{0xEADFC8, 0xC8503C, 0x3D7A85, 0xE0A33A, 0x33506E};
    const LabelledTiles wall{
        .size = 1024, .tiles = 8, .colors = wallColors, .joint = 0x3A352F, .letters = 0x1E1C1B, .seed = 31};
    const uint32_t paint =
        addMaterial(scene, textured("wall tiles", addTexture(scene, labelledTiles("wall tiles", wall)), 0.85F));
    place(scene, "wall", paint, patch({{0, 1.5F, -2.5F}, {4, 0, 0}, {0, 1.5F, 0}, {8, 3}, {1.0F, 0.375F}}));
}

void addSolids(Scene& scene) {
    const uint32_t clear = addGlass(scene, "clear glass", {.thickness = 1.0F});
    place(scene, "ball", clear, sphere(0.55F, 64), at({-0.75F, 0.56F, 0.1F}));
    const uint32_t frosted = addGlass(scene, "frosted glass", {.roughness = 0.4F, .thickness = 0.7F});
    place(scene, "frosted ball", frosted, sphere(0.35F, 48), at({0.15F, 0.36F, 0.95F}));
    const uint32_t amber = addGlass(
        scene, "amber",
        {.thickness = 0.5F, .ior = 1.54F, .attenuationColor = {0.9F, 0.45F, 0.1F}, .attenuationDistance = 0.5F});
    place(scene, "block", amber, roundedBox({0.3F, 0.25F, 0.3F}, 0.04F, 3), at({-1.75F, 0.26F, 1.0F}) * turned(25.0F));
}

void addPanes(Scene& scene) {
    const uint32_t clear = addGlass(scene, "green pane", {.color = 0xB8E0CC});
    place(scene, "pane", clear, patch({{0, 0.75F, 0}, {0.55F, 0, 0}, {0, 0.7F, 0}, {1, 1}, {1, 1}}),
          at({1.75F, 0, 0.6F}) * turned(-25.0F));
    const uint32_t frosted = addGlass(scene, "frosted pane", {.roughness = 0.35F});
    place(scene, "frosted pane", frosted, patch({{0, 0.8F, 0}, {0.5F, 0, 0}, {0, 0.75F, 0}, {1, 1}, {1, 1}}),
          at({-2.3F, 0, -0.9F}) * turned(15.0F));
}

/// The liquid reaches 2 mm into the glass, where the volume that a ray entered last counts.
void addBottle(Scene& scene) {
    const uint32_t glass =
        addGlass(scene, "bottle glass",
                 {.thickness = 0.02F, .attenuationColor = {0.6F, 0.9F, 0.7F}, .attenuationDistance = 0.1F});
    constexpr float shoulder = 0.75F;
    const std::array<vec2, 18> outline{
        vec2(0, 0),         vec2(0.27F, 0),      vec2(0.29F, 0.02F), vec2(0.29F, shoulder), vec2(0.26F, 0.84F),
        vec2(0.19F, 0.92F), vec2(0.12F, 0.98F),  vec2(0.1F, 1.05F),  vec2(0.1F, 1.25F),     vec2(0.13F, 1.27F),
        vec2(0.13F, 1.32F), vec2(0.08F, 1.32F),  vec2(0.08F, 1.05F), vec2(0.1F, 0.96F),     vec2(0.17F, 0.9F),
        vec2(0.24F, 0.82F), vec2(0.265F, 0.04F), vec2(0, 0.04F)};
    const mat4 place0 = at({0.75F, 0.01F, -0.35F});
    place(scene, "bottle", glass, lathe(outline, 48), place0);
    const uint32_t wine = addGlass(
        scene, "wine",
        {.thickness = 0.5F, .ior = 1.34F, .attenuationColor = {0.75F, 0.2F, 0.25F}, .attenuationDistance = 0.3F});
    const std::array<vec2, 4> liquid{vec2(0, 0.038F), vec2(0.267F, 0.038F), vec2(0.259F, 0.55F), vec2(0, 0.55F)};
    place(scene, "wine", wine, lathe(liquid, 48), place0);
}

void addVarnished(Scene& scene) {
    Material varnished = plain("varnished wood", {0x8A3B22, 0.7F});
    varnished.clearcoat = {.factor = 1.0F, .roughness = 0.05F};
    place(scene, "varnished ball", addMaterial(scene, varnished), sphere(0.28F, 48), at({1.15F, 0.28F, 1.35F}));
    const uint32_t post = addMaterial(scene, plain("post", {0xEFE3CD, 0.8F}));
    place(scene, "post", post, cylinder(0.12F, 1.1F, 24), at({-0.95F, 0, -1.2F}));
}

}  // namespace

Scene makeGlass() {
    Scene scene;
    scene.name = "glass";
    addRoom(scene);
    addSolids(scene);
    addPanes(scene);
    addBottle(scene);
    addVarnished(scene);
    scene.cameras.push_back(camera("main", {0.1F, 1.7F, 5.4F}, {-0.1F, 0.62F, 0.0F}, 36));
    scene.sun = sun({0.45F, -0.75F, -0.5F}, {3.6F, 3.4F, 3.1F});
    scene.environment.radiance = {0.36F, 0.43F, 0.54F};
    return scene;
}

}  // namespace reflet::builtin
