// Microfacets of the GGX distribution, in a frame whose z axis is the surface's normal. (B. Walter, S. R. Marschner,
// H. Li, K. E. Torrance, Microfacet Models for Refraction through Rough Surfaces, EGSR 2007; E. Heitz, Sampling the GGX
// Distribution of Visible Normals, JCGT 2018)
#pragma once

#include "base/math.h"

#include <algorithm>
#include <cmath>

namespace reflet {

/// Lobes narrower than a hundredth of a degree are treated as perfectly smooth.
constexpr float mirrorAlpha = 1e-4F;

inline float square(float x) {
    return x * x;
}

/// Weight of Schlick's Fresnel (1994): F = F0 + (F90 - F0) · schlick(cosine).
inline float schlick(float cosine) {
    const float rest = std::clamp(1.0F - cosine, 0.0F, 1.0F);
    return square(square(rest)) * rest;
}

/// Smith's Lambda; masking is 1 / (1 + Lambda). alpha, here and below: along x and y.
inline float smithLambda(const vec3& w, const vec2& alpha) {
    const float stretched = square(alpha.x * w.x) + square(alpha.y * w.y);
    return 0.5F * (std::sqrt(1.0F + stretched / std::max(w.z * w.z, 1e-12F)) - 1.0F);
}
inline float smithLambda(const vec3& w, float alpha) {
    return smithLambda(w, vec2(alpha));
}

inline float ggxDensity(const vec3& h, const vec2& alpha) {
    // In terms of the slope, which keeps precision for narrow lobes.
    const float stretched = square(h.x / alpha.x) + square(h.y / alpha.y) + h.z * h.z;
    return 1.0F / (pi * alpha.x * alpha.y * square(stretched));
}
inline float ggxDensity(const vec3& h, float alpha) {
    return ggxDensity(h, vec2(alpha));
}

/// Samples the normals visible from v; u in [0, 1)².
vec3 sampleVisibleNormal(const vec3& v, const vec2& alpha, const vec2& u);
inline vec3 sampleVisibleNormal(const vec3& v, float alpha, const vec2& u) {
    return sampleVisibleNormal(v, vec2(alpha), u);
}

/// Pdf of sampleVisibleNormal, per solid angle of the normal.
inline float visibleNormalPdf(const vec3& v, const vec3& h, float alpha) {
    return ggxDensity(h, alpha) * std::max(glm::dot(v, h), 0.0F) / ((1.0F + smithLambda(v, alpha)) * v.z);
}

/// G2 / G1: fraction of the light reflected by microfacets visible from v that is not masked toward l.
inline float unmasked(const vec3& v, const vec3& l, float alpha) {
    const float toView = smithLambda(v, alpha);
    return (1.0F + toView) / (1.0F + toView + smithLambda(l, alpha));
}

/// Directional albedo of the single-scattering GGX lobe as scale · F0 + bias; F0 is the reflectance at normal incidence
/// (Schlick's Fresnel). Interpolated in a table that is computed on first use.
/// cosine: of the angle between normal and viewer, 0..1; roughness: perceptual, 0..1.
struct LobeAlbedo {
    float scale = 0.0F;
    float bias = 0.0F;
};
LobeAlbedo ggxAlbedo(float cosine, float roughness);

/// Directional albedo of a layer of this reflectance including multiple scattering, from that of single scattering.
inline vec3 compensated(const vec3& f0, float f90, const LobeAlbedo& a) {
    const float lost = 1.0F / std::max(a.scale + a.bias, 1e-3F) - 1.0F;
    return (f0 * a.scale + f90 * a.bias) * (1.0F + f0 * lost);
}

/// Right-handed orthonormal frame around n, as columns; n is the last.
mat3 frameAround(const vec3& n);

}  // namespace reflet
