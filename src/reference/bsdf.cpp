// BSDF evaluation and sampling.
#include "reference/bsdf.h"

#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <cmath>

namespace reflet {

namespace {

constexpr float leastLampRoughness = 0.045F;
constexpr float mirrorAlpha = 1e-4F;  // lobes narrower than a hundredth of a degree are treated as a perfect mirror
constexpr float leastCosine = 1e-4F;

float square(float x) {
    return x * x;
}

// Fresnel, Schlick 1994: F0 + (1 - F0) · this.
float schlick(float cosine) {
    const float rest = std::clamp(1.0F - cosine, 0.0F, 1.0F);
    return square(square(rest)) * rest;
}

// Smith's Lambda; masking is 1 / (1 + Lambda).
float smithLambda(const vec3& w, float alpha) {
    const float tan2 = (w.x * w.x + w.y * w.y) / std::max(w.z * w.z, 1e-12F);
    return 0.5F * (std::sqrt(1.0F + alpha * alpha * tan2) - 1.0F);
}

float ggxDensity(const vec3& h, float alpha) {
    // In terms of the slope, which keeps precision for narrow lobes.
    const float stretched = (h.x * h.x + h.y * h.y) / square(alpha) + h.z * h.z;
    return 1.0F / (pi * square(alpha * stretched));
}

// Samples the visible normals (VNDF) from v. (Heitz, Sampling the GGX Distribution of Visible Normals, JCGT 2018)
vec3 sampleVisibleNormal(const vec3& v, float alpha, const vec2& u) {
    const vec3 stretched = glm::normalize(vec3(alpha * v.x, alpha * v.y, v.z));
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
    return glm::normalize(vec3(alpha * n.x, alpha * n.y, std::max(n.z, 0.0F)));
}

// G2 / G1: fraction of the light reflected by microfacets visible from v that is not masked toward l.
float unmasked(const vec3& v, const vec3& l, float alpha) {
    const float toView = smithLambda(v, alpha);
    return (1.0F + toView) / (1.0F + toView + smithLambda(l, alpha));
}

// Entries at evenly spaced cosines and roughnesses, both in [0, 1].
class AlbedoTable {
public:
    AlbedoTable() : entries_(size_t(side) * side) {
        // Isolated: a waiting thread must not start tracing a path, which would need this very table.
        tbb::this_task_arena::isolate([this] { tbb::parallel_for(0, side, [this](int row) { integrateRow(row); }); });
    }

    [[nodiscard]] LobeAlbedo at(float cosine, float roughness) const {
        const float x = std::clamp(cosine, 0.0F, 1.0F) * (side - 1);
        const float y = std::clamp(roughness, 0.0F, 1.0F) * (side - 1);
        const int column = std::min(static_cast<int>(x), side - 2);
        const int row = std::min(static_cast<int>(y), side - 2);
        const vec2 value = glm::mix(glm::mix(entry(column, row), entry(column + 1, row), x - column),
                                    glm::mix(entry(column, row + 1), entry(column + 1, row + 1), x - column), y - row);
        return {value.x, value.y};
    }

private:
    static constexpr int side = 48;
    static constexpr int steps = 64;  // of the quadrature, along each axis

    static size_t index(int column, int row) { return static_cast<size_t>(row) * side + static_cast<size_t>(column); }

    void integrateRow(int row) {
        for (int column = 0; column < side; ++column) {
            entries_[index(column, row)] =
                integrate(static_cast<float>(column) / (side - 1), static_cast<float>(row) / (side - 1));
        }
    }

    [[nodiscard]] vec2 entry(int column, int row) const {
        const LobeAlbedo& a = entries_[index(column, row)];
        return {a.scale, a.bias};
    }

    static LobeAlbedo integrate(float cosine, float roughness) {
        const float z = std::max(cosine, 1e-3F);
        const vec3 v(std::sqrt(1.0F - z * z), 0.0F, z);
        const float alpha = std::max(square(roughness), mirrorAlpha);
        LobeAlbedo sum;
        for (int i = 0; i < steps * steps; ++i) {
            const vec2 u = (vec2(i % steps, i / steps) + 0.5F) / static_cast<float>(steps);
            const vec3 h = sampleVisibleNormal(v, alpha, u);
            const vec3 l = 2.0F * glm::dot(v, h) * h - v;
            if (l.z > 0.0F) {
                const float share = unmasked(v, l, alpha);
                const float fresnel = schlick(glm::dot(v, h));
                sum.scale += share * (1.0F - fresnel);
                sum.bias += share * fresnel;
            }
        }
        return {sum.scale / (steps * steps), sum.bias / (steps * steps)};
    }

    std::vector<LobeAlbedo> entries_;
};

// Directional albedo of a layer of this reflectance including multiple scattering, from that of single scattering.
vec3 compensated(const vec3& f0, float f90, const LobeAlbedo& a) {
    const float lost = 1.0F / std::max(a.scale + a.bias, 1e-3F) - 1.0F;
    return (f0 * a.scale + f90 * a.bias) * (1.0F + f0 * lost);
}

float largest(const vec3& v) {
    return std::max({v.x, v.y, v.z});
}

}  // namespace

mat3 frameAround(const vec3& n) {
    const vec3 helper = std::abs(n.x) > 0.7F ? vec3(0, 1, 0) : vec3(1, 0, 0);
    const vec3 t = glm::normalize(glm::cross(helper, n));
    return {t, glm::cross(n, t), n};
}

LobeAlbedo ggxAlbedo(float cosine, float roughness) {
    static const AlbedoTable table;
    return table.at(cosine, roughness);
}

Bsdf::Bsdf(const SurfacePoint& point, const ReferenceOptions& options)
    : frame_(frameAround(point.normal)),
      geometricNormal_(point.geometricNormal),
      view_(local(point.toOrigin)),
      diffuse_(point.baseColor),
      uniform_(options.diffuse == DiffuseSampling::uniform) {
    // Shading normals may face away from the viewer.
    view_ = glm::normalize(vec3(view_.x, view_.y, std::max(view_.z, leastCosine)));
    if (point.unlit) {
        diffuse_ = vec3(0.0F);
        return;
    }
    if (options.lambertOnly) {
        return;
    }
    const LobeAlbedo albedo = ggxAlbedo(view_.z, point.roughness);
    // glTF blends a dielectric and a metal by `metallic`; their albedos are blended likewise.
    const vec3 coat = compensated(point.dielectricF0, point.dielectricF90, albedo);
    const vec3 metal = compensated(point.baseColor, 1.0F, albedo);
    const vec3 specular = glm::min(glm::mix(coat, metal, point.metallic), 1.0F);
    f0_ = glm::mix(point.dielectricF0, point.baseColor, point.metallic);
    f90_ = point.dielectricF90 + point.metallic * (1.0F - point.dielectricF90);
    compensation_ = specular / glm::max(f0_ * albedo.scale + f90_ * albedo.bias, 1e-4F);
    // KHR_materials_specular: the base gets what the layer's most reflective channel leaves.
    diffuse_ = point.baseColor * ((1.0F - point.metallic) * (1.0F - std::min(largest(coat), 1.0F)));
    alpha_ = square(point.roughness);
    mirror_ = alpha_ < mirrorAlpha;
    const float specularLight = specular.x + specular.y + specular.z;
    const float all = specularLight + diffuse_.x + diffuse_.y + diffuse_.z;
    specularChance_ = all > 0.0F ? specularLight / all : 0.0F;
    if (specularChance_ > 0.0F && specularChance_ < 1.0F) {
        specularChance_ = std::clamp(specularChance_, 0.1F, 0.9F);
    }
}

bool Bsdf::above(const vec3& world) const {
    return glm::dot(world, geometricNormal_) > 0.0F;
}

vec3 Bsdf::specularLobe(const vec3& l, float alpha) const {
    const vec3 h = glm::normalize(view_ + l);
    const float masking = 1.0F / (1.0F + smithLambda(view_, alpha) + smithLambda(l, alpha));
    const vec3 fresnel = f0_ + (f90_ - f0_) * schlick(glm::dot(view_, h));
    return fresnel * compensation_ * (ggxDensity(h, alpha) * masking / (4.0F * view_.z));
}

Reflection Bsdf::evaluate(const vec3& toLight, float alpha, bool withSpecular) const {
    const vec3 l = local(toLight);
    if (l.z <= 0.0F || !above(toLight)) {
        return {};
    }
    Reflection r;
    r.diffuse = diffuse_ * (l.z / pi);
    if (withSpecular && specularChance_ > 0.0F) {
        r.specular = specularLobe(l, alpha);
    }
    return r;
}

Reflection Bsdf::reflectLamp(const vec3& toLight) const {
    return evaluate(toLight, std::max(alpha_, square(leastLampRoughness)), true);
}

float Bsdf::visibleNormalPdf(const vec3& l) const {
    const vec3 h = glm::normalize(view_ + l);
    return ggxDensity(h, alpha_) / ((1.0F + smithLambda(view_, alpha_)) * 4.0F * view_.z);
}

float Bsdf::pdf(const vec3& direction) const {
    const vec3 l = local(direction);
    if (l.z <= 0.0F) {
        return 0.0F;
    }
    const float diffuse = uniform_ ? 0.5F / pi : l.z / pi;
    const float specular = mirror_ || specularChance_ == 0.0F ? 0.0F : visibleNormalPdf(l);
    return glm::mix(diffuse, specular, specularChance_);
}

Scattered Bsdf::scatter(float lobe, const vec2& u) const {
    Scattered s;
    if (lobe < specularChance_ && mirror_) {
        const vec3 l(-view_.x, -view_.y, view_.z);
        s.direction = frame_ * l;
        if (above(s.direction)) {
            const vec3 fresnel = f0_ + (f90_ - f0_) * schlick(view_.z);
            s.weight.specular = fresnel * compensation_ / specularChance_;
        }
        return s;
    }
    vec3 l(0.0F);
    if (lobe < specularChance_) {
        const vec3 h = sampleVisibleNormal(view_, alpha_, u);
        l = 2.0F * glm::dot(view_, h) * h - view_;
    } else {
        l.z = uniform_ ? 1.0F - u.x : std::sqrt(1.0F - u.x);
        const float radius = std::sqrt(std::max(1.0F - l.z * l.z, 0.0F));
        l.x = radius * std::cos(2.0F * pi * u.y);
        l.y = radius * std::sin(2.0F * pi * u.y);
    }
    s.direction = frame_ * l;
    s.pdf = pdf(s.direction);
    if (s.pdf > 0.0F) {
        const Reflection r = reflect(s.direction);
        s.weight = {r.diffuse / s.pdf, r.specular / s.pdf};
    }
    return s;
}

}  // namespace reflet
