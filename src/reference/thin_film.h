// Reflectance of a thin film over a surface: L. Belcour, P. Barla, A Practical Extension to Microfacet Theory for the
// Modeling of Varying Iridescence, SIGGRAPH 2017, as KHR_materials_iridescence simplifies it.
#pragma once

#include "base/math.h"

namespace reflet {

struct ThinFilm {
    float ior = 1.3F;
    float thickness = 0.0F;  ///< [nm]

    /// Reflectance for light that comes through air at that angle. f0: of the surface beneath, in air, 0..1.
    [[nodiscard]] vec3 reflectance(float cosine, const vec3& f0) const;
    /// The F0 for which Schlick's approximation is exact at that angle.
    [[nodiscard]] vec3 f0At(float cosine, const vec3& f0) const;
};

}  // namespace reflet
