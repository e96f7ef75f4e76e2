// The volumes of glass or water (KHR_materials_volume) that a point, such as a camera, is inside.
//
// A point is inside a mesh if the triangles wind around it: their solid angles, positive where the front face looks
// away, sum up to 4 pi. Unlike counting the crossings of rays, that has no bad directions, and small holes do no harm.
// (A. Jacobson, L. Kavan, O. Sorkine-Hornung, Robust Inside-Outside Segmentation using Generalized Winding Numbers,
// 2013; A. Van Oosterom, J. Strackee, The Solid Angle of a Plane Triangle, 1983)
#pragma once

#include "scene/pose.h"

#include <limits>
#include <span>
#include <vector>

namespace reflet {

struct Winding {
    /// How often the triangles wind around the point: 1 inside a closed mesh whose front faces look outwards, 0
    /// outside.
    double number = 0.0;
    double clearance = std::numeric_limits<double>::infinity();  ///< no triangle is nearer to the point [m]
};

Winding windingAround(std::span<const vec3> positions, std::span<const uint32_t> indices, const vec3& point);

/// Whether the material's surface bounds a volume that light passes.
bool boundsVolume(const Material& material);

/// The volumes of one scene around a point that moves. Triangles are read only of volumes whose bounds hold the point,
/// and only once it may have come to another side of them; of deformed ones always.
class VolumeFinder {
public:
    /// Indices of the instances whose volumes the point is in, the innermost one last. pose: of an animated scene.
    std::vector<uint32_t> around(const Scene& scene, const ScenePose* pose, const vec3& point);
    /// Around the camera. An orthographic one is in none: its rays start all over a plane.
    std::vector<uint32_t> around(const Scene& scene, const ScenePose* pose, const Camera& camera);

    /// For tests: how often triangles of an instance were read.
    [[nodiscard]] uint32_t searches() const { return searches_; }

private:
    struct Known {
        vec3 point{0.0F};        ///< in object space
        double clearance = 0.0;  ///< as Winding::clearance
        bool inside = false;
    };

    bool isInsideRigid(const Mesh& mesh, const mat4& objectToWorld, const vec3& point, Known& known);

    std::vector<Known> known_;  ///< per instance
    uint32_t searches_ = 0;
};

}  // namespace reflet
