// Helpers to assemble a built-in scene.
#include "scene/builtin/assemble.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace reflet::builtin {

TextureSlot addTexture(Scene& scene, TextureImage image, const Sampler& sampler) {
    TextureSlot slot;
    slot.image = static_cast<int32_t>(scene.images.size());
    scene.images.push_back(std::move(image));
    const auto known = std::find(scene.samplers.begin(), scene.samplers.end(), sampler);
    slot.sampler = static_cast<int32_t>(known - scene.samplers.begin());
    if (known == scene.samplers.end()) {
        scene.samplers.push_back(sampler);
    }
    return slot;
}

Material plain(std::string name, const Plain& p) {
    Material m;
    m.name = std::move(name);
    m.baseColor = vec4(linear(p.color), 1.0F);
    m.roughness = p.roughness;
    m.metallic = p.metallic;
    return m;
}

Material textured(std::string name, const TextureSlot& colors, float roughness, float metallic) {
    Material m = plain(std::move(name), {0xFFFFFF, roughness, metallic});
    m.baseColorTexture = colors;
    return m;
}

uint32_t addMaterial(Scene& scene, Material material) {
    scene.materials.push_back(std::move(material));
    return static_cast<uint32_t>(scene.materials.size() - 1);
}

uint32_t addMesh(Scene& scene, std::string name, uint32_t material, Mesh mesh) {
    mesh.name = std::move(name);
    mesh.material = material;
    scene.meshes.push_back(std::move(mesh));
    return static_cast<uint32_t>(scene.meshes.size() - 1);
}

void place(Scene& scene, std::string name, uint32_t mesh, const mat4& objectToWorld) {
    scene.instances.push_back({std::move(name), mesh, objectToWorld});
}

void place(Scene& scene, const std::string& name, uint32_t material, Mesh mesh, const mat4& objectToWorld) {
    place(scene, name, addMesh(scene, name, material, std::move(mesh)), objectToWorld);
}

mat4 at(const vec3& position) {
    return glm::translate(mat4(1.0F), position);
}

mat4 turned(float degrees, const vec3& axis) {
    return glm::rotate(mat4(1.0F), glm::radians(degrees), glm::normalize(axis));
}

mat4 between(const vec3& from, const vec3& to) {
    const vec3 y = glm::normalize(to - from);
    const vec3 aside = std::abs(y.y) < 0.9F ? vec3(0, 1, 0) : vec3(0, 0, 1);
    const vec3 x = glm::normalize(glm::cross(aside, y));
    return {vec4(x, 0), vec4(y, 0), vec4(glm::cross(x, y), 0), vec4(from, 1)};
}

Camera camera(std::string name, const vec3& position, const vec3& target, float fovYDegrees) {
    Camera c;
    c.name = std::move(name);
    c.position = position;
    c.target = target;
    c.fovY = glm::radians(fovYDegrees);
    return c;
}

Sun sun(const vec3& direction, const vec3& irradiance) {
    Sun s;
    s.direction = glm::normalize(direction);
    s.irradiance = irradiance;
    return s;
}

}  // namespace reflet::builtin
