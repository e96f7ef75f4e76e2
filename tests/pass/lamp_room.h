// A room with lamps and boxes, where the visibility of each lamp is known from geometry.
#pragma once

#include "pass/harness.h"

#include <vector>

namespace reflet::test {

constexpr float roomHalf = 3.0F;  ///< metres from the middle to each wall

Material bothSides();

Lamp lampAt(Lamp::Type type, const vec3& position, const vec3& direction = {0, -1, 0});

Aabb boxAround(const vec3& center, const vec3& half);

/// Whether the way from p to the lamp meets a box.
bool meets(const Aabb& box, const vec3& p, const vec3& lamp);

/// Walls without thickness around the origin, and boxes.
struct Room {
    Scene scene = sceneOf(bothSides(), builtin::box(vec3(roomHalf)));
    std::vector<Aabb> boxes;

    void add(const Aabb& box);
};

/// Views from one corner and from the opposite one: together they show all walls.
std::vector<View> viewsOfRoom();

/// Metres from a point on a wall to the next wall.
float distanceToCrease(const vec3& p);

/// Not on a box, and in no crease.
bool onOneWall(const vec3& p);

/// Of a point on a wall: +X -X +Y -Y +Z -Z.
size_t wallOf(const vec3& p);

}  // namespace reflet::test
