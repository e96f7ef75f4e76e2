// Rays through transmissive surfaces: the media around a path, and straight shadow rays.
#pragma once

#include "reference/glass.h"
#include "reference/ray_scene.h"
#include "reference/surface.h"

namespace reflet {

/// What a ray in these media crosses at the point.
Boundary boundaryAt(const SurfacePoint& point, const Media& media);

/// Follows a ray through the point's surface.
void cross(Media& media, const SurfacePoint& point);

/// Share of the light that arrives along a straight ray: glass attenuates it by Fresnel's reflection, its base colour
/// and its volume, and everything else blocks it. media: those at the ray's origin.
vec3 straightTransmittance(const RayScene& rays, Ray ray, RayKind kind, Media media);

}  // namespace reflet
