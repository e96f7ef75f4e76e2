// Two rows on labelled tiles, roughness 0 to 1 from left to right: metal blocks behind, enamelled spheres in front.
#include "scene/builtin/assemble.h"
#include "scene/builtin/patterns.h"
#include "scene/builtin/scenes.h"

#include <array>

namespace reflet::builtin {
namespace {

constexpr int steps = 6;
constexpr float spacing = 1.3F;

uint32_t glossGround(Scene& scene) {
    static constexpr std::array<Hex, 5> colors{0xE6DECF, 0xCFC4B0, 0x2F6F7E, 0xD98E4A, 0x47525A};
    const LabelledTiles style{
        .size = 1024, .tiles = 10, .colors = colors, .joint = 0x2E2C2A, .letters = 0x1E1C1B, .seed = 5};
    return addMaterial(scene, textured("tiles", addTexture(scene, labelledTiles("tiles", style)), 0.3F));
}

void addRows(Scene& scene) {
    const Mesh block = roundedBox({0.46F, 0.75F, 0.46F}, 0.12F, 5);
    const Mesh ball = sphere(0.45F, 48);
    for (int i = 0; i < steps; ++i) {
        const float roughness = static_cast<float>(i) / (steps - 1);
        const float x = (static_cast<float>(i) - 0.5F * (steps - 1)) * spacing;
        const std::string step = std::to_string(i);
        const uint32_t metal =
            addMaterial(scene, plain("metal " + step, {i % 2 == 0 ? 0xF3D08CU : 0xE9E4DEU, roughness, 1.0F}));
        place(scene, "block " + step, metal, block, at({x, 0.75F, -0.9F}));
        const uint32_t enamel =
            addMaterial(scene, plain("enamel " + step, {i % 2 == 0 ? 0xB3241EU : 0x1F4E9EU, roughness}));
        place(scene, "ball " + step, enamel, ball, at({x + 0.3F, 0.45F, 1.1F}));
    }
}

/// Coloured boards behind the rows, to be reflected by the tops and the ground.
void addBoards(Scene& scene) {
    static constexpr std::array<Hex, 5> colors{0xE0A33A, 0xBF4B32, 0xEFE3CD, 0x3E7C74, 0x33506E};
    for (size_t i = 0; i < colors.size(); ++i) {
        const uint32_t paint = addMaterial(scene, plain("board " + std::to_string(i), {colors[i], 0.85F}));
        const float x = (static_cast<float>(i) - 2.0F) * 1.9F;
        place(scene, "board " + std::to_string(i), paint, box({0.8F, 1.25F, 0.06F}), at({x, 1.25F, -3.2F}));
    }
}

}  // namespace

Scene makeGloss() {
    Scene scene;
    scene.name = "gloss";
    place(scene, "ground", glossGround(scene), ground({6, 6}, {8, 8}, {1, 1}));
    addRows(scene);
    addBoards(scene);
    scene.cameras.push_back(camera("main", {0.0F, 3.3F, 7.4F}, {0.1F, 0.5F, -0.3F}, 36));
    scene.sun = sun({0.5F, -0.8F, -0.45F}, {3.8F, 3.6F, 3.25F});
    scene.environment.radiance = {0.34F, 0.42F, 0.54F};
    return scene;
}

}  // namespace reflet::builtin
