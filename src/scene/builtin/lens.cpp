// Things at all distances from a camera with a wide aperture: thin rods close to it, patterned figures in the plane of
// focus, posts behind them, and small bright lamps in front of a dark wall, which a lens turns into disks.
#include "scene/builtin/assemble.h"
#include "scene/builtin/patterns.h"
#include "scene/builtin/scenes.h"

#include <array>
#include <cmath>

namespace reflet::builtin {
namespace {

constexpr vec3 eye{0.0F, 1.15F, 5.0F};
constexpr vec3 subject{0.0F, 0.62F, 0.0F};
constexpr float wallDepth = 9.0F;  // metres behind the subject

uint32_t stripes(Scene& scene, const std::string& name, Hex light, Hex dark, const vec2& repeats) {
    Canvas canvas(name, 256, 256, light);
    canvas.paint([&](const vec2& uv) {
        const vec2 at = uv * repeats;
        const int cell = static_cast<int>(std::floor(at.x)) + static_cast<int>(std::floor(at.y));
        return cell % 2 == 0 ? light : dark;
    });
    return addMaterial(scene, textured(name, addTexture(scene, canvas.finish()), 0.6F));
}

void addRoom(Scene& scene) {
    static constexpr std::array<Hex, 4> colors{0x8E8778, 0x6F6A60, 0x4F6A70, 0x7D5A3C};
    const LabelledTiles style{
        .size = 1024, .tiles = 8, .colors = colors, .joint = 0x2A2826, .letters = 0xC8C0B0, .grain = 2.0F, .seed = 27};
    const uint32_t tiles =
        addMaterial(scene, textured("tiles", addTexture(scene, labelledTiles("tiles", style)), 0.85F));
    place(scene, "ground", tiles, ground({7.0F, 7.35F}, {6, 6}, {1.4F, 1.47F}), at({0, 0, -1.65F}));
    const uint32_t rock =
        addMaterial(scene, textured("rock", addTexture(scene, rockColors("rock", 512, 0x30333B, 0x3E424C)), 0.9F));
    place(scene, "wall", rock, box({7.0F, 2.2F, 0.15F}, 0.2F), at({0, 2.2F, -wallDepth - 0.15F}));
}

// In the plane of focus, about five metres from the camera.
void addFigures(Scene& scene) {
    const uint32_t ball = stripes(scene, "ball", 0xEFE6D2, 0xA8321F, {12, 8});
    place(scene, "ball", ball, sphere(0.38F, 40), at({-0.95F, 0.38F, 0.1F}) * turned(20, {0, 0, 1}));
    const uint32_t sign = addMaterial(
        scene, textured("sign", addTexture(scene, emblem("sign", "F28", 0x27476B, 0xE9DFC8, 0xD9A441)), 0.5F));
    place(scene, "box", sign, box({0.34F, 0.45F, 0.34F}), at({0.05F, 0.45F, -0.1F}) * turned(24));
    static constexpr std::array<vec2, 6> vase{vec2(0, 0),       vec2(0.2F, 0),     vec2(0.3F, 0.35F),
                                              vec2(0.1F, 0.8F), vec2(0.17F, 1.0F), vec2(0, 1.0F)};
    const uint32_t glaze = stripes(scene, "vase", 0xD8D2C2, 0x2D6A66, {16, 1});
    place(scene, "vase", glaze, lathe(vase, 40), at({1.05F, 0, 0.0F}));
}

// Close to the camera: they cover sharp things with their blur.
void addRods(Scene& scene) {
    struct Rod {
        vec3 from;
        vec3 to;
        Hex color;
    };
    static constexpr std::array<Rod, 4> rods{{{{-0.36F, 0, 3.3F}, {-0.3F, 2.2F, 3.3F}, 0xD8C24A},
                                              {{0.4F, 0, 2.9F}, {0.5F, 2.2F, 2.8F}, 0xC0C6CC},
                                              {{0.17F, 0, 1.9F}, {0.29F, 1.9F, 2.1F}, 0x9E3A5A},
                                              {{-0.85F, 0.62F, 3.5F}, {0.85F, 0.74F, 3.2F}, 0x2F6FA8}}};
    for (size_t i = 0; i < rods.size(); ++i) {
        const std::string name = "rod " + std::to_string(i);
        const uint32_t paint = addMaterial(scene, plain(name, {rods[i].color, 0.5F}));
        place(scene, name, paint, cylinder(0.012F, glm::distance(rods[i].from, rods[i].to), 12),
              between(rods[i].from, rods[i].to));
    }
}

// Between the subject and the wall, more blurred one by one.
void addPosts(Scene& scene) {
    const uint32_t paint = stripes(scene, "posts", 0xD9D4C6, 0x33302C, {1, 10});
    const uint32_t post = addMesh(scene, "post", paint, cylinder(0.07F, 1.5F, 20));
    for (int i = 0; i < 5; ++i) {
        const float depth = 1.3F + 1.5F * static_cast<float>(i);
        const float side = i % 2 == 0 ? -1.0F : 1.0F;
        place(scene, "post " + std::to_string(i), post, at({side * (0.55F + 0.33F * depth), 0, -depth}));
    }
}

// From the golden ratio: spread, without a visible order. All are in front of the wall, at 4 to 8 m behind the subject.
void addLamps(Scene& scene) {
    static constexpr std::array<Hex, 6> hues{0xFFB057, 0xFF6A4A, 0xFFE6B0, 0x6FA8FF, 0x58E0B0, 0xE070FF};
    static constexpr std::array<float, 4> radiances{8.0F, 20.0F, 50.0F, 140.0F};
    std::array<uint32_t, hues.size() * radiances.size()> meshes{};
    for (size_t i = 0; i < meshes.size(); ++i) {
        Material glow = plain("lamp " + std::to_string(i), {0x000000, 0.9F});
        glow.emissive = radiances[i / hues.size()] * linear(hues[i % hues.size()]);
        const uint32_t material = addMaterial(scene, glow);
        meshes[i] = addMesh(scene, glow.name, material, sphere(i % 3 == 0 ? 0.035F : 0.025F, 10));
    }
    for (int i = 0; i < 64; ++i) {
        const float n = static_cast<float>(i) + 0.5F;
        const vec3 share = glm::fract(n * vec3(0.6180340F, 0.7548777F, 0.5698403F));
        const float depth = 4.0F + 4.0F * share.z;
        const float width = 2.2F + 0.4F * depth;
        const vec3 position((2.0F * share.x - 1.0F) * width, 0.25F + 2.5F * share.y, -depth);
        const auto mesh = static_cast<size_t>(i * 7) % meshes.size();
        place(scene, "lamp " + std::to_string(i), meshes.at(mesh), at(position));
    }
}

}  // namespace

Scene makeLens() {
    Scene scene;
    scene.name = "lens";
    addRoom(scene);
    addFigures(scene);
    addRods(scene);
    addPosts(scene);
    addLamps(scene);
    Camera main = camera("main", eye, subject, 30);
    main.apertureRadius = 0.08F;
    main.focusDistance = glm::distance(eye, subject);
    scene.cameras.push_back(main);
    scene.sun = sun({-0.55F, -0.65F, -0.45F}, {2.6F, 2.4F, 2.1F});
    scene.environment.radiance = {0.05F, 0.06F, 0.085F};
    return scene;
}

}  // namespace reflet::builtin
