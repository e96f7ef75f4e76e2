// A box balanced on one corner above a plain glossy ground: its underside shows in the reflection only.
#include "scene/builtin/assemble.h"
#include "scene/builtin/patterns.h"
#include "scene/builtin/scenes.h"

#include <array>

namespace reflet::builtin {
namespace {

/// Every face has its own colour and number, which identify it in reflections.
void addNumberedBox(Scene& scene, const mat4& boxToWorld) {
    static constexpr std::array<Hex, 6> colors{0xD2553A, 0x3D7FA6, 0xE3AE3C, 0x6B4C8A, 0x4E9A63, 0xC9507E};
    const std::array<Patch, 6> sides{{{{1, 0, 0}, {0, 0, -1}, {0, 1, 0}},
                                      {{-1, 0, 0}, {0, 0, 1}, {0, 1, 0}},
                                      {{0, 1, 0}, {1, 0, 0}, {0, 0, -1}},
                                      {{0, -1, 0}, {1, 0, 0}, {0, 0, 1}},
                                      {{0, 0, 1}, {1, 0, 0}, {0, 1, 0}},
                                      {{0, 0, -1}, {-1, 0, 0}, {0, 1, 0}}}};
    for (size_t i = 0; i < sides.size(); ++i) {
        const std::string number(1, static_cast<char>('1' + i));
        const auto image = addTexture(scene, emblem("face " + number, number, colors[i], 0xF1E8D6, 0xFBF6EA));
        const uint32_t material = addMaterial(scene, textured("face " + number, image, 0.6F));
        place(scene, "face " + number, material, patch(sides[i]), boxToWorld);
    }
}

}  // namespace

Scene makeTiltedCube() {
    Scene scene;
    scene.name = "tilted-cube";
    const uint32_t floor = addMaterial(scene, plain("glossy ground", {0x8F8B86, 0.08F, 0.4F}));
    place(scene, "ground", floor, ground({5, 5}, {10, 10}, {10, 10}), at({0, -1, 0}));
    addNumberedBox(scene, at({0, 0.85F, 0}) * turned(28) * turned(38, {1, 0, -0.55F}));

    scene.cameras.push_back(camera("main", {6.0F, 1.9F, 3.7F}, {0.0F, -0.1F, 0.0F}, 42));
    scene.sun = sun({0.4F, -0.9F, -0.2F}, {3.7F, 3.5F, 3.2F});
    scene.environment.radiance = {0.28F, 0.36F, 0.48F};
    return scene;
}

}  // namespace reflet::builtin
