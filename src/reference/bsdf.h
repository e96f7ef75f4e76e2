// The surface model: Lambert under GGX. The diffuse base receives the light that the specular layer does not reflect; a
// share of it may be transmitted instead, refracted (glass.h) or diffusely. A sheen may lie over both, and a clear coat
// over everything. Specified in docs/conventions.md; shares no code with src/shaders/ggx.glsl.
#pragma once

#include "reference/glass.h"
#include "reference/reference.h"
#include "reference/sheen_lobe.h"
#include "reference/specular_lobe.h"
#include "reference/surface.h"

#include <array>

namespace reflet {

/// Reflected and transmitted radiance is incident radiance · (diffuse + specular).
struct Reflection {
    vec3 diffuse{0.0F};   ///< includes sheen
    vec3 specular{0.0F};  ///< includes transmitted light

    [[nodiscard]] vec3 sum() const { return diffuse + specular; }
};

/// A sampled direction. `weight` is BSDF · cosine / pdf.
struct Scattered {
    vec3 direction{0.0F};
    Reflection weight;
    float pdf = 0.0F;           ///< per solid angle; 0: a perfectly smooth surface, a delta lobe
    bool throughGlass = false;  ///< transmitted, or reflected inside
    bool crosses = false;       ///< crosses to the other side of the surface
};

/// Scattering at a surface point toward the ray's origin.
class Bsdf {
public:
    /// boundary: the boundary that the ray crosses at the point, if the point is transmissive.
    Bsdf(const SurfacePoint& point, const ReferenceOptions& options, const Boundary& boundary = {});

    /// BSDF · cosine for light from that direction, without delta lobes.
    [[nodiscard]] Reflection reflect(const vec3& toLight) const;
    /// The same for the sun and lamps, which are not seen through glass. As in the renderer, roughness is at least
    /// 0.045, so that punctual lights have a highlight even in mirrors.
    [[nodiscard]] Reflection reflectLamp(const vec3& toLight) const;

    /// Directional albedo of the specular layer toward the ray's origin.
    [[nodiscard]] const vec3& specularAlbedo() const { return specularAlbedo_; }

    /// Samples a direction: `lobe` selects the lobe, u the direction in it; both in [0, 1). The weight is 0 for
    /// directions from which no light is scattered.
    [[nodiscard]] Scattered scatter(float lobe, const vec2& u) const;
    /// Pdf of scatter() for that direction.
    [[nodiscard]] float pdf(const vec3& direction) const;

private:
    enum Lobe : uint8_t { specular, diffuse, sheen, glass, coat, through, lobes };

    void setSheen(const SurfacePoint& point);
    void setSpecular(const SurfacePoint& point, const Reflectance& both, const LobeAlbedo& table);
    void setLayers(const SurfacePoint& point, const Boundary& boundary);
    void setCoat(const SurfacePoint& point);
    void setChances();
    [[nodiscard]] Reflection evaluate(const vec3& toLight, float leastAlpha) const;
    [[nodiscard]] vec3 sampleDiffuse(const vec2& u, bool uniform) const;
    [[nodiscard]] Scattered scatterMirror(const SpecularLobe& lobe, const vec3& share, float chance) const;
    [[nodiscard]] Scattered scatterGlass(float choice, const vec2& u) const;
    [[nodiscard]] bool above(const vec3& world) const { return glm::dot(world, geometricNormal_) > 0.0F; }

    mat3 frame_;  ///< tangent, bitangent, shading normal
    vec3 geometricNormal_;
    vec3 view_;           ///< local, z > 0
    vec3 diffuse_;        ///< albedo of the diffuse base, attenuated by the specular layer
    vec3 through_{0.0F};  ///< the same for diffuse transmission, of light from the other side
    bool uniform_;
    SpecularLobe specular_;
    vec3 specularAlbedo_{0.0F};
    GlassLobe glass_;
    vec3 transmitted_{0.0F};        ///< weight of the glass lobe's transmitted light
    float reflectedInside_ = 0.0F;  ///< weight of the light that an inner boundary reflects
    SheenLobe sheen_;
    SpecularLobe coat_;
    float coatAlbedo_ = 0.0F;
    float coatFactor_ = 0.0F;
    std::array<float, lobes> chances_{0.0F, 1.0F, 0.0F, 0.0F, 0.0F, 0.0F};
};

}  // namespace reflet
