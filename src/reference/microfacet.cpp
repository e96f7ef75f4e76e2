// Sampling of visible normals, and the table of directional albedos.
#include "reference/microfacet.h"

#include "reference/albedo_table.h"

namespace reflet {

vec3 sampleVisibleNormal(const vec3& v, const vec2& alpha, const vec2& u) {
    const vec3 stretched = glm::normalize(vec3(alpha.x * v.x, alpha.y * v.y, v.z));
    // A disk that faces v, with one axis along the horizon; the hemisphere covers only a part of its lower half.
    const vec3 horizontal(-stretched.y, stretched.x, 0.0F);
    const float length = glm::length(horizontal);
    const vec3 across = length > 1e-6F ? horizontal / length : vec3(1, 0, 0);
    const vec3 up = glm::cross(stretched, across);
    const float radius = std::sqrt(u.x);
    const float angle = 2.0F * pi * u.y;
    const float x = radius * std::cos(angle);
    const float share = 0.5F * (1.0F + stretched.z);
    const float y = glm::mix(std::sqrt(1.0F - x * x), radius * std::sin(angle), share);
    const vec3 n = x * across + y * up + std::sqrt(std::max(1.0F - x * x - y * y, 0.0F)) * stretched;
    return glm::normalize(vec3(alpha.x * n.x, alpha.y * n.y, std::max(n.z, 0.0F)));
}

namespace {

vec2 integrate(float cosine, float roughness) {
    constexpr int steps = 64;  // of the quadrature, along each axis
    const float z = std::max(cosine, 1e-3F);
    const vec3 v(std::sqrt(1.0F - z * z), 0.0F, z);
    const float alpha = std::max(square(roughness), mirrorAlpha);
    vec2 sum(0.0F);
    for (int i = 0; i < steps * steps; ++i) {
        const vec2 u = (vec2(i % steps, i / steps) + 0.5F) / static_cast<float>(steps);
        const vec3 h = sampleVisibleNormal(v, alpha, u);
        const vec3 l = 2.0F * glm::dot(v, h) * h - v;
        if (l.z > 0.0F) {
            const float fresnel = schlick(glm::dot(v, h));
            sum += unmasked(v, l, alpha) * vec2(1.0F - fresnel, fresnel);
        }
    }
    return sum / static_cast<float>(steps * steps);
}

}  // namespace

mat3 frameAround(const vec3& n) {
    const vec3 helper = std::abs(n.x) > 0.7F ? vec3(0, 1, 0) : vec3(1, 0, 0);
    const vec3 t = glm::normalize(glm::cross(helper, n));
    return {t, glm::cross(n, t), n};
}

LobeAlbedo ggxAlbedo(float cosine, float roughness) {
    static const AlbedoTable table(integrate);
    const vec2 albedo = table.at(cosine, roughness);
    return {albedo.x, albedo.y};
}

}  // namespace reflet
