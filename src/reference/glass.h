// Light at a boundary of glass: rough refraction with total internal reflection, and thin sheets. (B. Walter,
// S. R. Marschner, H. Li, K. E. Torrance, Microfacet Models for Refraction through Rough Surfaces, EGSR 2007)
//
// Unlike in Walter's model, light masked by microfacets is not lost: the lobe's directional albedo is 1, and directions
// that leave on the wrong side are mirrored at the surface, as if scattered once more.
#pragma once

#include "base/math.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>

namespace reflet {

/// The boundary that a ray crosses at a transmissive surface.
struct Boundary {
    enum class Kind : uint8_t {
        none,   ///< no change of medium: the ray continues straight
        thin,   ///< a thin sheet: the ray keeps its direction, except for roughness
        outer,  ///< from air into a volume
        inner,  ///< from inside a volume, into air or another volume
    };

    Kind kind = Kind::outer;
    float near = 1.0F;  ///< index of refraction on the ray's side
    float far = 1.0F;   ///< on the other side
};

/// Reflectance of a smooth boundary by Schlick (1994). cosine: on the near side. eta: index of refraction of the far
/// side over that of the near side. Returns 1 for total internal reflection.
float boundaryReflectance(float cosine, float eta, float f0, float f90);

/// Refracts direction v at a surface of normal h, dot(v, h) > 0: the direction on the other side. nullopt: total
/// internal reflection. All unit.
std::optional<vec3> refracted(const vec3& v, const vec3& h, float eta);

/// A lobe at a boundary, for light toward `view`, z > 0, in the surface's frame. Outer and thin boundaries only
/// transmit, because the surface's specular lobe reflects; inner ones do both.
class GlassLobe {
public:
    struct Sample {
        vec3 direction{0.0F};  ///< z < 0: transmitted
        float pdf = 0.0F;      ///< 0: a delta lobe
    };

    GlassLobe() = default;
    /// alpha: GGX width. f0, f90: reflectance at normal and grazing incidence.
    GlassLobe(const Boundary& boundary, const vec3& view, float alpha, float f0, float f90);

    [[nodiscard]] bool delta() const { return straight_ || smooth_; }
    /// Pdf of sample() per solid angle, which equals the lobe's BSDF times cosine; 0 for delta lobes.
    [[nodiscard]] float pdf(const vec3& direction) const;
    /// choice: selects reflection or transmission, in [0, 1).
    [[nodiscard]] Sample sample(float choice, const vec2& u) const;

private:
    [[nodiscard]] float reflectedPdf(const vec3& l) const;
    [[nodiscard]] float transmittedPdf(const vec3& l) const;
    [[nodiscard]] float reflectance(const vec3& h) const;

    Boundary::Kind kind_ = Boundary::Kind::none;
    vec3 view_{0, 0, 1};
    float alpha_ = 0.0F;
    float eta_ = 1.0F;
    float f0_ = 0.0F;
    float f90_ = 0.0F;
    bool straight_ = true;  ///< directions do not change, whatever the roughness
    bool smooth_ = true;
};

/// A volume that a ray is in.
struct Medium {
    uint32_t instance = 0;
    float ior = 1.0F;
    vec3 extinction{0.0F};    ///< per metre
    float dispersion = 0.0F;  ///< Transmission::dispersion

    /// Index of refraction for red, green or blue light (channel 0, 1 or 2). (KHR_materials_dispersion: (ior - 1) /
    /// Abbe number between red and blue)
    [[nodiscard]] float iorOf(uint32_t channel) const {
        return std::max(ior + (ior - 1.0F) * dispersion * 0.025F * (static_cast<float>(channel) - 1.0F), 1.0F);
    }
};

/// The stack of volumes around a ray. Where several overlap, the last one entered counts; those that do not fit are
/// ignored.
class Media {
public:
    void enter(const Medium& medium);
    /// Sets all indices of refraction to those of one colour channel (Medium::iorOf). Call it only once.
    void disperse(uint32_t channel);
    void leave(uint32_t instance);

    /// Index of refraction of the innermost volume, or of air.
    [[nodiscard]] float ior() const { return count_ > 0 ? stack_[count_ - 1].ior : 1.0F; }
    [[nodiscard]] bool inside() const { return count_ > 0; }
    /// Share of the light that is left after `distance` metres. (A. Beer, 1852)
    [[nodiscard]] vec3 transmittance(float distance) const;
    /// The boundary that a ray crosses at the volume's surface, from outside (front) or inside.
    [[nodiscard]] Boundary boundary(const Medium& volume, bool front) const;

private:
    std::array<Medium, 8> stack_;
    size_t count_ = 0;
};

}  // namespace reflet
