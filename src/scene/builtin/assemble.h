// Helpers to assemble a built-in scene. Functions that add something return its index.
#pragma once

#include "scene/builtin/canvas.h"
#include "scene/builtin/shapes.h"

#include <string>

namespace reflet::builtin {

TextureSlot addTexture(Scene& scene, TextureImage image, const Sampler& sampler = {});

/// A surface of one colour.
struct Plain {
    Hex color = 0xFFFFFF;
    float roughness = 0.9F;
    float metallic = 0.0F;
};
Material plain(std::string name, const Plain& p);

/// A material whose base colour is an image.
Material textured(std::string name, const TextureSlot& colors, float roughness, float metallic = 0.0F);

uint32_t addMaterial(Scene& scene, Material material);
uint32_t addMesh(Scene& scene, std::string name, uint32_t material, Mesh mesh);
void place(Scene& scene, std::string name, uint32_t mesh, const mat4& objectToWorld = mat4(1.0F));

/// Adds a mesh with a single instance.
void place(Scene& scene, const std::string& name, uint32_t material, Mesh mesh, const mat4& objectToWorld = mat4(1.0F));

mat4 at(const vec3& position);
mat4 turned(float degrees, const vec3& axis = {0, 1, 0});

/// Rotates and translates a shape that stands on the origin along +Y so that it reaches from one point towards another.
mat4 between(const vec3& from, const vec3& to);

Camera camera(std::string name, const vec3& position, const vec3& target, float fovYDegrees);
Sun sun(const vec3& direction, const vec3& irradiance);

}  // namespace reflet::builtin
