// Scenes of `reflet bench --motions` whose room is all around the camera, or whose light changes.
#include "scene/builtin/animate.h"
#include "scene/builtin/assemble.h"
#include "scene/builtin/motion_scenes.h"
#include "scene/builtin/patterns.h"

#include <array>

namespace reflet::builtin {
namespace {

constexpr vec3 motionRoom{3.0F, 1.4F, 3.0F};  // half size, metres; the floor is at y = 0

uint32_t roomTiles(Scene& scene, const std::string& name, uint32_t seed, std::span<const Hex> colors, float roughness) {
    const LabelledTiles tiles{
        .size = 512, .tiles = 8, .colors = colors, .joint = 0x544A40, .letters = 0x33291F, .seed = seed};
    return addMaterial(scene, textured(name, addTexture(scene, labelledTiles(name, tiles)), roughness));
}

void addRoomThings(Scene& scene) {
    const uint32_t red = addMaterial(scene, plain("red", {0xC73A2B, 0.5F}));
    const uint32_t blue = addMaterial(scene, plain("blue", {0x2B5FB0, 0.5F}));
    const uint32_t yellow = addMaterial(scene, plain("yellow", {0xE9B437, 0.6F}));
    const uint32_t gold = addMaterial(scene, plain("gold", {0xF2C66E, 0.2F, 1.0F}));
    place(scene, "red ball", red, sphere(0.45F, 32), at({0.9F, 0.45F, -1.7F}));
    place(scene, "blue box", blue, roundedBox({0.3F, 0.6F, 0.3F}, 0.05F, 2), at({-1.1F, 0.6F, -2.0F}) * turned(25));
    place(scene, "gold ball", gold, sphere(0.5F, 32), at({-2.0F, 0.5F, 0.4F}));
    place(scene, "yellow drum", yellow, cylinder(0.4F, 1.0F, 24), at({2.0F, 0, 0.6F}));
    place(scene, "blue ball", blue, sphere(0.4F, 32), at({0.7F, 0.4F, 2.0F}));
    const uint32_t post = addMesh(scene, "post", red, cylinder(0.06F, 2.2F, 12));
    for (const vec3& foot : {vec3(2.1F, 0, -1.2F), vec3(-0.3F, 0, 2.2F), vec3(-1.9F, 0, -0.9F)}) {
        place(scene, "post", post, at(foot));
    }
}

// Lit from above by a weak sky; the lamps of the scene are to be seen.
void addEvening(Scene& scene) {
    scene.sun = sun({0.2F, -1.0F, -0.2F}, vec3(0.0F));
    scene.environment.radiance = vec3(0.02F, 0.025F, 0.035F);
}

Lamp roomLamp(const vec3& position) {
    Lamp lamp;
    lamp.name = "lamp";
    lamp.position = position;
    lamp.intensity = vec3(12.0F, 10.4F, 8.4F);
    lamp.radius = 0.05F;
    return lamp;
}

// A room of 6 x 6 m, open at the top: four walls of labelled tiles, a floor that is glossy at the left.
void addMotionRoom(Scene& scene) {
    static constexpr std::array<Hex, 4> warm{0xE9DDC6, 0xDDB98A, 0xC96F4A, 0x7E9C93};
    static constexpr std::array<Hex, 3> cool{0x8E9AA3, 0x6C7A86, 0xA9A294};
    const uint32_t walls = roomTiles(scene, "wall tiles", 21, warm, 0.85F);
    const uint32_t others = roomTiles(scene, "other wall tiles", 5, cool, 0.85F);
    const uint32_t glossy = roomTiles(scene, "glossy floor", 8, cool, 0.2F);
    const uint32_t matt = roomTiles(scene, "matt floor", 9, cool, 0.7F);
    const vec3& r = motionRoom;
    const Mesh half = ground({0.5F * r.x, r.z}, {3, 6}, {0.5F, 1.0F});
    place(scene, "glossy floor", glossy, half, at({-0.5F * r.x, 0, 0}));
    place(scene, "matt floor", matt, half, at({0.5F * r.x, 0, 0}));
    place(scene, "back wall", walls, patch({{0, r.y, -r.z}, {r.x, 0, 0}, {0, r.y, 0}, {6, 3}, {1, 0.5F}}));
    place(scene, "front wall", walls, patch({{0, r.y, r.z}, {-r.x, 0, 0}, {0, r.y, 0}, {6, 3}, {1, 0.5F}}));
    place(scene, "left wall", others, patch({{-r.x, r.y, 0}, {0, 0, -r.z}, {0, r.y, 0}, {6, 3}, {1, 0.5F}}));
    place(scene, "right wall", others, patch({{r.x, r.y, 0}, {0, 0, r.z}, {0, r.y, 0}, {6, 3}, {1, 0.5F}}));
}

}  // namespace

Scene makeMotionRoom() {
    Scene scene;
    scene.name = "motion-room";
    addMotionRoom(scene);
    addRoomThings(scene);
    scene.cameras.push_back(camera("main", {0.1F, 1.3F, 0.2F}, {0.4F, 1.0F, -2.0F}, 55));
    scene.sun = sun({0.45F, -0.8F, -0.35F}, {4.4F, 4.1F, 3.6F});
    scene.environment.radiance = {0.32F, 0.4F, 0.52F};
    return scene;
}

Scene makeMotionMirror() {
    Scene scene = makeMotionRoom();
    scene.name = "motion-mirror";
    const uint32_t glass = addMaterial(scene, plain("mirror", {0xEDEFF0, 0.0F, 1.0F}));
    place(scene, "mirror", glass, patch({{0, 0, 0}, {0.8F, 0, 0}, {0, 0.7F, 0}, {1, 1}, {1, 1}}));
    const int32_t node = addTurningNode(scene, {0.0F, 1.0F, -2.0F}, {0, 1, 0}, 72.0F, 1.0F);
    scene.instances.back().node = node;
    scene.cameras.front() = camera("main", {0.0F, 1.2F, 1.4F}, {0.0F, 0.95F, -2.0F}, 50);
    return scene;
}

Scene makeMotionLamp() {
    Scene scene;
    scene.name = "motion-lamp";
    addMotionRoom(scene);
    addRoomThings(scene);
    addEvening(scene);
    Lamp lamp = roomLamp({-1.6F, 1.9F, -0.9F});
    lamp.node = addSlidingNode(scene, lamp.position, {1.6F, 1.9F, -0.9F}, 1.0F);
    scene.lamps.push_back(lamp);
    scene.cameras.push_back(camera("main", {0.0F, 1.6F, 1.9F}, {0.0F, 0.8F, -1.5F}, 55));
    return scene;
}

// The lamp is behind a partition at the right: what is seen at the left is lit by the walls alone.
Scene makeMotionLampOff() {
    Scene scene;
    scene.name = "motion-lamp-off";
    addMotionRoom(scene);
    addRoomThings(scene);
    addEvening(scene);
    const uint32_t white = addMaterial(scene, plain("partition", {0xD8D4CC, 0.8F}));
    place(scene, "partition", white, box({0.05F, motionRoom.y, 0.9F}), at({0.35F, motionRoom.y, -0.4F}));
    scene.lamps.push_back(roomLamp({1.5F, 2.0F, -0.6F}));
    Lamp second = roomLamp({-2.4F, 2.2F, -2.4F});
    second.name = "weak lamp";
    second.intensity *= 0.15F;
    scene.lamps.push_back(second);
    scene.cameras.push_back(camera("main", {0.0F, 1.6F, 1.9F}, {0.0F, 0.9F, -1.5F}, 60));
    return scene;
}

}  // namespace reflet::builtin
