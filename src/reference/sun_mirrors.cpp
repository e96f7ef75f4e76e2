// Finds the flat mirrors that reflect the sun.
#include "reference/sun_mirrors.h"

#include "base/color.h"

#include <algorithm>
#include <cmath>
#include <functional>

namespace reflet {

namespace {

constexpr size_t mostMirrors = 4;
constexpr size_t mostPlanes = 64;  // of one instance; others are curved
// Perceptual roughness, of a lobe about as wide as the sun is for us. Lamps' highlights have 0.045 at least.
constexpr float smoothest = 0.05F;
constexpr float sameDirection = 0.99999F;  // cosine
constexpr float flatness = 1e-4F;          // share of a point's distance from the origin

struct Plane {
    vec4 plane;
    float light;  // area · cosine · reflectance
};

bool same(const vec4& a, const vec4& b) {
    return glm::dot(vec3(a), vec3(b)) > sameDirection && std::abs(a.w - b.w) <= flatness * (1.0F + std::abs(a.w));
}

// Only roughly: it orders mirrors.
float reflectanceOf(const Material& material, float cosine) {
    const float f0 = glm::mix(0.04F * material.specular, luminance(vec3(material.baseColor)), material.metallic);
    return f0 + (1.0F - f0) * std::pow(1.0F - cosine, 5.0F);
}

void addPlanes(std::vector<Plane>& all, const RayScene& rays, uint32_t instance, const vec3& toSun) {
    const Material& material = rays.material(instance);
    const Scene& scene = rays.scene();
    const auto count = static_cast<uint32_t>(scene.meshes[scene.instances[instance].mesh].indices.size() / 3);
    std::vector<Plane> own;
    for (uint32_t k = 0; k < count; ++k) {
        const Triangle t = rays.triangle(instance, k);
        const vec3 across = (rays.mirrored(instance) ? -1.0F : 1.0F) * glm::cross(t.b - t.a, t.c - t.a);
        const float twice = glm::length(across);
        if (!(twice > 0.0F)) {
            continue;
        }
        vec3 n = across / twice;
        n = material.doubleSided && glm::dot(n, toSun) < 0.0F ? -n : n;
        const vec4 plane(n, -glm::dot(n, t.a));
        auto found = std::ranges::find_if(own, [&](const Plane& p) { return same(p.plane, plane); });
        if (found == own.end()) {
            if (own.size() == mostPlanes) {
                return;
            }
            found = own.insert(own.end(), {plane, 0.0F});
        }
        const float cosine = glm::dot(n, toSun);
        found->light += cosine > 0.0F ? 0.5F * twice * cosine * reflectanceOf(material, cosine) : 0.0F;
    }
    for (const Plane& plane : own) {
        const auto found = std::ranges::find_if(all, [&](const Plane& p) { return same(p.plane, plane.plane); });
        if (found == all.end()) {
            all.push_back(plane);
        } else {
            found->light += plane.light;
        }
    }
}

bool mayBeMirror(const Material& m) {
    const bool plain = m.normalTexture.image < 0 && m.transmission.factor == 0.0F && m.clearcoat.factor == 0.0F;
    const bool smooth = m.roughness <= smoothest || m.metallicRoughnessTexture.image >= 0;
    return plain && smooth && !m.unlit && !m.blended && (m.metallic > 0.0F || m.specular > 0.0F);
}

}  // namespace

SunMirrors::SunMirrors(const RayScene& rays, const vec3& toSun) {
    std::vector<Plane> all;
    for (uint32_t i = 0; i < rays.scene().instances.size(); ++i) {
        if (mayBeMirror(rays.material(i))) {
            addPlanes(all, rays, i, toSun);
        }
    }
    std::erase_if(all, [](const Plane& p) { return !(p.light > 0.0F); });
    std::ranges::stable_sort(all, std::greater<>(), &Plane::light);
    all.resize(std::min(all.size(), mostMirrors));
    std::ranges::transform(all, std::back_inserter(planes_), &Plane::plane);
}

bool SunMirrors::isOn(const vec4& plane, const SurfacePoint& p) {
    const bool smooth = p.roughness <= smoothest && p.transmission == 0.0F && p.coat.factor == 0.0F && !p.unlit;
    return smooth && glm::dot(p.geometricNormal, vec3(plane)) > sameDirection &&
           glm::dot(p.normal, vec3(plane)) > sameDirection &&
           std::abs(glm::dot(plane, vec4(p.position, 1.0F))) <= flatness * (1.0F + glm::length(p.position));
}

bool SunMirrors::isOnAny(const SurfacePoint& point) const {
    return std::ranges::any_of(planes_, [&](const vec4& plane) { return isOn(plane, point); });
}

bool SunMirrors::startsFrom(const SurfacePoint& point) const {
    return !planes_.empty() && point.roughness > smoothest && point.transmission == 0.0F && !point.unlit;
}

}  // namespace reflet
