// A Cornell box: white room, red and green wall, two blocks. The sun shines in through the open front; the rest is lit
// indirectly.
#include "scene/builtin/assemble.h"
#include "scene/builtin/scenes.h"

namespace reflet::builtin {
namespace {

constexpr vec3 boxHalf{3.0F, 2.0F, 2.25F};  // half size, metres; the floor is at y = 0
constexpr float wall = 0.1F;                // half thickness

void addCornellBox(Scene& scene, uint32_t white, uint32_t red, uint32_t green) {
    const vec3 middle(0, boxHalf.y, 0);
    const float depth = boxHalf.z + wall;
    const Mesh slab = box({boxHalf.x + 2 * wall, wall, depth});
    place(scene, "floor", white, slab, at({0, -wall, -wall}));
    place(scene, "ceiling", white, slab, at({0, 2 * boxHalf.y + wall, -wall}));
    place(scene, "back wall", white, box({boxHalf.x, boxHalf.y, wall}), at(middle - vec3(0, 0, boxHalf.z + wall)));
    place(scene, "left wall", red, box({wall, boxHalf.y, depth}), at(middle + vec3(-boxHalf.x - wall, 0, -wall)));
    place(scene, "right wall", green, box({wall, boxHalf.y, depth}), at(middle + vec3(boxHalf.x + wall, 0, -wall)));
}

/// A spot light near the ceiling, aimed at the wall that the sun does not reach, clear of the blocks.
Lamp wallLamp() {
    Lamp lamp;
    lamp.name = "wall lamp";
    lamp.type = Lamp::Type::spot;
    lamp.position = {0.9F, 3.75F, 0.6F};
    lamp.direction = glm::normalize(vec3(2.95F, 2.0F, -0.5F) - lamp.position);
    lamp.intensity = vec3(16.0F, 15.0F, 13.5F);
    lamp.range = 6.0F;
    lamp.innerAngle = glm::radians(8.0F);
    lamp.outerAngle = glm::radians(38.0F);
    return lamp;
}

}  // namespace

Scene makeCornell() {
    Scene scene;
    scene.name = "cornell";
    const uint32_t white = addMaterial(scene, plain("white", {0xE6E1D8, 0.95F}));
    const uint32_t red = addMaterial(scene, plain("red", {0xC2321F, 0.95F}));
    const uint32_t green = addMaterial(scene, plain("green", {0x3F9A35, 0.95F}));
    addCornellBox(scene, white, red, green);
    place(scene, "tall block", white, box({0.62F, 1.25F, 0.62F}), at({-1.05F, 1.25F, -0.75F}) * turned(18));
    place(scene, "short block", white, box({0.62F, 0.62F, 0.62F}), at({1.1F, 0.62F, 0.35F}) * turned(-17));
    scene.lamps.push_back(wallLamp());

    scene.cameras.push_back(camera("main", {0, 2.0F, 5.65F}, {0, 1.95F, 0}, 52));
    scene.sun = sun({-0.50F, -0.64F, -0.58F}, {5.2F, 4.9F, 4.4F});
    return scene;
}

}  // namespace reflet::builtin
