// A grotto in closed rock with one shaft to the sky: the sun draws a patch on the ground, and everything else in the
// picture is lit by that patch.
#include "scene/builtin/assemble.h"
#include "scene/builtin/noise.h"
#include "scene/builtin/patterns.h"
#include "scene/builtin/scenes.h"
#include "scene/builtin/surface_nets.h"

#include <array>
#include <cmath>

namespace reflet::builtin {
namespace {

const vec3 sunDirection = glm::normalize(vec3(-0.30F, -0.90F, -0.28F));
constexpr vec3 patchCenter{-0.9F, 0.0F, -1.6F};  // where the shaft's axis meets the ground

float smoothMin(float a, float b, float width) {
    const float h = std::max(width - std::abs(a - b), 0.0F) / width;
    return std::min(a, b) - h * h * width * 0.25F;
}

float smoothMax(float a, float b, float width) { return -smoothMin(-a, -b, width); }

/// Nearly the distance to an ellipsoid.
float ellipsoid(const vec3& p, const vec3& center, const vec3& radii) {
    const vec3 q = (p - center) / radii;
    const float k = glm::length(q);
    return k * (k - 1.0F) / std::max(glm::length(q / radii), 1e-4F);
}

float capsule(const vec3& p, const vec3& a, const vec3& b, float radius) {
    const vec3 ab = b - a;
    const float t = glm::clamp(glm::dot(p - a, ab) / glm::dot(ab, ab), 0.0F, 1.0F);
    return glm::length(p - a - t * ab) - radius;
}

/// A stone that stands on the ground or hangs from the ceiling, from a thick to a thin end.
float spike(const vec3& p, const vec3& thick, const vec3& thin, float radius) {
    const vec3 ab = thin - thick;
    const float t = glm::clamp(glm::dot(p - thick, ab) / glm::dot(ab, ab), 0.0F, 1.0F);
    return glm::length(p - thick - t * ab) - glm::mix(radius, 0.3F * radius, t);
}

float cavity(const vec3& p) {
    float d = ellipsoid(p, {0.0F, 1.4F, -0.8F}, {4.6F, 3.4F, 4.4F});
    d = smoothMin(d, capsule(p, {0.6F, 1.6F, 2.5F}, {1.0F, 1.6F, 6.0F}, 1.9F), 1.2F);      // where the camera stands
    d = smoothMin(d, capsule(p, {-2.5F, 1.1F, -4.2F}, {-4.2F, 1.0F, -6.6F}, 1.3F), 1.0F);  // a passage to the back
    d += 0.55F * fractalNoise(p * 0.55F, 4, 7U);
    const vec3 out = -sunDirection;
    d = smoothMin(d, capsule(p, patchCenter + 3.0F * out, patchCenter + 14.0F * out, 0.95F) + 0.15F * noise(p, 8U), 0.5F);
    const float groundHeight = 0.25F * noise({0.45F * p.x, 0.0F, 0.45F * p.z}, 9U) + 0.06F * noise(p * 1.7F, 10U);
    return smoothMax(d, groundHeight - p.y, 0.5F);
}

/// Negative in the rock.
float rock(const vec3& p) {
    float d = -cavity(p);
    d = smoothMin(d, ellipsoid(p, {1.5F, 0.1F, -2.4F}, {0.95F, 0.7F, 0.8F}) + 0.2F * noise(p * 1.6F, 11U), 0.25F);
    d = smoothMin(d, ellipsoid(p, {-2.6F, 0.1F, 0.2F}, {0.8F, 0.5F, 0.7F}) + 0.2F * noise(p * 1.6F, 12U), 0.25F);
    d = smoothMin(d, spike(p, {2.7F, 0.0F, -0.6F}, {2.65F, 1.7F, -0.6F}, 0.5F), 0.35F);
    d = smoothMin(d, spike(p, {2.3F, 4.6F, -1.9F}, {2.2F, 2.4F, -1.9F}, 0.55F), 0.5F);
    d = smoothMin(d, spike(p, {-2.6F, 4.4F, -2.3F}, {-2.6F, 2.5F, -2.2F}, 0.5F), 0.5F);
    d = smoothMin(d, spike(p, {0.9F, 5.0F, -3.2F}, {0.9F, 3.2F, -3.2F}, 0.4F), 0.4F);
    const vec3 outside = glm::abs(p - vec3(-0.2F, 2.6F, -0.3F)) - vec3(6.0F, 3.8F, 8.2F);
    return smoothMax(d, std::max(outside.x, std::max(outside.y, outside.z)), 0.6F);
}

/// Warm layers, greyer towards the ground, in large patches.
vec3 rockTint(const vec3& p) {
    const float layers = noise({0.25F * p.x, 1.6F * p.y + 0.6F * noise(p * 0.4F, 21U), 0.25F * p.z}, 22U);
    const float patches = fractalNoise(p * 0.35F, 2, 23U);
    vec3 tint = glm::mix(linear(0xC98A5C), linear(0xE8C08A), 0.5F + 0.5F * layers);
    tint = glm::mix(tint, linear(0xA8644A), glm::smoothstep(0.0F, 0.5F, patches));
    return glm::mix(linear(0xCDBBA0), tint, glm::smoothstep(-0.1F, 0.9F, p.y));
}

}  // namespace

Scene makeCave() {
    Scene scene;
    scene.name = "cave";
    const Lattice lattice{{-6.6F, -1.7F, -9.0F}, 0.27F, {48, 32, 65}};
    Mesh mesh = surfaceNets(lattice, rock);
    for (size_t i = 0; i < mesh.positions.size(); ++i) {
        mesh.attributes[i].color = vertexColor(rockTint(mesh.positions[i]));
    }
    Material stone = textured("rock", addTexture(scene, rockColors("rock", 256, 0x8E857C, 0xF4EEE4)), 0.95F);
    stone.normalTexture = addTexture(scene, rockNormals("rock normals", 256, 2.5F));
    place(scene, "rock", addMaterial(scene, stone), boxMapped(mesh, 1.0F / 2.5F));

    scene.cameras.push_back(camera("main", {1.1F, 1.7F, 5.6F}, {-0.7F, 1.25F, -1.5F}, 56));
    scene.sun = sun(sunDirection, {38.0F, 34.0F, 28.0F});
    return scene;
}

}  // namespace reflet::builtin
