// Specialization by the materials that are drawn: features that none of them has cost nothing.
#ifndef REFLET_MATERIAL_FEATURES_GLSL
#define REFLET_MATERIAL_FEATURES_GLSL

#include "effects/gbuffer/gbuffer.h"

layout(constant_id = 40) const uint materialFeatures = 0u;  // bit mask of materialFeature…

bool mayBeUnlit() { return (materialFeatures & materialFeatureUnlit) != 0u; }
bool mayHaveSheen() { return (materialFeatures & materialFeatureSheen) != 0u; }
bool mayBeAnisotropic() { return (materialFeatures & materialFeatureAnisotropy) != 0u; }
bool mayReflectUnusually() { return (materialFeatures & materialFeatureReflectance) != 0u; }

// F0 over dielectricF0, and F90, of a dielectric; color, weight: of KHR_materials_specular, with F0 by
// KHR_materials_ior in the colour. Exactly 1 for materials with neither.
vec4 reflectanceTexel(vec3 color, float weight) { return vec4(min(color, vec3(25.0)) * weight, weight); }

#endif
