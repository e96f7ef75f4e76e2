// BSDF evaluation and sampling.
#include "reference/bsdf.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace reflet {

namespace {

constexpr float leastLampRoughness = 0.045F;
constexpr Reflectance coatReflectance{vec3(0.04F), 1.0F};

float largest(const vec3& v) {
    return std::max({v.x, v.y, v.z});
}

float total(const vec3& v) {
    return v.x + v.y + v.z;
}

}  // namespace

Bsdf::Bsdf(const SurfacePoint& point, const ReferenceOptions& options, const Boundary& boundary)
    : frame_(frameAround(point.normal)),
      geometricNormal_(point.geometricNormal),
      view_(viewIn(frame_, point.toOrigin)),
      diffuse_(point.baseColor),
      uniform_(options.diffuse == DiffuseSampling::uniform) {
    if (point.unlit) {
        diffuse_ = vec3(0.0F);
        return;
    }
    if (options.lambertOnly) {
        return;
    }
    setSheen(point);
    setLayers(point, boundary);
    setCoat(point);
    setChances();
}

void Bsdf::setSheen(const SurfacePoint& point) {
    if (point.sheen.color != vec3(0.0F)) {
        sheen_ = SheenLobe(frame_, view_, point.sheen.color, point.sheen.roughness);
    }
}

// An anisotropic lobe has about the albedo of the isotropic one with the same mean square of widths.
void Bsdf::setSpecular(const SurfacePoint& point, const Reflectance& both, const LobeAlbedo& table) {
    const vec3& along = point.anisotropy.direction;
    if (along == vec3(0.0F)) {
        specular_ = SpecularLobe(frame_, view_, vec2(square(point.roughness)), both, specularAlbedo_, table);
        return;
    }
    const mat3 frame(along, glm::cross(point.normal, along), point.normal);
    specular_ =
        SpecularLobe(frame, viewIn(frame, point.toOrigin), point.anisotropy.alpha, both, specularAlbedo_, table);
}

void Bsdf::setLayers(const SurfacePoint& point, const Boundary& boundary) {
    const bool inside = boundary.kind == Boundary::Kind::inner || boundary.kind == Boundary::Kind::none;
    const float transmission = point.transmission * (1.0F - point.metallic);
    const bool isotropic = point.anisotropy.direction == vec3(0.0F);
    const vec2& alpha = point.anisotropy.alpha;
    const float roughness = isotropic ? point.roughness : std::sqrt(glm::length(alpha) * 0.70710678F);
    const LobeAlbedo table = ggxAlbedo(view_.z, roughness);
    const float beneath = 1.0F - sheen_.albedo();
    // glTF blends a dielectric and a metal by `metallic`; their albedos are blended likewise.
    const vec3 layer = compensated(point.dielectric.f0, point.dielectric.f90, table);
    const vec3 metal = compensated(point.baseColor, 1.0F, table);
    // Inside glass the lobe of the boundary reflects in the layer's place.
    const float opaque = inside ? 1.0F - point.transmission : 1.0F;
    specularAlbedo_ = beneath * glm::min(glm::mix(layer * opaque, metal, point.metallic), 1.0F);
    const Reflectance both{glm::mix(point.dielectric.f0, point.baseColor, point.metallic),
                           point.dielectric.f90 + point.metallic * (1.0F - point.dielectric.f90)};
    setSpecular(point, both, table);
    // KHR_materials_specular: the base gets what the layer's most reflective channel leaves.
    const float base = beneath * (1.0F - point.metallic) * (1.0F - std::min(largest(layer), 1.0F));
    const float opaqueBase = base * (1.0F - point.transmission);
    diffuse_ = point.baseColor * (opaqueBase * (1.0F - point.diffuseTransmissionShare));
    through_ = point.diffuseTransmission * opaqueBase;
    if (!(transmission > 0.0F)) {
        return;
    }
    const Reflectance across = point.dielectricBetween(boundary.near, boundary.far);
    glass_ = GlassLobe(boundary, view_, square(point.roughness), largest(across.f0), across.f90);
    if (boundary.kind == Boundary::Kind::none) {
        transmitted_ = vec3(transmission);
        return;
    }
    transmitted_ = point.baseColor * (inside ? transmission : base * point.transmission);
    reflectedInside_ = inside ? transmission : 0.0F;
}

void Bsdf::setCoat(const SurfacePoint& point) {
    if (!(point.coat.factor > 0.0F)) {
        return;
    }
    const mat3 frame = frameAround(point.coat.normal);
    const vec3 view = viewIn(frame, point.toOrigin);
    const LobeAlbedo table = ggxAlbedo(view.z, point.coat.roughness);
    const vec3 albedo = compensated(coatReflectance.f0, coatReflectance.f90, table);
    coat_ = SpecularLobe(frame, view, vec2(square(point.coat.roughness)), coatReflectance, albedo, table);
    coatFactor_ = point.coat.factor;
    coatAlbedo_ = coatFactor_ * std::min(albedo.x, 1.0F);
}

// In proportion to the lobes' light, at least a tenth each, at the largest one's expense.
void Bsdf::setChances() {
    const float beneath = 1.0F - coatAlbedo_;
    const float refracted = total(transmitted_) + 3.0F * reflectedInside_;
    const std::array<float, lobes> light{beneath * total(specularAlbedo_),
                                         beneath * total(diffuse_),
                                         beneath * 3.0F * sheen_.albedo(),
                                         beneath * refracted,
                                         3.0F * coatAlbedo_,
                                         beneath * total(through_)};
    const auto sumOf = [](const auto& values) { return std::accumulate(values.begin(), values.end(), 0.0F); };
    const float all = sumOf(light);
    if (!(all > 0.0F)) {
        return;
    }
    for (size_t i = 0; i < lobes; ++i) {
        chances_[i] = light[i] > 0.0F ? std::max(light[i] / all, 0.1F) : 0.0F;
    }
    *std::ranges::max_element(chances_) -= sumOf(chances_) - 1.0F;
}

Reflection Bsdf::evaluate(const vec3& toLight, float leastAlpha) const {
    Reflection r;
    const float cosine = glm::dot(toLight, frame_[2]);
    if (above(toLight)) {
        if (cosine > 0.0F) {
            r.diffuse = diffuse_ * (cosine / pi);
            r.diffuse += chances_[sheen] > 0.0F ? sheen_.reflect(toLight) : vec3(0.0F);
            r.specular = chances_[specular] > 0.0F ? specular_.reflect(toLight, leastAlpha) : vec3(0.0F);
        }
        r.diffuse *= 1.0F - coatAlbedo_;
        r.specular *= 1.0F - coatAlbedo_;
        if (coatFactor_ > 0.0F) {
            r.specular += coatFactor_ * coat_.reflect(toLight, leastAlpha);
        }
    } else if (cosine < 0.0F) {
        r.diffuse = through_ * ((1.0F - coatAlbedo_) * -cosine / pi);
    }
    return r;
}

Reflection Bsdf::reflect(const vec3& toLight) const {
    Reflection r = evaluate(toLight, 0.0F);
    const float cosine = glm::dot(toLight, frame_[2]);
    if (chances_[glass] > 0.0F && above(toLight) == (cosine > 0.0F)) {
        const vec3 weight = cosine > 0.0F ? vec3(reflectedInside_) : transmitted_;
        r.specular += weight * ((1.0F - coatAlbedo_) * glass_.pdf(toLight * frame_));
    }
    return r;
}

Reflection Bsdf::reflectLamp(const vec3& toLight) const {
    return evaluate(toLight, square(leastLampRoughness));
}

float Bsdf::pdf(const vec3& direction) const {
    const float cosine = glm::dot(direction, frame_[2]);
    float sum = 0.0F;
    if (cosine > 0.0F) {
        sum += chances_[diffuse] * (uniform_ ? 0.5F / pi : cosine / pi);
        sum += chances_[specular] > 0.0F ? chances_[specular] * specular_.pdf(direction) : 0.0F;
        sum += chances_[sheen] * SheenLobe::pdf;
    } else {
        sum += chances_[through] * -cosine / pi;
    }
    sum += chances_[coat] > 0.0F ? chances_[coat] * coat_.pdf(direction) : 0.0F;
    return sum + (chances_[glass] > 0.0F ? chances_[glass] * glass_.pdf(direction * frame_) : 0.0F);
}

vec3 Bsdf::sampleDiffuse(const vec2& u, bool uniform) const {
    vec3 l(0.0F);
    l.z = uniform ? 1.0F - u.x : std::sqrt(1.0F - u.x);
    const float radius = std::sqrt(std::max(1.0F - l.z * l.z, 0.0F));
    l.x = radius * std::cos(2.0F * pi * u.y);
    l.y = radius * std::sin(2.0F * pi * u.y);
    return frame_ * l;
}

Scattered Bsdf::scatterMirror(const SpecularLobe& lobe, const vec3& share, float chance) const {
    Scattered s;
    s.direction = lobe.sample({});
    if (above(s.direction)) {
        s.weight.specular = share * lobe.mirrorShare() / chance;
    }
    return s;
}

// Shading normals may put a direction on the wrong side of the triangle, which then mirrors it.
Scattered Bsdf::scatterGlass(float choice, const vec2& u) const {
    const GlassLobe::Sample sample = glass_.sample(choice, u);
    Scattered s;
    s.direction = frame_ * sample.direction;
    s.throughGlass = true;
    s.crosses = sample.direction.z < 0.0F;
    if (above(s.direction) == s.crosses) {
        s.direction -= 2.0F * glm::dot(s.direction, geometricNormal_) * geometricNormal_;
    }
    const vec3 weight = s.crosses ? transmitted_ : vec3(reflectedInside_);
    s.weight.specular = weight * ((1.0F - coatAlbedo_) / chances_[glass]);
    s.pdf = glass_.delta() ? 0.0F : chances_[glass] * sample.pdf;
    return s;
}

Scattered Bsdf::scatter(float lobe, const vec2& u) const {
    size_t chosen = 0;
    while (chosen + 1 < lobes && lobe >= chances_[chosen]) {
        lobe -= chances_[chosen++];
    }
    const float chance = chances_[chosen];
    if (!(chance > 0.0F)) {  // rounding, or a black surface
        return {};
    }
    if (chosen == specular && specular_.mirror()) {
        return scatterMirror(specular_, vec3(1.0F - coatAlbedo_), chance);
    }
    if (chosen == coat && coat_.mirror()) {
        return scatterMirror(coat_, vec3(coatFactor_), chance);
    }
    Scattered s;
    if (chosen == glass) {
        s = scatterGlass(std::min(lobe / chance, 0x1.fffffep-1F), u);
        if (s.crosses || glass_.delta() || chance == 1.0F) {
            return s;  // no other lobe has that direction
        }
    } else {
        s.direction = chosen == specular ? specular_.sample(u)
                      : chosen == coat   ? coat_.sample(u)
                      : chosen == sheen  ? sheen_.sample(u)
                                         : sampleDiffuse(u, chosen == diffuse && uniform_);
        if (chosen == through) {
            s.direction -= 2.0F * glm::dot(s.direction, frame_[2]) * frame_[2];
        }
        if ((chosen == specular && !specular_.above(s.direction)) || (chosen == coat && !coat_.above(s.direction))) {
            return {};  // masked; what another lobe scatters there is not its concern
        }
    }
    s.pdf = pdf(s.direction);
    s.weight = {};
    if (s.pdf > 0.0F) {
        const Reflection r = reflect(s.direction);
        s.weight = {r.diffuse / s.pdf, r.specular / s.pdf};
    }
    return s;
}

}  // namespace reflet
