// The sheen lobe (KHR_materials_sheen): A. C. Estevez, C. Kulla, Production Friendly Microfacet Sheen BRDF,
// SIGGRAPH 2017 course. Shares no code with src/shaders/sheen.glsl.
#pragma once

#include "base/math.h"

namespace reflet {

/// Directional albedo of a white sheen, 0..1. cosine: between normal and viewer; roughness: perceptual.
float sheenAlbedo(float cosine, float roughness);

/// The sheen BRDF toward a viewer. Directions are in world space.
class SheenLobe {
public:
    SheenLobe() = default;
    /// frame: tangent, bitangent, normal; view: in that frame, z > 0; color: sheen colour, 0..1.
    SheenLobe(const mat3& frame, const vec3& view, const vec3& color, float roughness);

    /// BRDF · cosine; 0 from below the surface.
    [[nodiscard]] vec3 reflect(const vec3& toLight) const;
    /// Directional albedo toward the viewer, of the strongest channel: layers beneath get the rest.
    [[nodiscard]] float albedo() const { return albedo_; }
    /// Uniform sample of the hemisphere: the lobe is wide and has no good fit. u in [0, 1)².
    [[nodiscard]] vec3 sample(const vec2& u) const;
    /// Pdf of sample() above the surface.
    static constexpr float pdf = 0.5F / pi;

private:
    mat3 frame_{1.0F};
    vec3 view_{0, 0, 1};
    vec3 color_{0.0F};
    float alpha_ = 1.0F;
    float albedo_ = 0.0F;
};

}  // namespace reflet
