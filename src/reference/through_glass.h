// Rays through transmissive surfaces: the media around a path, and straight shadow rays.
#pragma once

#include "reference/glass.h"
#include "reference/ray_scene.h"
#include "reference/surface.h"

namespace reflet {

/// The boundary that a ray in these media crosses at the point.
Boundary boundaryAt(const SurfacePoint& point, const Media& media);

/// Updates the media of a ray that passes through the point's surface.
void cross(Media& media, const SurfacePoint& point);

/// Transmittance along a straight ray: glass attenuates by Fresnel reflection, base colour and volume absorption;
/// everything else blocks. media: those at the ray's origin.
vec3 straightTransmittance(const RayScene& rays, Ray ray, RayKind kind, Media media);

}  // namespace reflet
