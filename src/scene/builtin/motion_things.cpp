// Scenes of `reflet bench --motions` of things that move before a wall of labelled tiles.
#include "scene/builtin/animate.h"
#include "scene/builtin/assemble.h"
#include "scene/builtin/motion_scenes.h"
#include "scene/builtin/patterns.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace reflet::builtin {
namespace {

// A wall of labelled tiles at z = -2 behind a glossy floor.
void addMotionStage(Scene& scene) {
    static constexpr std::array<Hex, 4> warm{0xE9DDC6, 0xDDB98A, 0xC96F4A, 0x7E9C93};
    static constexpr std::array<Hex, 3> cool{0x8E9AA3, 0x6C7A86, 0xA9A294};
    const LabelledTiles wall{
        .size = 512, .tiles = 8, .colors = warm, .joint = 0x544A40, .letters = 0x33291F, .seed = 21};
    const LabelledTiles floor{
        .size = 512, .tiles = 8, .colors = cool, .joint = 0x2E2C2A, .letters = 0x23303A, .seed = 8};
    const uint32_t walls =
        addMaterial(scene, textured("wall tiles", addTexture(scene, labelledTiles("wall tiles", wall)), 0.85F));
    const uint32_t floors =
        addMaterial(scene, textured("floor tiles", addTexture(scene, labelledTiles("floor tiles", floor)), 0.25F));
    place(scene, "floor", floors, ground({5, 3}, {5, 3}, {1.25F, 0.75F}));
    place(scene, "wall", walls, patch({{0, 2, -2}, {5, 0, 0}, {0, 2, 0}, {5, 2}, {1.25F, 0.5F}}));
}

Scene motionStage(const char* name) {
    Scene scene;
    scene.name = name;
    addMotionStage(scene);
    scene.cameras.push_back(camera("main", {0.0F, 1.2F, 3.2F}, {0.0F, 0.9F, -2.0F}, 45));
    scene.sun = sun({0.35F, -0.8F, -0.5F}, {4.4F, 4.1F, 3.6F});
    scene.environment.radiance = {0.32F, 0.4F, 0.52F};
    return scene;
}

// A leaf: a disc with a notch and a hole on a transparent square.
TextureSlot leafTexture(Scene& scene) {
    Canvas canvas("leaf", 128, 128, 0x3E6B34);
    for (int y = 0; y < canvas.height(); ++y) {
        for (int x = 0; x < canvas.width(); ++x) {
            const vec2 p = (vec2(x, y) + 0.5F) / 64.0F - 1.0F;
            const float lobe = 0.62F + 0.3F * std::cos(5.0F * std::atan2(p.x, -p.y));
            const Hex color = std::abs(p.x) < 0.04F ? 0xA9B86A : mixed(0x2F5A2A, 0x6E9A48, 0.5F + 0.5F * p.y);
            canvas.set(x, y, color, glm::length(p) < lobe ? 255 : 0);
        }
    }
    return addTexture(scene, canvas.finish());
}

// Joints along y, each swinging about z by the same angle.
void addSwingingFigure(Scene& scene, const vec3& foot) {
    constexpr int joints = 3;
    constexpr float step = 0.5F;
    std::vector<vec2> outline{vec2(0.0F)};
    for (int i = 0; i <= 24; ++i) {
        outline.emplace_back(0.2F, step * joints * static_cast<float>(i) / 24.0F);
    }
    outline.emplace_back(0.0F, step * joints);
    Mesh mesh = lathe(outline, 24);
    for (const vec3& p : mesh.positions) {
        const float along = glm::clamp(p.y / step - 0.5F, 0.0F, float(joints - 1));
        const auto below = std::min(static_cast<uint16_t>(along), uint16_t(joints - 2));
        const float share = along - static_cast<float>(below);
        mesh.addSkin(std::array{JointWeight{below, 1.0F - share}, JointWeight{below + 1U, share}});
    }
    Skin skin;
    for (int i = 0; i < joints; ++i) {
        const int32_t parent = i == 0 ? -1 : static_cast<int32_t>(skin.joints.back());
        const int32_t node = addNode(scene, i == 0 ? glm::dvec3(foot) : glm::dvec3(0, step, 0), parent);
        skin.joints.push_back(static_cast<uint32_t>(node));
        skin.inverseBind.push_back(at({0, -step * static_cast<float>(i), 0}));
        if (i > 0) {
            animate(scene, node,
                    {.target = Channel::Target::rotation,
                     .times = {0.0F, 1.0F},
                     .values = {rotation(35, {0, 0, 1}), rotation(-50, {0, 0, 1})}});
        }
    }
    scene.skins.push_back(std::move(skin));
    const uint32_t yellow = addMaterial(scene, plain("yellow", {0xE9B437, 0.55F}));
    place(scene, "skinned figure", yellow, std::move(mesh), at(foot));
    scene.instances.back().skin = 0;
}

// A ball whose target stretches it upwards and narrows it.
void addMorphedFigure(Scene& scene, const vec3& center) {
    Mesh mesh = sphere(0.4F, 32);
    mesh.morph.targets.push_back(Aabb{vec3(0.0F), vec3(0.0F)});
    for (const vec3& p : mesh.positions) {
        mesh.morph.vertices.push_back({static_cast<uint32_t>(mesh.morph.deltas.size()), 1});
        const vec3 delta(-0.5F * p.x, 1.2F * p.y, -0.5F * p.z);
        mesh.morph.deltas.push_back({.position = delta});
        mesh.morph.targets[0].add(delta);
    }
    const uint32_t red = addMaterial(scene, plain("red", {0xC73A2B, 0.5F}));
    place(scene, "morphed figure", red, std::move(mesh), at(center));
    const int32_t node = addNode(scene, center);
    scene.instances.back().node = node;
    scene.instances.back().weights = {0.0F};
    animate(scene, node,
            {.target = Channel::Target::weights, .times = {0.0F, 1.0F}, .values = {}, .weights = {-0.4F, 1.6F}});
}

Material motionGlass(const char* name, Hex color, float thickness) {
    Material m = plain(name, {color, 0.0F});
    m.transmission.factor = 1.0F;
    m.transmission.thickness = thickness;
    m.transmission.attenuationColor = {0.75F, 0.9F, 0.8F};
    m.transmission.attenuationDistance = 1.0F;
    m.doubleSided = thickness == 0.0F;
    return m;
}

Mesh uprightPane() {
    return patch({{0, 0, 0}, {0.45F, 0, 0}, {0, 0.7F, 0}, {1, 1}, {1, 1}});
}

}  // namespace

Scene makeMotionRods() {
    Scene scene = motionStage("motion-rods");
    const uint32_t dark = addMaterial(scene, plain("dark", {0x2A2E36, 0.6F}));
    const uint32_t light = addMaterial(scene, plain("light", {0xF2F0EA, 0.6F}));
    for (int i = 0; i < 14; ++i) {
        const float x = -2.6F + 0.4F * static_cast<float>(i);
        const float radius = 0.012F + 0.006F * static_cast<float>(i % 4);
        place(scene, "rod", i % 2 == 0 ? dark : light, cylinder(radius, 2.4F, 8),
              at({x, 0, 0.4F - 0.35F * static_cast<float>(i % 3)}));
    }
    return scene;
}

Scene makeMotionLeaves() {
    Scene scene = motionStage("motion-leaves");
    Material leaf = textured("leaf", leafTexture(scene), 0.7F);
    leaf.alphaCutoff = 0.5F;
    leaf.doubleSided = true;
    const uint32_t mesh = addMesh(scene, "leaf", addMaterial(scene, leaf),
                                  patch({{0, 0.28F, 0}, {0.28F, 0, 0}, {0, 0.28F, 0}, {1, 1}, {1, 1}}));
    for (int i = 0; i < 18; ++i) {
        const auto number = static_cast<float>(i);
        const vec3 stem(-1.7F + 0.2F * number, 0.25F + 0.55F * static_cast<float>((i * 7) % 4),
                        0.6F - 0.11F * static_cast<float>(i % 5));
        const float lean = 18.0F * static_cast<float>(i % 5) - 36.0F;
        const int32_t node = addNode(scene, stem);
        animate(scene, node,
                {.target = Channel::Target::rotation,
                 .times = {0.0F, 0.5F, 1.0F},
                 .values = {rotation(lean - 25, {0, 0, 1}), rotation(lean + 25, {0, 0, 1}),
                            rotation(lean - 25, {0, 0, 1})}});
        place(scene, "leaf", mesh, at(stem));
        scene.instances.back().node = node;
    }
    return scene;
}

Scene makeMotionFigures() {
    Scene scene = motionStage("motion-figures");
    addSwingingFigure(scene, {-0.8F, 0, -0.4F});
    addMorphedFigure(scene, {0.8F, 0.75F, -0.2F});
    return scene;
}

Scene makeMotionInstances() {
    Scene scene = motionStage("motion-instances");
    const uint32_t blue = addMaterial(scene, plain("blue", {0x2B5FB0, 0.4F}));
    const uint32_t gold = addMaterial(scene, plain("gold", {0xF2C66E, 0.2F, 1.0F}));
    const uint32_t ball = addMesh(scene, "ball", gold, sphere(0.13F, 16));
    const uint32_t block = addMesh(scene, "block", blue, roundedBox(vec3(0.11F, 0.3F, 0.11F), 0.03F, 2));
    const int32_t carousel = addTurningNode(scene, {0, 0.7F, -0.5F}, {0, 1, 0}, 180.0F, 1.0F);
    for (int i = 0; i < 24; ++i) {
        const auto number = static_cast<float>(i);
        const float angle = glm::radians(15.0F * number);
        const vec3 seat(1.35F * std::cos(angle), 0.25F * std::sin(3.0F * angle), 1.0F * std::sin(angle));
        place(scene, "seat", i % 2 == 0 ? ball : block, at(vec3(0, 0.7F, -0.5F) + seat));
        scene.instances.back().node = carousel;
        scene.instances.back().objectToNode = at(seat);
    }
    return scene;
}

Scene makeMotionGlass() {
    Scene scene = motionStage("motion-glass");
    const uint32_t solid = addMaterial(scene, motionGlass("glass", 0xFFFFFF, 0.7F));
    place(scene, "ball", solid, sphere(0.45F, 32));
    scene.instances.back().node = addSlidingNode(scene, {-1.3F, 0.55F, -0.2F}, {1.1F, 0.55F, -0.2F}, 1.0F);
    const uint32_t sheet = addMaterial(scene, motionGlass("pane", 0x8FD0B0, 0.0F));
    place(scene, "pane", sheet, uprightPane());
    scene.instances.back().node = addSlidingNode(scene, {1.2F, 1.1F, -0.9F}, {-1.2F, 1.1F, -0.9F}, 1.0F);
    return scene;
}

Scene makeMotionBlended() {
    Scene scene = motionStage("motion-blended");
    static constexpr std::array<Hex, 2> stripes{0x2B5FB0, 0xF2F0EA};
    const LabelledTiles check{.size = 256, .tiles = 4, .colors = stripes, .joint = 0x2E2C2A, .seed = 3};
    Material veil = textured("veil", addTexture(scene, labelledTiles("veil", check)), 0.6F);
    veil.baseColor.w = 0.6F;
    veil.blended = true;
    veil.alphaCutoff = blendCutoff;
    veil.doubleSided = true;
    place(scene, "veil", addMaterial(scene, veil), uprightPane());
    scene.instances.back().node = addSlidingNode(scene, {-1.2F, 1.0F, 0.2F}, {1.2F, 1.0F, 0.2F}, 1.0F);
    const uint32_t red = addMaterial(scene, plain("red", {0xC73A2B, 0.5F}));
    place(scene, "ball", red, sphere(0.3F, 24));
    scene.instances.back().node = addSlidingNode(scene, {1.0F, 0.9F, -0.8F}, {-1.0F, 0.9F, -0.8F}, 1.0F);
    return scene;
}

std::optional<Scene> makeMotionScene(std::string_view name) {
    static constexpr std::array<std::pair<std::string_view, Scene (*)()>, 10> scenes{
        {{"motion-room", makeMotionRoom},
         {"motion-rods", makeMotionRods},
         {"motion-leaves", makeMotionLeaves},
         {"motion-mirror", makeMotionMirror},
         {"motion-lamp", makeMotionLamp},
         {"motion-lamp-off", makeMotionLampOff},
         {"motion-figures", makeMotionFigures},
         {"motion-instances", makeMotionInstances},
         {"motion-glass", makeMotionGlass},
         {"motion-blended", makeMotionBlended}}};
    const auto* found = std::ranges::find(scenes, name, &std::pair<std::string_view, Scene (*)()>::first);
    return found == scenes.end() ? std::nullopt : std::optional(found->second());
}

}  // namespace reflet::builtin
