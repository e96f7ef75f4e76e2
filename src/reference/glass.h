// Light at a boundary of glass: rough refraction with total internal reflection, and sheets that are thinner than a
// pixel. (B. Walter, S. R. Marschner, H. Li, K. E. Torrance, Microfacet Models for Refraction through Rough Surfaces,
// EGSR 2007)
//
// Light that the microfacets mask is not lost, as in Walter's model: the lobe's directional albedo is 1, and directions
// that leave on the wrong side are mirrored at the surface, as if scattered once more.
#pragma once

#include "base/math.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>

namespace reflet {

/// What a ray crosses at a transmissive surface.
struct Boundary {
    enum class Kind : uint8_t {
        none,   ///< nothing changes there: the ray goes straight on
        thin,   ///< a sheet: the ray keeps its direction, but for roughness
        outer,  ///< from air into a volume
        inner,  ///< from inside a volume, into air or another volume
    };

    Kind kind = Kind::outer;
    float near = 1.0F;  ///< index of refraction on the ray's side
    float far = 1.0F;   ///< on the other side
};

/// Reflectance of a smooth boundary as by Schlick (1994), from the side with that cosine. eta: index of the far side
/// over that of the near side. 1: total internal reflection.
float boundaryReflectance(float cosine, float eta, float f0, float f90);

/// The direction on the other side of light that arrives against v at a surface of normal h, dot(v, h) > 0; nullopt:
/// total internal reflection. All unit.
std::optional<vec3> refracted(const vec3& v, const vec3& h, float eta);

/// A lobe at a boundary, for light toward `view`, z > 0, in the frame of the surface. An outer or a thin one only
/// transmits, because the surface's specular lobe reflects; an inner one does both.
class GlassLobe {
public:
    struct Sample {
        vec3 direction{0.0F};  ///< z < 0: transmitted
        float pdf = 0.0F;      ///< 0: a delta lobe
    };

    GlassLobe() = default;
    /// alpha: of GGX. f0, f90: reflectance at normal and grazing incidence.
    GlassLobe(const Boundary& boundary, const vec3& view, float alpha, float f0, float f90);

    [[nodiscard]] bool delta() const { return straight_ || smooth_; }
    /// Pdf of sample() per solid angle, and so the lobe's BSDF times cosine; 0 of delta lobes.
    [[nodiscard]] float pdf(const vec3& direction) const;
    /// choice: between reflection and transmission, in [0, 1).
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
    bool straight_ = true;  ///< no direction changes, whatever the roughness
    bool smooth_ = true;
};

/// A volume that a ray is in.
struct Medium {
    uint32_t instance = 0;
    float ior = 1.0F;
    vec3 extinction{0.0F};    ///< per metre
    float dispersion = 0.0F;  ///< Transmission::dispersion

    /// Its index of refraction for red, green or blue light: 0, 1 or 2. (KHR_materials_dispersion: (ior - 1) / Abbe
    /// number between red and blue)
    [[nodiscard]] float iorOf(uint32_t channel) const {
        return std::max(ior + (ior - 1.0F) * dispersion * 0.025F * (static_cast<float>(channel) - 1.0F), 1.0F);
    }
};

/// The volumes around a ray. The one that was entered last counts where several overlap; more than fit are left out.
class Media {
public:
    void enter(const Medium& medium);
    /// Of the light of that channel alone, in all these volumes (Medium::iorOf). Call it only once.
    void disperse(uint32_t channel);
    void leave(uint32_t instance);

    /// That of the innermost volume, or of air.
    [[nodiscard]] float ior() const { return count_ > 0 ? stack_[count_ - 1].ior : 1.0F; }
    [[nodiscard]] bool inside() const { return count_ > 0; }
    /// Share of the light that is left after `distance` metres. (A. Beer, 1852)
    [[nodiscard]] vec3 transmittance(float distance) const;
    /// What a ray crosses on the outside of the volume, or on its inside.
    [[nodiscard]] Boundary boundary(const Medium& volume, bool front) const;

private:
    std::array<Medium, 8> stack_;
    size_t count_ = 0;
};

}  // namespace reflet
