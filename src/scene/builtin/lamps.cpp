// A walled courtyard at night with a hundred lamps: lanterns of short range along its walls and its path, and spot
// lights over sculptures. Only the eight spot lights, which are the strongest, have shadow casters in their range.
#include "scene/builtin/assemble.h"
#include "scene/builtin/patterns.h"
#include "scene/builtin/scenes.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace reflet::builtin {
namespace {

constexpr vec3 court{4.6F, 1.6F, 9.5F};  // half size, metres; the ground is at y = 0
constexpr float glass = 0.05F;           // radius of a lantern

constexpr std::array<Hex, 5> hues{0xFFB347, 0xFF5A4E, 0xD24BE0, 0x4C6FFF, 0x35D0B4};

// Light of a hue in 0..1; the largest of red, green and blue is 1.
vec3 hue(float at) {
    const float place = at * static_cast<float>(hues.size() - 1);
    const auto first = std::min(static_cast<size_t>(place), hues.size() - 2);
    const vec3 color = glm::mix(linear(hues[first]), linear(hues[first + 1]), place - static_cast<float>(first));
    return color / std::max({color.x, color.y, color.z});
}

/// Lanterns of the same hue share a mesh.
class Lanterns {
public:
    explicit Lanterns(Scene& scene) : scene_(scene) {
        for (size_t i = 0; i < meshes_.size(); ++i) {
            Material m = plain("lantern " + std::to_string(i), {0x000000, 0.9F});
            m.emissive = 3.0F * hue(shade(i));
            meshes_[i] = addMesh(scene, m.name, addMaterial(scene, m), sphere(glass, 12));
        }
    }

    void add(const vec3& position, float color, float intensity, float range) {
        const auto step = static_cast<size_t>(std::lround(color * static_cast<float>(meshes_.size() - 1)));
        const std::string name = "lantern " + std::to_string(scene_.lamps.size());
        place(scene_, name, meshes_[step], at(position));
        Lamp lamp;
        lamp.name = name;
        lamp.position = position;
        lamp.intensity = intensity * hue(shade(step));
        lamp.range = range;
        lamp.radius = glass;
        scene_.lamps.push_back(lamp);
    }

private:
    [[nodiscard]] float shade(size_t i) const { return static_cast<float>(i) / static_cast<float>(meshes_.size() - 1); }

    Scene& scene_;
    std::array<uint32_t, 17> meshes_{};
};

void addCourt(Scene& scene) {
    Material paving =
        textured("paving", addTexture(scene, pavingColors("paving", 512, 0x8C8984, 0x7B746C, 0x4A4744)), 0.45F);
    paving.normalTexture = addTexture(scene, pavingNormals("paving relief", 512, 2.5F));
    place(scene, "ground", addMaterial(scene, paving),
          ground({court.x + 0.3F, court.z + 0.3F}, {4, 8}, {court.x / 1.25F, court.z / 1.25F}));
    const uint32_t plaster = addMaterial(scene, plain("plaster", {0xB9AF9F, 0.85F}));
    const Mesh side = box({0.15F, court.y, court.z + 0.3F});
    place(scene, "left wall", plaster, side, at({-court.x - 0.15F, court.y, 0}));
    place(scene, "right wall", plaster, side, at({court.x + 0.15F, court.y, 0}));
    const Mesh end = box({court.x, court.y, 0.15F});
    place(scene, "back wall", plaster, end, at({0, court.y, -court.z - 0.15F}));
    place(scene, "front wall", plaster, end, at({0, court.y, court.z + 0.15F}));
}

// Rows along the walls at chest height, and on the ground along the path.
void addLanterns(Scene& scene) {
    Lanterns lanterns(scene);
    for (int i = 0; i < 20; ++i) {
        const float along = static_cast<float>(i) / 19.0F;
        const float z = court.z - 0.5F - along * (2.0F * court.z - 1.0F);
        lanterns.add({0.45F - court.x, 1.25F, z}, along, 0.9F, 1.6F);
        lanterns.add({court.x - 0.45F, 1.25F, z}, 1.0F - along, 0.9F, 1.6F);
    }
    for (int i = 0; i < 22; ++i) {
        const float z = court.z - 0.6F - 0.85F * static_cast<float>(i);
        const float along = std::abs(static_cast<float>(i) / 10.5F - 1.0F);
        lanterns.add({-0.9F, 0.14F, z}, along, 0.16F, 0.8F);
        lanterns.add({0.9F, 0.14F, z}, along, 0.16F, 0.8F);
    }
    for (int i = 0; i < 8; ++i) {
        lanterns.add({-3.15F + 0.9F * static_cast<float>(i), 1.7F, 0.35F - court.z}, static_cast<float>(i) / 7.0F, 0.9F,
                     1.4F);
    }
}

uint32_t sculpture(Scene& scene, int index) {
    static constexpr std::array<vec2, 7> vase{vec2(0, 0),        vec2(0.14F, 0),    vec2(0.28F, 0.3F),
                                              vec2(0.24F, 0.6F), vec2(0.1F, 0.75F), vec2(0.15F, 0.9F),
                                              vec2(0, 0.9F)};
    const uint32_t material =
        addMaterial(scene, plain("sculpture " + std::to_string(index),
                                 index % 2 == 0 ? Plain{0xD9D4C8, 0.35F} : Plain{0xE2B36A, 0.3F, 1.0F}));
    Mesh mesh;
    switch (index % 4) {
        case 0:
            mesh = lathe(vase, 40);
            break;
        case 1:
            append(mesh, sphere(0.32F, 40), at({0, 0.32F, 0}));
            break;
        case 2:
            append(mesh, roundedBox(vec3(0.24F), 0.05F, 4), at({0, 0.36F, 0}) * turned(45, {1, 0, 0}));
            break;
        default:
            append(mesh, cylinder(0.2F, 0.8F, 40), mat4(1.0F));
            break;
    }
    finish(mesh);
    return addMesh(scene, "sculpture " + std::to_string(index), material, mesh);
}

// Four beams over the courtyard, two spot lights under each, a sculpture under each light.
void addSculptures(Scene& scene) {
    const uint32_t stone = addMaterial(scene, plain("plinth", {0x9A958C, 0.7F}));
    const uint32_t wood = addMaterial(scene, plain("beam", {0x5A4030, 0.8F}));
    const uint32_t plinth = addMesh(scene, "plinth", stone, box({0.3F, 0.25F, 0.3F}));
    const uint32_t beam = addMesh(scene, "beam", wood, box({court.x, 0.08F, 0.08F}, 0.5F));
    for (int i = 0; i < 8; ++i) {
        const int row = i / 2;
        const float x = i % 2 == 0 ? -2.2F : 2.2F;
        const float z = 4.2F - 3.6F * static_cast<float>(row);
        const std::string number = std::to_string(i);
        place(scene, "plinth " + number, plinth, at({x, 0.25F, z}));
        place(scene, "sculpture " + number, sculpture(scene, i), at({x, 0.5F, z}));
        if (i % 2 == 0) {
            place(scene, "beam " + number, beam, at({0, 2.0F * court.y - 0.08F, z + 0.8F}));
        }
        Lamp lamp;
        lamp.name = "spot " + number;
        lamp.type = Lamp::Type::spot;
        lamp.position = {0.8F * x, 2.0F * court.y - 0.2F, z + 0.8F};
        lamp.direction = glm::normalize(vec3(x, 0.4F, z) - lamp.position);
        lamp.intensity = vec3(14.0F, 12.5F, 10.5F);
        lamp.range = 6.0F;
        lamp.innerAngle = glm::radians(12.0F);
        lamp.outerAngle = glm::radians(20.0F);
        lamp.radius = 0.03F;
        scene.lamps.push_back(lamp);
    }
}

}  // namespace

Scene makeLamps() {
    Scene scene;
    scene.name = "lamps";
    addCourt(scene);
    addLanterns(scene);
    addSculptures(scene);
    scene.cameras.push_back(camera("main", {-0.6F, 2.3F, 9.0F}, {0.1F, 0.7F, 0.0F}, 55));
    scene.sun = sun({-0.5F, -0.7F, -0.35F}, {0.05F, 0.07F, 0.12F});
    scene.environment.radiance = {0.006F, 0.01F, 0.022F};
    return scene;
}

}  // namespace reflet::builtin
