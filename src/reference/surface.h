// The surface that a ray has hit: where it is, how it faces, what it is made of.
#pragma once

#include "reference/ray_scene.h"

namespace reflet {

struct SurfacePoint {
    vec3 position{0.0F};
    vec3 geometricNormal{0.0F};  ///< unit, of the triangle, toward where the ray came from
    vec3 normal{0.0F};           ///< unit, shading normal on the same side of the surface as the geometric one
    vec3 toOrigin{0.0F};         ///< unit, against the ray
    vec3 baseColor{0.0F};
    float roughness = 1.0F;  ///< perceptual
    float metallic = 0.0F;
    vec3 emission{0.0F};     ///< radiance toward the ray's origin: surfaces emit from the side that they show
    float clearance = 0.0F;  ///< how far off the surface a ray starts so as not to hit it again [m]
    bool front = true;       ///< the ray came from the outer side
    Hit hit;

    /// Where a ray to `direction` starts.
    [[nodiscard]] vec3 rayOrigin(const vec3& direction) const {
        return position + geometricNormal * (glm::dot(direction, geometricNormal) < 0.0F ? -clearance : clearance);
    }
};

SurfacePoint surfaceAt(const RayScene& rays, const Hit& hit, const vec3& direction);

/// The material's alpha is under its cutoff there.
bool isCutOut(const RayScene& rays, const Hit& hit);

/// Emission of a surface as seen from its front, texture included.
vec3 emissionAt(const RayScene& rays, const Hit& hit);

}  // namespace reflet
