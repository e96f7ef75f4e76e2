// Surface attributes at a hit.
#include "reference/surface.h"

#include "reference/texture.h"
#include "reference/thin_film.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace reflet {

namespace {

// Vertices of the hit triangle and their barycentric weights.
struct Corners {
    std::array<const VertexAttributes*, 3> at{};
    std::array<float, 3> weight{};

    Corners(const Scene& scene, const Hit& hit) {
        const Mesh& mesh = scene.meshes[scene.instances[hit.instance].mesh];
        for (size_t i = 0; i < 3; ++i) {
            at[i] = &mesh.attributes[mesh.indices[size_t(hit.triangle) * 3 + i]];
        }
        weight = {1.0F - hit.barycentric.x - hit.barycentric.y, hit.barycentric.x, hit.barycentric.y};
    }

    template <class Get>
    [[nodiscard]] auto mix(const Get& get) const {
        return get(*at[0]) * weight[0] + get(*at[1]) * weight[1] + get(*at[2]) * weight[2];
    }
    [[nodiscard]] vec2 uv0() const {
        return mix([](const VertexAttributes& v) { return v.uv0; });
    }
    [[nodiscard]] vec2 uv1() const {
        return mix([](const VertexAttributes& v) { return v.uv1; });
    }
    [[nodiscard]] vec4 color() const {
        return mix([](const VertexAttributes& v) { return vec4(v.color) / 65535.0F; });
    }
};

vec4 baseColorAt(const Scene& scene, const Material& material, const Corners& corners) {
    vec4 color = material.baseColor * corners.color();
    if (material.baseColorTexture.image >= 0) {
        color *= readTexture(scene, material.baseColorTexture, corners.uv0(), corners.uv1(), true);
    }
    return color;
}

vec3 emissionOf(const Scene& scene, const Material& material, const Corners& corners) {
    if (material.unlit) {
        return glm::clamp(vec3(baseColorAt(scene, material, corners)), 0.0F, 1.0F);
    }
    if (material.emissive == vec3(0.0F) || material.emissiveTexture.image < 0) {
        return material.emissive;
    }
    return material.emissive * vec3(readTexture(scene, material.emissiveTexture, corners.uv0(), corners.uv1(), true));
}

// A factor times a channel of its texture, if there is one.
float factorAt(const Scene& scene, float factor, const TextureSlot& slot, const Corners& corners, int channel) {
    return slot.image < 0 ? factor : factor * readTexture(scene, slot, corners.uv0(), corners.uv1(), false)[channel];
}

// KHR_materials_ior and KHR_materials_specular.
void setDielectric(SurfacePoint& s, const Scene& scene, const Material& material, const Corners& corners) {
    s.specularTint = material.specularColor;
    if (material.specularColorTexture.image >= 0) {
        s.specularTint *= vec3(readTexture(scene, material.specularColorTexture, corners.uv0(), corners.uv1(), true));
    }
    s.specularStrength = factorAt(scene, material.specular, material.specularTexture, corners, 3);
    s.dielectric = s.dielectricBetween(1.0F, material.ior);
}

Medium mediumOf(uint32_t instance, const Material& material) {
    const Transmission& t = material.transmission;
    return {instance, material.ior,
            -glm::log(glm::max(t.attenuationColor, 1e-6F)) / std::max(t.attenuationDistance, 1e-6F), t.dispersion};
}

// KHR_materials_transmission and KHR_materials_volume.
void setGlass(SurfacePoint& s, const Scene& scene, const Material& material, const Corners& corners) {
    const Transmission& t = material.transmission;
    s.transmission = factorAt(scene, t.factor, t.texture, corners, 0);
    s.bounded = t.thickness > 0.0F;
    s.medium = mediumOf(s.hit.instance, material);
}

// KHR_materials_iridescence: the film's reflectance at the angle of view. Metals reflect their base colour.
void setFilm(SurfacePoint& s, const Scene& scene, const Material& material, const Corners& corners) {
    const Iridescence& film = material.iridescence;
    if (!(film.factor > 0.0F)) {
        return;
    }
    const float share = factorAt(scene, film.factor, film.texture, corners, 0);
    float thickness = film.thickest;
    if (film.thicknessTexture.image >= 0) {
        const float part = readTexture(scene, film.thicknessTexture, corners.uv0(), corners.uv1(), false).y;
        thickness = glm::mix(film.thinnest, film.thickest, part);
    }
    const ThinFilm layer{film.ior, thickness};
    const float cosine = std::max(glm::dot(s.normal, s.toOrigin), 0.0F);
    s.dielectric.f0 = glm::mix(s.dielectric.f0, layer.f0At(cosine, s.dielectric.f0), share);
    s.baseColor = glm::mix(s.baseColor, layer.f0At(cosine, s.baseColor), share * s.metallic);
}

// KHR_materials_diffuse_transmission.
void setDiffuseTransmission(SurfacePoint& s, const Scene& scene, const Material& material, const Corners& corners) {
    const DiffuseTransmission& t = material.diffuseTransmission;
    if (!(t.factor > 0.0F)) {
        return;
    }
    s.diffuseTransmissionShare = factorAt(scene, t.factor, t.texture, corners, 3);
    s.diffuseTransmission = t.color * s.diffuseTransmissionShare;
    if (t.colorTexture.image >= 0) {
        s.diffuseTransmission *= vec3(readTexture(scene, t.colorTexture, corners.uv0(), corners.uv1(), true));
    }
}

// KHR_materials_sheen: on the outside of glass only.
void setSheen(SurfacePoint& s, const Scene& scene, const Material& material, const Corners& corners) {
    const Sheen& sheen = material.sheen;
    if (sheen.color == vec3(0.0F) || (s.bounded && !s.front)) {
        return;
    }
    s.sheen.color = sheen.color;
    if (sheen.colorTexture.image >= 0) {
        s.sheen.color *= vec3(readTexture(scene, sheen.colorTexture, corners.uv0(), corners.uv1(), true));
    }
    s.sheen.roughness = factorAt(scene, sheen.roughness, sheen.roughnessTexture, corners, 3);
}

/// Of a triangle, also where squares of its area are too small for floats.
vec3 triangleNormal(const Triangle& t) {
    const vec3 n = glm::normalize(glm::cross(t.b - t.a, t.c - t.a));
    if (std::isfinite(n.x)) {
        return n;
    }
    const glm::dvec3 exact = glm::cross(glm::dvec3(t.b) - glm::dvec3(t.a), glm::dvec3(t.c) - glm::dvec3(t.a));
    return glm::length(exact) > 0.0 ? vec3(glm::normalize(exact)) : vec3(0.0F, 1.0F, 0.0F);
}

// Unit tangent and bitangent of a surface with that normal, which points outwards; nullopt: it has none.
std::optional<std::array<vec3, 2>> tangentsAt(const RayScene& rays, const Hit& hit, const Corners& corners,
                                              const vec3& n) {
    const vec4 tangent = corners.mix([](const VertexAttributes& v) { return v.tangent; });
    const vec3 along = mat3(rays.scene().instances[hit.instance].objectToWorld) * vec3(tangent);
    const vec3 t = along - n * glm::dot(n, along);
    if (!(glm::length(t) > 0.0F)) {
        return std::nullopt;
    }
    const float handedness = (tangent.w < 0.0F) != rays.mirrored(hit.instance) ? -1.0F : 1.0F;
    const vec3 unit = glm::normalize(t);
    return std::array{unit, glm::cross(n, unit) * handedness};
}

// The interpolated normal with that normal map; it points outwards, whichever side the ray came from.
vec3 outerNormal(const RayScene& rays, const Hit& hit, const Corners& corners, const vec3& fallback,
                 const TextureSlot& map, float scale) {
    const Scene& scene = rays.scene();
    const vec3 sum = rays.normalToWorld(hit.instance) * corners.mix([](const VertexAttributes& v) { return v.normal; });
    const float length = glm::length(sum);
    const vec3 n = length > 0.0F && std::isfinite(length) ? sum / length : fallback;
    if (map.image < 0) {
        return n;
    }
    const auto tangents = tangentsAt(rays, hit, corners, n);
    if (!tangents) {
        return n;
    }
    vec3 m = vec3(readTexture(scene, map, corners.uv0(), corners.uv1(), false)) * 2.0F - 1.0F;
    m.x *= scale;
    m.y *= scale;
    return glm::normalize(tangents->front() * m.x + tangents->back() * m.y + n * m.z);
}

// KHR_materials_anisotropy: alpha grows toward 1 along the direction. `shading` points outwards.
void setAnisotropy(SurfacePoint& s, const RayScene& rays, const Material& material, const Corners& corners,
                   const vec3& shading) {
    constexpr float leastAlpha = 1e-3F;
    const Anisotropy& a = material.anisotropy;
    const auto tangents = a.strength > 0.0F ? tangentsAt(rays, s.hit, corners, shading) : std::nullopt;
    if (!tangents) {
        return;
    }
    vec2 along(std::cos(a.rotation), std::sin(a.rotation));
    float strength = a.strength;
    if (a.texture.image >= 0) {
        const vec3 texel = vec3(readTexture(rays.scene(), a.texture, corners.uv0(), corners.uv1(), false));
        const vec2 painted = vec2(texel) * 2.0F - 1.0F;
        along = {along.x * painted.x - along.y * painted.y, along.y * painted.x + along.x * painted.y};
        strength *= texel.z;
    }
    const vec3 direction = tangents->front() * along.x + tangents->back() * along.y;
    if (!(strength > 0.0F) || !(glm::length(direction) > 1e-3F)) {
        return;
    }
    const float across = std::max(square(s.roughness), leastAlpha);
    s.anisotropy = {glm::normalize(direction), {glm::mix(across, 1.0F, square(strength)), across}};
}

// KHR_materials_clearcoat. It covers the surface's emission, too.
void setCoat(SurfacePoint& s, const RayScene& rays, const Material& material, const Corners& corners,
             const vec3& outer) {
    const Clearcoat& c = material.clearcoat;
    if (!(c.factor > 0.0F) || (s.bounded && !s.front)) {  // none on the inside of glass
        return;
    }
    const Scene& scene = rays.scene();
    s.coat.factor = factorAt(scene, c.factor, c.texture, corners, 0);
    s.coat.roughness = factorAt(scene, c.roughness, c.roughnessTexture, corners, 1);
    const vec3 normal = outerNormal(rays, s.hit, corners, outer, c.normalTexture, c.normalScale);
    s.coat.normal = consistentNormal(s.front ? normal : -normal, s.geometricNormal, s.toOrigin);
    const float cosine = glm::dot(s.coat.normal, s.toOrigin);
    s.emission *= 1.0F - s.coat.factor * (0.04F + 0.96F * schlick(cosine));
}

float largest(const vec3& v) {
    const vec3 a = glm::abs(v);
    return std::max({a.x, a.y, a.z});
}

}  // namespace

vec3 consistentNormal(const vec3& normal, const vec3& geometric, const vec3& toViewer) {
    constexpr float lowestMirror = 0.01F;
    const float height = std::max(glm::dot(toViewer, geometric), 1e-4F);
    const float least = std::min(0.9F * height, lowestMirror);
    const float upright = glm::dot(normal, geometric);
    if (upright > 0.0F && 2.0F * glm::dot(normal, toViewer) * upright - height >= least) {
        return normal;
    }
    const vec3 aside = normal - upright * geometric;
    const float length = glm::length(aside);
    if (!(length > 1e-6F)) {
        return geometric;
    }
    // The mirror direction turns in the plane of both normals; the angle of view and normal is half of theirs.
    const float x = glm::dot(toViewer, aside) / length;
    const float turned = std::acos(std::min(least / std::hypot(x, height), 1.0F));
    const float angle = 0.5F * (std::atan2(x, height) + turned);
    return std::sin(angle) / length * aside + std::cos(angle) * geometric;
}

Medium mediumOf(const RayScene& rays, uint32_t instance) {
    return mediumOf(instance, rays.material(instance));
}

SurfacePoint surfaceAt(const RayScene& rays, const Hit& hit, const vec3& direction) {
    const Scene& scene = rays.scene();
    const Material& material = rays.material(hit.instance);
    const Corners corners(scene, hit);
    const Triangle t = rays.triangle(hit.instance, hit.triangle);

    SurfacePoint s;
    s.hit = hit;
    // From the vertices, because a point along the ray has a rounding error that grows with the distance.
    s.position = t.a * corners.weight[0] + t.b * corners.weight[1] + t.c * corners.weight[2];
    s.clearance = 4e-6F * std::max({largest(t.a), largest(t.b), largest(t.c)});
    s.toOrigin = -glm::normalize(direction);
    const vec3 outer = triangleNormal(t) * (rays.mirrored(hit.instance) ? -1.0F : 1.0F);
    s.front = glm::dot(outer, s.toOrigin) >= 0.0F;
    s.geometricNormal = s.front ? outer : -outer;
    const vec3 shading = outerNormal(rays, hit, corners, outer, material.normalTexture, material.normalScale);
    s.normal = consistentNormal(s.front ? shading : -shading, s.geometricNormal, s.toOrigin);

    s.baseColor = glm::clamp(vec3(baseColorAt(scene, material, corners)), 0.0F, 1.0F);
    s.roughness = material.roughness;
    s.metallic = material.metallic;
    if (material.metallicRoughnessTexture.image >= 0) {
        const vec4 texel = readTexture(scene, material.metallicRoughnessTexture, corners.uv0(), corners.uv1(), false);
        s.roughness *= texel.y;
        s.metallic *= texel.z;
    }
    setGlass(s, scene, material, corners);
    setDielectric(s, scene, material, corners);
    setFilm(s, scene, material, corners);
    setDiffuseTransmission(s, scene, material, corners);
    setSheen(s, scene, material, corners);
    setAnisotropy(s, rays, material, corners, s.front ? s.normal : -s.normal);
    s.unlit = material.unlit;
    if (s.front || material.doubleSided) {
        s.emission = emissionOf(scene, material, corners);
    }
    setCoat(s, rays, material, corners, outer);
    return s;
}

// Fresnel's reflectance at normal incidence, tinted and at most 1, and Schlick's 1 at grazing incidence are both scaled
// by the strength.
Reflectance SurfacePoint::dielectricBetween(float near, float far) const {
    const double root = (double(far) - near) / (double(far) + near);
    const auto plain = static_cast<float>(root * root);
    const float f90 = transmission > 0.0F ? std::min(50.0F * plain, 1.0F) : 1.0F;
    return {glm::min(plain * specularTint, 1.0F) * specularStrength, f90 * specularStrength};
}

bool isCutOut(const RayScene& rays, const Hit& hit, float blendedCutoff) {
    const Material& material = rays.material(hit.instance);
    const float alpha = baseColorAt(rays.scene(), material, Corners(rays.scene(), hit)).a;
    return alpha < (material.blended ? blendedCutoff : material.alphaCutoff);
}

float coverageAt(const RayScene& rays, const Hit& hit) {
    const Material& material = rays.material(hit.instance);
    if (!(material.alphaCutoff > 0.0F)) {
        return 1.0F;
    }
    const float alpha = baseColorAt(rays.scene(), material, Corners(rays.scene(), hit)).a;
    return material.blended ? std::clamp(alpha, 0.0F, 1.0F) : alpha < material.alphaCutoff ? 0.0F : 1.0F;
}

vec3 emissionAt(const RayScene& rays, const Hit& hit) {
    return emissionOf(rays.scene(), rays.material(hit.instance), Corners(rays.scene(), hit));
}

}  // namespace reflet
