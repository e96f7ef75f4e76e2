// The volumes of glass or water (KHR_materials_volume) that a point, such as a camera, is inside.
//
// A point is inside a mesh if the triangles wind around it: their solid angles, positive where the front face looks
// away, sum up to 4 pi. Unlike counting the crossings of rays, that has no bad directions, and small holes do no harm.
// (A. Jacobson, L. Kavan, O. Sorkine-Hornung, Robust Inside-Outside Segmentation using Generalized Winding Numbers,
// 2013; A. Van Oosterom, J. Strackee, The Solid Angle of a Plane Triangle, 1983)
#pragma once

#include "scene/pose.h"

#include <span>

namespace reflet {

/// How often the triangles wind around the point: 1 inside a closed mesh whose front faces look outwards, 0 outside.
double windingNumber(std::span<const vec3> positions, std::span<const uint32_t> indices, const vec3& point);

/// Whether the material's surface bounds a volume that light passes.
bool boundsVolume(const Material& material);

/// Indices of the instances whose volumes the point is in, the innermost one last. pose: of an animated scene. Those
/// whose bounds do not hold the point cost nothing, except where they are deformed.
std::vector<uint32_t> volumesAround(const Scene& scene, const ScenePose* pose, const vec3& point);

/// Around the camera. An orthographic one is in none: its rays start all over a plane.
std::vector<uint32_t> volumesAround(const Scene& scene, const ScenePose* pose, const Camera& camera);

}  // namespace reflet
