// Surface attributes at a hit.
#include "reference/surface.h"

#include "reference/texture.h"

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

// KHR_materials_ior and KHR_materials_specular. Fresnel's reflectance at normal incidence, tinted and at most 1, and
// Schlick's 1 at grazing incidence are both scaled by the strength.
void setDielectric(SurfacePoint& s, const Scene& scene, const Material& material, const Corners& corners) {
    const double root = (double(material.ior) - 1.0) / (double(material.ior) + 1.0);
    vec3 tint = material.specularColor;
    if (material.specularColorTexture.image >= 0) {
        tint *= vec3(readTexture(scene, material.specularColorTexture, corners.uv0(), corners.uv1(), true));
    }
    s.dielectricF90 = material.specular;
    if (material.specularTexture.image >= 0) {
        s.dielectricF90 *= readTexture(scene, material.specularTexture, corners.uv0(), corners.uv1(), false).w;
    }
    s.dielectricF0 = glm::min(static_cast<float>(root * root) * tint, 1.0F) * s.dielectricF90;
}

// The interpolated and normal-mapped normal; it points outwards, whichever side the ray came from.
vec3 outerNormal(const RayScene& rays, const Hit& hit, const Corners& corners, const vec3& fallback) {
    const Scene& scene = rays.scene();
    const Material& material = rays.material(hit.instance);
    const vec3 sum = rays.normalToWorld(hit.instance) * corners.mix([](const VertexAttributes& v) { return v.normal; });
    const float length = glm::length(sum);
    const vec3 n = length > 0.0F ? sum / length : fallback;
    if (material.normalTexture.image < 0) {
        return n;
    }
    const vec4 tangent = corners.mix([](const VertexAttributes& v) { return v.tangent; });
    const vec3 along = mat3(scene.instances[hit.instance].objectToWorld) * vec3(tangent);
    const vec3 t = along - n * glm::dot(n, along);
    if (!(glm::length(t) > 0.0F)) {
        return n;
    }
    const float handedness = (tangent.w < 0.0F) != rays.mirrored(hit.instance) ? -1.0F : 1.0F;
    const vec3 tUnit = glm::normalize(t);
    vec3 m = vec3(readTexture(scene, material.normalTexture, corners.uv0(), corners.uv1(), false)) * 2.0F - 1.0F;
    m.x *= material.normalScale;
    m.y *= material.normalScale;
    return glm::normalize(tUnit * m.x + glm::cross(n, tUnit) * (handedness * m.y) + n * m.z);
}

float largest(const vec3& v) {
    const vec3 a = glm::abs(v);
    return std::max({a.x, a.y, a.z});
}

}  // namespace

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
    const vec3 outer = glm::normalize(glm::cross(t.b - t.a, t.c - t.a)) * (rays.mirrored(hit.instance) ? -1.0F : 1.0F);
    s.front = glm::dot(outer, s.toOrigin) >= 0.0F;
    s.geometricNormal = s.front ? outer : -outer;
    const vec3 shading = outerNormal(rays, hit, corners, outer);
    s.normal = s.front ? shading : -shading;

    s.baseColor = glm::clamp(vec3(baseColorAt(scene, material, corners)), 0.0F, 1.0F);
    s.roughness = material.roughness;
    s.metallic = material.metallic;
    if (material.metallicRoughnessTexture.image >= 0) {
        const vec4 texel = readTexture(scene, material.metallicRoughnessTexture, corners.uv0(), corners.uv1(), false);
        s.roughness *= texel.y;
        s.metallic *= texel.z;
    }
    setDielectric(s, scene, material, corners);
    s.unlit = material.unlit;
    if (s.front || material.doubleSided) {
        s.emission = emissionOf(scene, material, corners);
    }
    return s;
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
