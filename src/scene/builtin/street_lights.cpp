// Lamps of the built-in scene "street": posts whose lanterns light the road, a string of bulbs, a traffic light.
#include "scene/builtin/assemble.h"
#include "scene/builtin/street.h"

#include <array>
#include <cmath>

namespace reflet::builtin::street {
namespace {

constexpr float postHeight = 4.6F;
constexpr float reach = 1.15F;  // of the arm over the road
constexpr float lensRadius = 0.14F;

Mesh postMesh() {
    Mesh mesh;
    static constexpr std::array<vec2, 7> foot{vec2(0, 0),        vec2(0.17F, 0),      vec2(0.17F, 0.12F),
                                              vec2(0.1F, 0.22F), vec2(0.085F, 0.75F), vec2(0.055F, 0.85F),
                                              vec2(0.045F, 1.0F)};
    append(mesh, lathe(foot, 20), mat4(1.0F));
    std::vector<vec3> line{vec3(0, 0.95F, 0), vec3(0, postHeight - 0.8F, 0)};
    for (int i = 0; i <= 10; ++i) {
        const float a = 0.5F * pi * static_cast<float>(i) / 10.0F;
        line.emplace_back(reach * (1.0F - std::cos(a)), postHeight - 0.75F + 0.75F * std::sin(a), 0);
    }
    append(mesh, tube(line, 0.042F, 12), mat4(1.0F));
    static constexpr std::array<vec2, 6> shade{vec2(0.26F, -0.16F), vec2(0.2F, -0.02F), vec2(0.1F, 0.06F),
                                               vec2(0.05F, 0.12F),  vec2(0.03F, 0.17F), vec2(0, 0.18F)};
    append(mesh, lathe(shade, 24), at({reach, postHeight - 0.05F, 0}));
    return mesh;
}

void addPosts(Scene& scene) {
    Material painted = plain("lamp post", {0x1C2422, 0.3F});
    painted.doubleSided = true;
    const uint32_t post = addMesh(scene, "lamp post", addMaterial(scene, painted), postMesh());
    const vec3 warm(1.0F, 0.66F, 0.32F);
    const uint32_t lens =
        addMesh(scene, "lamp lens", addGlow(scene, "lamp lens", 26.0F * warm), sphere(lensRadius, 20));
    static constexpr std::array<vec2, 5> places{vec2(1, -1.0F), vec2(-1, -9.5F), vec2(1, -17.5F), vec2(-1, -26.5F),
                                                vec2(1, -36.0F)};
    for (size_t i = 0; i < places.size(); ++i) {
        const vec2 p = places.at(i);
        const std::string name = std::to_string(i);
        const vec3 foot(p.x * (roadHalf + 0.42F), pavementY, p.y);
        place(scene, "lamp post " + name, post, at(foot) * turned(p.x > 0.0F ? 180.0F : 0.0F));
        const vec3 light = foot + vec3(-p.x * reach, postHeight - 0.18F, 0);
        place(scene, "lamp lens " + name, lens, at(light));
        Lamp lamp;
        lamp.name = "street lamp " + name;
        lamp.type = Lamp::Type::spot;
        lamp.position = light;
        lamp.direction = glm::normalize(vec3(-0.12F * p.x, -1.0F, 0));
        lamp.intensity = 95.0F * warm;
        lamp.range = 14.0F;
        lamp.innerAngle = glm::radians(35.0F);
        lamp.outerAngle = glm::radians(72.0F);
        lamp.radius = lensRadius;
        scene.lamps.push_back(lamp);
    }
}

// Over the street, in the distance.
void addBulbs(Scene& scene) {
    static constexpr std::array<vec3, 4> colors{vec3(1.0F, 0.6F, 0.25F), vec3(1.0F, 0.25F, 0.15F),
                                                vec3(0.3F, 0.9F, 0.6F), vec3(0.35F, 0.55F, 1.0F)};
    std::array<uint32_t, colors.size()> bulbs{};
    for (size_t i = 0; i < colors.size(); ++i) {
        const std::string name = "bulb " + std::to_string(i);
        bulbs.at(i) = addMesh(scene, name, addGlow(scene, name, 22.0F * colors.at(i)), sphere(0.045F, 10));
    }
    const uint32_t cord = addMaterial(scene, plain("cord", {0x141414, 0.6F}));
    for (int s = 0; s < 4; ++s) {
        const float z = -12.0F - 4.6F * static_cast<float>(s);
        const vec3 from(-frontX, 5.9F, z);
        const vec3 to(frontX, 5.6F, z - 1.5F);
        place(scene, "cord " + std::to_string(s), cord, cable(from, to, 0.9F, 0.012F));
        for (int i = 1; i < 16; ++i) {
            const float t = static_cast<float>(i) / 16.0F;
            const vec3 p = glm::mix(from, to, t) - vec3(0, 3.6F * t * (1.0F - t) + 0.06F, 0);
            place(scene, "bulb", bulbs.at(static_cast<size_t>(i + s) % bulbs.size()), at(p));
        }
    }
}

void addTrafficLight(Scene& scene) {
    Mesh body;
    append(body, cylinder(0.06F, 3.0F, 16), mat4(1.0F));
    append(body, roundedBox({0.16F, 0.46F, 0.13F}, 0.04F, 2), at({0, 3.2F, 0.05F}));
    for (int i = 0; i < 3; ++i) {
        append(body, cylinder(0.12F, 0.1F, 20),
               at({0, 3.5F - 0.3F * static_cast<float>(i), 0.1F}) * turned(90, {1, 0, 0}));
    }
    const uint32_t dark = addMaterial(scene, plain("traffic light", {0x202322, 0.35F}));
    const uint32_t mesh = addMesh(scene, "traffic light", dark, body);
    const uint32_t on =
        addMesh(scene, "green light", addGlow(scene, "green light", {0.6F, 13.0F, 5.5F}), sphere(0.1F, 20));
    for (const float s : {-1.0F, 1.0F}) {
        const mat4 foot = at({s * (roadHalf + 0.35F), pavementY, -31.0F});
        place(scene, "traffic light", mesh, foot);
        place(scene, "green light", on, foot * at({0, 2.9F, 0.16F}));
    }
}

}  // namespace

void addLights(Scene& scene) {
    addPosts(scene);
    addBulbs(scene);
    addTrafficLight(scene);
}

}  // namespace reflet::builtin::street
