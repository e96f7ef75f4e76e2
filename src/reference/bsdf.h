// The surface model: Lambert under GGX with height-correlated Smith masking-shadowing (Walter et al. 2007; Heitz 2014).
// The energy lost by single scattering is compensated by its directional albedo (Turquin 2019); the diffuse base
// receives
// what the specular layer does not reflect. Specified in docs/conventions.md; shares no code with src/shaders/ggx.glsl.
#pragma once

#include "reference/reference.h"
#include "reference/surface.h"

namespace reflet {

/// Directional albedo of the single-scattering GGX lobe as scale · F0 + bias; F0 is the reflectance at normal incidence
/// (Schlick's Fresnel). Interpolated in a table that is computed on first use.
/// cosine: of the angle between normal and viewer, 0..1; roughness: perceptual, 0..1.
struct LobeAlbedo {
    float scale = 0.0F;
    float bias = 0.0F;
};
LobeAlbedo ggxAlbedo(float cosine, float roughness);

/// Reflected radiance is incident radiance · (diffuse + specular).
struct Reflection {
    vec3 diffuse{0.0F};
    vec3 specular{0.0F};

    [[nodiscard]] vec3 sum() const { return diffuse + specular; }
};

/// A sampled direction. `weight` is BRDF · cosine / pdf.
struct Scattered {
    vec3 direction{0.0F};
    Reflection weight;
    float pdf = 0.0F;  ///< per solid angle; 0: a perfect mirror, a delta lobe
};

/// Reflection of a surface point toward the ray's origin.
class Bsdf {
public:
    Bsdf(const SurfacePoint& point, const ReferenceOptions& options);

    /// BRDF · cosine for light from that direction, without delta lobes; 0 from below the surface.
    [[nodiscard]] Reflection reflect(const vec3& toLight) const { return evaluate(toLight, alpha_, !mirror_); }
    /// The same for the sun and lamps. As in the renderer, roughness is at least 0.045, so that punctual lights have a
    /// highlight even in mirrors.
    [[nodiscard]] Reflection reflectLamp(const vec3& toLight) const;

    /// Samples a direction: `lobe` selects the lobe, u the direction in it; both in [0, 1). The weight is 0 if the
    /// direction
    /// is below the surface.
    [[nodiscard]] Scattered scatter(float lobe, const vec2& u) const;
    /// Pdf of scatter() for that direction.
    [[nodiscard]] float pdf(const vec3& direction) const;

private:
    [[nodiscard]] Reflection evaluate(const vec3& toLight, float alpha, bool withSpecular) const;
    [[nodiscard]] vec3 specularLobe(const vec3& l, float alpha) const;
    [[nodiscard]] float visibleNormalPdf(const vec3& l) const;
    [[nodiscard]] vec3 local(const vec3& world) const { return world * frame_; }  // the frame's transpose
    [[nodiscard]] bool above(const vec3& world) const;

    mat3 frame_;  ///< tangent, bitangent, shading normal
    vec3 geometricNormal_;
    vec3 view_;     ///< local, z > 0
    vec3 diffuse_;  ///< albedo of the diffuse base, attenuated by the specular layer
    vec3 f0_{0.0F};
    float f90_ = 1.0F;
    vec3 compensation_{0.0F};
    float alpha_ = 1.0F;
    bool mirror_ = false;
    bool uniform_;
    float specularChance_ = 0.0F;
};

/// Right-handed orthonormal frame around n, as columns; n is the last.
mat3 frameAround(const vec3& n);

}  // namespace reflet
