// Flat mirrors that reflect the sun onto other surfaces. A path finds the sun in a mirror only if it hits the mirror
// within a fraction of a degree of the right direction: one in ten thousand does. So from other surfaces the way over
// each mirror is tried on purpose, which has one direction for each point of the sun's disk.
#pragma once

#include "reference/surface.h"

#include <vector>

namespace reflet {

class SunMirrors {
public:
    /// toSun: unit. Finds the planes, a few, that bring most light. Other mirrors are left to chance.
    SunMirrors(const RayScene& rays, const vec3& toSun);

    /// dot(plane, (p, 1)): metres in front of it; unit normals, on the sun's side.
    [[nodiscard]] const std::vector<vec4>& planes() const { return planes_; }
    /// Whether the point lies on the mirror's surface. The sun's light over such points is what `planes` stand for, and
    /// no other.
    [[nodiscard]] static bool isOn(const vec4& plane, const SurfacePoint& point);
    [[nodiscard]] bool isOnAny(const SurfacePoint& point) const;

    /// Whether the way over mirrors is tried from the point: not from mirrors, from where paths find it by themselves.
    [[nodiscard]] bool startsFrom(const SurfacePoint& point) const;

private:
    std::vector<vec4> planes_;
};

}  // namespace reflet
