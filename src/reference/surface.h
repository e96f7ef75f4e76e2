// The surface at a hit: position, normals and material.
#pragma once

#include "reference/glass.h"
#include "reference/ray_scene.h"
#include "reference/specular_lobe.h"

namespace reflet {

/// KHR_materials_clearcoat at a point.
struct CoatPoint {
    float factor = 0.0F;
    float roughness = 0.0F;
    vec3 normal{0.0F};  ///< unit, on the side of the ray's origin
};

/// KHR_materials_sheen at a point.
struct SheenPoint {
    vec3 color{0.0F};
    float roughness = 0.0F;
};

/// KHR_materials_anisotropy at a point: GGX's alpha along the direction and across it.
struct AnisotropyPoint {
    vec3 direction{0.0F};  ///< unit, perpendicular to the shading normal; 0: isotropic
    vec2 alpha{1.0F};
};

struct SurfacePoint {
    vec3 position{0.0F};
    vec3 geometricNormal{0.0F};  ///< unit, of the triangle, facing the ray's origin
    vec3 normal{0.0F};           ///< unit, shading normal on the same side of the surface as the geometric one
    vec3 toOrigin{0.0F};         ///< unit, opposite to the ray
    vec3 baseColor{0.0F};
    float roughness = 1.0F;  ///< perceptual
    float metallic = 0.0F;
    Reflectance dielectric{vec3(0.04F), 1.0F};  ///< of the material's dielectric part, in air
    vec3 specularTint{1.0F};                    ///< tint of its reflectance at normal incidence
    float specularStrength = 1.0F;
    float transmission = 0.0F;  ///< share of the light in the base that passes the surface; 0: opaque
    bool bounded = false;       ///< the surface bounds a volume
    Medium medium;              ///< of that volume
    CoatPoint coat;
    SheenPoint sheen;
    AnisotropyPoint anisotropy;
    vec3 diffuseTransmission{0.0F};         ///< albedo of the diffuse light that leaves on the other side
    float diffuseTransmissionShare = 0.0F;  ///< transmitted share of the diffuse light; 0: none
    bool unlit = false;                     ///< reflects nothing
    vec3 emission{0.0F};     ///< radiance toward the ray's origin; 0 from the back of single-sided surfaces
    float clearance = 0.0F;  ///< offset of new rays from the surface, to avoid self-intersection [m]
    bool front = true;       ///< the ray hit the front face
    Hit hit;

    /// Reflectance between media of these indices of refraction. For glass, F90 vanishes with the difference of the
    /// indices: equal media do not reflect at all.
    [[nodiscard]] Reflectance dielectricBetween(float near, float far) const;

    /// Origin of a ray to `direction`.
    [[nodiscard]] vec3 rayOrigin(const vec3& direction) const {
        return position + geometricNormal * (glm::dot(direction, geometricNormal) < 0.0F ? -clearance : clearance);
    }
};

/// The shading normal; if its mirror direction is below the surface, it is bent toward the geometric normal until that
/// is just above, so that it never faces away from the viewer. Specified in src/shaders/shading_normal.glsl. All unit,
/// `geometric` on the viewer's side.
vec3 consistentNormal(const vec3& normal, const vec3& geometric, const vec3& toViewer);

/// The volume that the instance's surface bounds.
Medium mediumOf(const RayScene& rays, uint32_t instance);

SurfacePoint surfaceAt(const RayScene& rays, const Hit& hit, const vec3& direction);

/// Whether the material's alpha is below its cutoff there; below `blendedCutoff` if it is blended.
bool isCutOut(const RayScene& rays, const Hit& hit, float blendedCutoff);

/// Coverage of the surface: 1, alpha for blended surfaces, 0 where it is cut out.
float coverageAt(const RayScene& rays, const Hit& hit);

/// Textured emission of the front face.
vec3 emissionAt(const RayScene& rays, const Hit& hit);

}  // namespace reflet
