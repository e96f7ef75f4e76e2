// Flat mirrors that reflect the sun onto other surfaces. A path finds the sun in a mirror only if it hits the mirror
// within a fraction of a degree of the right direction: one in ten thousand does. So next-event estimation from other
// surfaces also samples the path over each mirror, which has one direction for each point of the sun's disk.
#pragma once

#include "reference/surface.h"

#include <vector>

namespace reflet {

class SunMirrors {
public:
    /// toSun: unit. Finds the few planes that reflect the most light. Other mirrors are left to random paths.
    SunMirrors(const RayScene& rays, const vec3& toSun);

    /// Planes of the mirrors. dot(plane, (p, 1)): metres in front of it; unit normals, on the sun's side.
    [[nodiscard]] const std::vector<vec4>& planes() const { return planes_; }
    /// Whether the point lies on the mirror's surface. Sunlight over exactly these points is sampled through `planes`.
    [[nodiscard]] static bool isOn(const vec4& plane, const SurfacePoint& point);
    [[nodiscard]] bool isOnAny(const SurfacePoint& point) const;

    /// Whether paths over mirrors are sampled from the point: not from mirrors, whose own paths find the sun.
    [[nodiscard]] bool startsFrom(const SurfacePoint& point) const;

private:
    std::vector<vec4> planes_;
};

}  // namespace reflet
