// A closed cave with one shaft to the sky: the sun lights a patch of the ground, and that patch lights everything else.
#include "scene/builtin/assemble.h"
#include "scene/builtin/noise.h"
#include "scene/builtin/patterns.h"
#include "scene/builtin/scenes.h"
#include "scene/builtin/surface_nets.h"

#include <algorithm>
#include <cmath>

namespace reflet::builtin {
namespace {

const vec3 sunDirection = glm::normalize(vec3(0.40F, -0.78F, -0.48F));
constexpr vec3 mainPatch{0.3F, 0.3F, -2.0F};  // where the sunlight hits the ground

float smoothMin(float a, float b, float width) {
    const float h = std::max(width - std::abs(a - b), 0.0F) / width;
    return std::min(a, b) - h * h * width * 0.25F;
}

float smoothMax(float a, float b, float width) {
    return -smoothMin(-a, -b, width);
}

/// Approximate signed distance to an ellipsoid.
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

/// A stalagmite or stalactite, from its thick to its thin end.
float spike(const vec3& p, const vec3& thick, const vec3& thin, float radius) {
    const vec3 ab = thin - thick;
    const float t = glm::clamp(glm::dot(p - thick, ab) / glm::dot(ab, ab), 0.0F, 1.0F);
    return glm::length(p - thick - t * ab) - glm::mix(radius, 0.3F * radius, t);
}

/// A shaft from a point on the ground toward the sun.
float shaft(const vec3& p, const vec3& foot, float radius) {
    return capsule(p, foot - 2.5F * sunDirection, foot - 16.0F * sunDirection, radius);
}

/// Negative in air.
float cavity(const vec3& p) {
    float d = ellipsoid(p, {0.0F, 1.3F, -0.9F}, {3.7F, 2.9F, 3.4F});
    d = smoothMin(d, capsule(p, {0.6F, 1.6F, 2.5F}, {1.0F, 1.6F, 4.2F}, 1.9F), 1.2F);  // where the camera stands
    d += 0.9F * fractalNoise(p * 0.6F, 4, 7U) + 0.32F * noise({0.5F * p.x, 1.9F * p.y, 0.5F * p.z}, 13U);
    d = smoothMin(d, shaft(p, mainPatch, 2.15F) + 0.3F * noise(p * 0.9F, 8U), 0.4F);
    const float groundHeight = 0.3F * noise({0.45F * p.x, 0.0F, 0.45F * p.z}, 9U) + 0.08F * noise(p * 1.7F, 10U);
    return smoothMax(d, groundHeight - p.y, 0.4F);
}

/// Negative in the rock.
float rock(const vec3& p) {
    float d = -cavity(p);
    d = smoothMin(d, ellipsoid(p, {1.3F, 0.2F, -1.6F}, {0.8F, 0.75F, 0.7F}) + 0.25F * noise(p * 1.6F, 11U), 0.2F);
    d = smoothMin(d, ellipsoid(p, {-0.6F, 0.1F, -1.2F}, {0.55F, 0.45F, 0.5F}) + 0.2F * noise(p * 1.9F, 12U), 0.2F);
    d = smoothMin(d, ellipsoid(p, {-1.9F, 0.1F, 0.6F}, {0.8F, 0.7F, 0.7F}) + 0.2F * noise(p * 1.6F, 14U), 0.25F);
    const float pillar = glm::length(vec2(p.x + 1.75F, p.z + 1.3F)) - 0.32F - 0.09F * (p.y - 2.0F) * (p.y - 2.0F);
    d = smoothMin(d, pillar + 0.2F * noise(p * 1.3F, 15U), 0.4F);
    d = smoothMin(d, spike(p, {2.4F, 0.0F, -0.4F}, {2.35F, 1.5F, -0.4F}, 0.5F), 0.3F);
    d = smoothMin(d, spike(p, {2.2F, 4.4F, -1.7F}, {2.1F, 2.3F, -1.7F}, 0.55F), 0.4F);
    d = smoothMin(d, spike(p, {0.3F, 4.6F, 0.9F}, {0.3F, 2.9F, 0.9F}, 0.5F), 0.4F);
    const vec3 outside = glm::abs(p - vec3(-0.2F, 2.6F, 0.65F)) - vec3(6.0F, 3.8F, 6.95F);
    return smoothMax(d, std::max(outside.x, std::max(outside.y, outside.z)), 0.5F);
}

/// Warm strata in large patches, greyer towards the ground.
vec3 rockTint(const vec3& p) {
    const float layers = noise({0.25F * p.x, 1.6F * p.y + 0.6F * noise(p * 0.4F, 21U), 0.25F * p.z}, 22U);
    const float patches = fractalNoise(p * 0.35F, 2, 23U);
    vec3 tint = glm::mix(linear(0xC99A72), linear(0xF5EAD8), glm::clamp(0.5F + 0.9F * layers, 0.0F, 1.0F));
    tint = glm::mix(tint, linear(0xB9785C), glm::smoothstep(0.0F, 0.5F, patches));
    return glm::mix(linear(0xE8E2D6), tint, glm::smoothstep(-0.1F, 0.9F, p.y));
}

}  // namespace

Scene makeCave() {
    Scene scene;
    scene.name = "cave";
    const Lattice lattice{{-6.6F, -1.7F, -6.7F}, 0.25F, {52, 34, 59}};
    Mesh mesh = surfaceNets(lattice, rock);
    for (size_t i = 0; i < mesh.positions.size(); ++i) {
        mesh.attributes[i].color = vertexColor(rockTint(mesh.positions[i]));
    }
    Material stone = textured("rock", addTexture(scene, rockColors("rock", 256, 0xC6BEB5, 0xFFFBF4)), 0.95F);
    stone.normalTexture = addTexture(scene, rockNormals("rock normals", 256, 2.5F));
    place(scene, "rock", addMaterial(scene, stone), boxMapped(mesh, 1.0F / 2.5F));

    scene.cameras.push_back(camera("main", {0.5F, 1.7F, 4.0F}, {-0.3F, 1.35F, -1.5F}, 62));
    scene.sun = sun(sunDirection, {18.0F, 17.0F, 15.6F});
    return scene;
}

}  // namespace reflet::builtin
