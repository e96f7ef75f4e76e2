// A polished box and painted cubes on labelled tiles: reflections, contact shadows and colour bleeding.
#include "scene/builtin/assemble.h"
#include "scene/builtin/patterns.h"
#include "scene/builtin/scenes.h"

#include <array>

namespace reflet::builtin {
namespace {

uint32_t cubesGround(Scene& scene) {
    static constexpr std::array<Hex, 5> colors{0xD9CBB0, 0xB8A98C, 0x8FA3A6, 0xC98F62, 0x5E7480};
    const LabelledTiles style{.size = 1024, .tiles = 8, .colors = colors, .joint = 0x3A3835, .letters = 0x2B2724};
    return addMaterial(scene, textured("tiles", addTexture(scene, labelledTiles("tiles", style)), 0.55F));
}

}  // namespace

Scene makeCubes() {
    Scene scene;
    scene.name = "cubes";
    place(scene, "ground", cubesGround(scene), ground({5, 5}, {8, 8}, {1, 1}), at({0, -1, 0}) * turned(90));

    const uint32_t polished = addMaterial(scene, plain("polished metal", {0xE9A67C, 0.05F, 1.0F}));
    place(scene, "box", polished, box({1, 1, 1}));

    const auto board = addTexture(scene, emblem("emblem", "3", 0xC8402E, 0xF2E3C4, 0xF8F1E0));
    const uint32_t painted = addMaterial(scene, textured("emblem", board, 0.7F));
    place(scene, "emblem cube", painted, box(vec3(0.5F)), at({2.0F, -0.5F, 1.75F}) * turned(62));

    const uint32_t blue = addMaterial(scene, plain("ultramarine", {0x2F55C8, 0.8F}));
    const uint32_t small = addMesh(scene, "small cube", blue, box(vec3(0.35F)));
    place(scene, "blue cube", small, at({2.35F, -0.65F, -1.15F}) * turned(20));
    const uint32_t yellow = addMaterial(scene, plain("ochre", {0xE8B23A, 0.8F}));
    place(scene, "ochre cube", addMesh(scene, "ochre cube", yellow, box(vec3(0.55F))),
          at({0.4F, -0.45F, -2.3F}) * turned(-25));

    scene.cameras.push_back(camera("main", {6.0F, 3.3F, 2.7F}, {0.5F, -0.45F, 0.0F}, 42));
    scene.cameras.push_back(camera("side", {6, 1, 0}, {0, 0, 0}, 60));
    scene.sun = sun({0.4F, -0.9F, -0.2F}, {3.9F, 3.65F, 3.3F});
    scene.environment.radiance = {0.30F, 0.40F, 0.55F};
    return scene;
}

}  // namespace reflet::builtin
