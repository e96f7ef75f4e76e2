// An animated room, from time 0 on: a box that slides and stops at 1 s, a rotating cube, a bending tube. One half of
// the floor is glossy, the other a mirror. The animation repeats after 4 s.
#include "scene/builtin/animate.h"
#include "scene/builtin/assemble.h"
#include "scene/builtin/patterns.h"
#include "scene/builtin/scenes.h"

#include <algorithm>
#include <array>

namespace reflet::builtin {
namespace {

constexpr vec3 room{3.0F, 1.5F, 2.5F};  // half size, metres; the floor is at y = 0, front and top are open

void addTiledRoom(Scene& scene) {
    static constexpr std::array<Hex, 4> wallColors{0xE9DDC6, 0xDDB98A, 0xC96F4A, 0x7E9C93};
    const LabelledTiles wall{
        .size = 1024, .tiles = 8, .colors = wallColors, .joint = 0x544A40, .letters = 0x33291F, .seed = 21};
    const uint32_t tiled =
        addMaterial(scene, textured("wall tiles", addTexture(scene, labelledTiles("wall tiles", wall)), 0.85F));
    static constexpr std::array<Hex, 3> floorColors{0x8E9AA3, 0x6C7A86, 0xA9A294};
    const LabelledTiles floor{
        .size = 1024, .tiles = 6, .colors = floorColors, .joint = 0x2E2C2A, .letters = 0x23303A, .seed = 8};
    const uint32_t glossy =
        addMaterial(scene, textured("glossy floor", addTexture(scene, labelledTiles("floor tiles", floor)), 0.25F));
    const uint32_t mirror = addMaterial(scene, plain("mirror floor", {0xE4E7E9, 0.0F, 1.0F}));
    const Mesh half = ground({0.5F * room.x, room.z}, {4, 6}, {1.0F, 5.0F / 3.0F});
    place(scene, "glossy floor", glossy, half, at({-0.5F * room.x, 0, 0}));
    place(scene, "mirror floor", mirror, half, at({0.5F * room.x, 0, 0}));
    place(scene, "back wall", tiled,
          patch({{0, room.y, -room.z}, {room.x, 0, 0}, {0, room.y, 0}, {6, 3}, {1.0F, 0.5F}}));
    const uint32_t red = addMaterial(scene, plain("red plaster", {0xB9523F, 0.9F}));
    const uint32_t green = addMaterial(scene, plain("green plaster", {0x5F8F6B, 0.9F}));
    place(scene, "left wall", red, patch({{-room.x, room.y, 0}, {0, 0, -room.z}, {0, room.y, 0}, {4, 2}, {1, 1}}));
    place(scene, "right wall", green, patch({{room.x, room.y, 0}, {0, 0, room.z}, {0, room.y, 0}, {4, 2}, {1, 1}}));
}

// Along x across both halves of the floor, at 2.4 m/s; at rest from 1 s on.
void addSlidingBox(Scene& scene) {
    const int32_t node = addNode(scene, {-1.4, 0.35, 0.9});
    animate(scene, node,
            {.target = Channel::Target::translation,
             .interpolation = Interpolation::linear,
             .times = {0.0F, 1.0F},
             .values = {vec4(-1.4F, 0.35F, 0.9F, 0), vec4(1.0F, 0.35F, 0.9F, 0)}});
    const uint32_t blue = addMaterial(scene, plain("blue", {0x2B5FB0, 0.5F}));
    place(scene, "sliding box", blue, roundedBox(vec3(0.35F), 0.05F, 3), at({-1.4F, 0.35F, 0.9F}));
    scene.instances.back().node = node;
}

// A quarter turn per second, above the glossy floor.
void addTurningCube(Scene& scene) {
    const int32_t node = addNode(scene, {-1.7, 1.0, -1.2});
    Channel channel{.target = Channel::Target::rotation,
                    .interpolation = Interpolation::linear,
                    .times = {0.0F, 1.0F, 2.0F, 3.0F, 4.0F},
                    .values = {}};
    for (const float time : channel.times) {
        channel.values.push_back(rotation(90.0 * time, {0, 1, 0}));
    }
    animate(scene, node, std::move(channel));
    const auto board = addTexture(scene, emblem("emblem", "F", 0x8A2F2F, 0xF2E3C4, 0xF8F1E0));
    place(scene, "turning cube", addMaterial(scene, textured("emblem", board, 0.6F)), box(vec3(0.45F)),
          at({-1.7F, 1.0F, -1.2F}));
    scene.instances.back().node = node;
}

constexpr int tubeJoints = 4;
constexpr float tubeHeight = 1.8F;
constexpr float tubeStep = tubeHeight / tubeJoints;

Mesh tube() {
    constexpr int rings = 48;
    std::vector<vec2> outline{vec2(0.0F)};
    for (int i = 0; i <= rings; ++i) {
        outline.emplace_back(0.17F, tubeHeight * static_cast<float>(i) / rings);
    }
    outline.emplace_back(0.0F, tubeHeight);
    Mesh mesh = lathe(outline, 32);
    for (const vec3& p : mesh.positions) {  // linear blend between the centres of neighbouring joints' segments
        const float place = glm::clamp(p.y / tubeStep - 0.5F, 0.0F, float(tubeJoints - 1));
        const auto below = std::min(static_cast<uint16_t>(place), uint16_t(tubeJoints - 2));
        const float share = place - static_cast<float>(below);
        mesh.addSkin(std::array{JointWeight{below, 1.0F - share}, JointWeight{below + 1U, share}});
    }
    return mesh;
}

// On the mirror floor. Each of its joints swings to both sides.
void addBendingTube(Scene& scene) {
    const glm::dvec3 foot(1.6, 0.0, -1.1);
    Skin skin;
    for (int i = 0; i < tubeJoints; ++i) {
        const int32_t parent = i == 0 ? -1 : static_cast<int32_t>(skin.joints.back());
        const int32_t node = addNode(scene, i == 0 ? foot : glm::dvec3(0, tubeStep, 0), parent);
        skin.joints.push_back(static_cast<uint32_t>(node));
        skin.inverseBind.push_back(at({0, -tubeStep * static_cast<float>(i), 0}));
        if (i == 0) {
            continue;  // fixed to the floor
        }
        Channel channel{.target = Channel::Target::rotation,
                        .interpolation = Interpolation::cubicSpline,
                        .times = {0.0F, 1.0F, 3.0F, 4.0F},
                        .values = {}};
        for (const double degrees : {0.0, 24.0, -24.0, 0.0}) {
            const vec4 speed = degrees == 0.0 ? vec4(0, 0, 0.35F, 0) : vec4(0.0F);
            channel.values.insert(channel.values.end(), {speed, rotation(degrees, {0, 0, 1}), speed});
        }
        animate(scene, node, std::move(channel));
    }
    scene.skins.push_back(std::move(skin));
    const uint32_t yellow = addMaterial(scene, plain("yellow", {0xE9B437, 0.55F}));
    place(scene, "bending tube", yellow, tube(), at(vec3(foot)));
    scene.instances.back().skin = 0;
}

}  // namespace

Scene makeMoving() {
    Scene scene;
    scene.name = "moving";
    addTiledRoom(scene);
    addSlidingBox(scene);
    addTurningCube(scene);
    addBendingTube(scene);
    scene.cameras.push_back(camera("main", {0.0F, 1.9F, 5.2F}, {0.0F, 0.75F, -0.3F}, 45));
    scene.sun = sun({0.35F, -0.8F, -0.5F}, {4.4F, 4.1F, 3.6F});
    scene.environment.radiance = {0.32F, 0.4F, 0.52F};
    return scene;
}

}  // namespace reflet::builtin
