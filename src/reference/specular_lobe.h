// The lobe of a GGX layer with height-correlated Smith masking-shadowing (Walter et al. 2007; Heitz 2014). The energy
// lost by single scattering is compensated by its directional albedo (Turquin 2019).
#pragma once

#include "base/math.h"
#include "reference/microfacet.h"

namespace reflet {

/// Reflectance of a layer at normal and at grazing incidence.
struct Reflectance {
    vec3 f0{0.0F};
    float f90 = 1.0F;
};

/// The BRDF of a layer toward a viewer. Directions are in world space.
class SpecularLobe {
public:
    SpecularLobe() = default;
    /// alpha: GGX width along tangent and bitangent; albedo: directional albedo of the layer; table: the same for
    /// single scattering.
    SpecularLobe(const mat3& frame, const vec3& view, const vec2& alpha, const Reflectance& reflectance,
                 const vec3& albedo, const LobeAlbedo& table);

    [[nodiscard]] bool mirror() const { return std::max(alpha_.x, alpha_.y) < mirrorAlpha; }
    /// BRDF · cosine, with alpha at least `leastAlpha`; 0 from below the surface, and for mirrors unless `leastAlpha`
    /// widens them.
    [[nodiscard]] vec3 reflect(const vec3& toLight, float leastAlpha = 0.0F) const;
    /// Pdf of sample(); 0 for mirrors.
    [[nodiscard]] float pdf(const vec3& direction) const;
    /// Samples a direction. It may be below the surface, where nothing is reflected.
    [[nodiscard]] vec3 sample(const vec2& u) const;
    [[nodiscard]] bool above(const vec3& direction) const { return glm::dot(direction, frame_[2]) > 0.0F; }
    /// Reflectance of a mirror, for its single light direction.
    [[nodiscard]] vec3 mirrorShare() const;

private:
    [[nodiscard]] vec3 fresnel(float cosine) const {
        return reflectance_.f0 + (reflectance_.f90 - reflectance_.f0) * schlick(cosine);
    }

    mat3 frame_{1.0F};  ///< tangent, bitangent, normal
    vec3 view_{0, 0, 1};
    vec2 alpha_{1.0F};
    Reflectance reflectance_;
    vec3 compensation_{0.0F};
};

/// The direction to the viewer in the frame, clamped so as not to face away, as shading normals may.
vec3 viewIn(const mat3& frame, const vec3& toViewer);

}  // namespace reflet
