// From which side a scene is seen best, by what is visible from each.
#pragma once

#include "base/math.h"

#include <array>
#include <optional>
#include <vector>

namespace reflet {

/// World space; front faces are counter-clockwise.
struct FramedTriangle {
    std::array<vec3, 3> corners;
    bool doubleSided = false;
};

/// From the front (+Z), the right, and slightly above. Unit length.
vec3 threeQuarterView();

/// The first view direction, of a fixed list that begins with the three-quarter view, that shows at least 60 % of the
/// front-facing area that the best one does. Visible backs of double-sided triangles count against a direction.
/// nullopt: all directions show mainly backs; the triangles enclose a room.
std::optional<vec3> bestViewDirection(const std::vector<FramedTriangle>& triangles, const Aabb& box);

/// Position and target of a view through a room along its longer side, at half its height or nearly so. nullopt: the
/// middle is inside an object, or there is not enough room.
struct InsideView {
    vec3 position;
    vec3 target;
};
std::optional<InsideView> viewInside(const std::vector<FramedTriangle>& triangles, const Aabb& box);

}  // namespace reflet
