#include "pass/lamp_room.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace reflet::test {

Material bothSides() {
    Material material = lambertMaterial(vec3(0.5F));
    material.doubleSided = true;
    return material;
}

Lamp lampAt(Lamp::Type type, const vec3& position, const vec3& direction) {
    Lamp lamp;
    lamp.type = type;
    lamp.position = position;
    lamp.direction = glm::normalize(direction);
    lamp.intensity = vec3(10.0F);
    return lamp;
}

bool meets(const Aabb& box, const vec3& p, const vec3& lamp) {
    float from = 0.0F;
    float to = 1.0F;
    for (int axis = 0; axis < 3; ++axis) {
        const float way = lamp[axis] - p[axis];
        const float a = (box.min[axis] - p[axis]) / way;
        const float b = (box.max[axis] - p[axis]) / way;
        from = std::max(from, std::min(a, b));
        to = std::min(to, std::max(a, b));
    }
    return from < to;
}

Aabb boxAround(const vec3& center, const vec3& half) {
    return {center - half, center + half};
}

void Room::add(const Aabb& box) {
    boxes.push_back(box);
    builtin::place(scene, "box", 0, builtin::box(0.5F * box.size()), builtin::at(box.center()));
}

std::vector<View> viewsOfRoom() {
    std::vector<View> views(2);
    for (size_t i = 0; i < views.size(); ++i) {
        const float sign = i == 0 ? 1.0F : -1.0F;
        views[i].camera.position = vec3(sign * 0.95F * roomHalf);
        views[i].camera.target = vec3(0.0F);
        views[i].camera.fovY = glm::radians(95.0F);
    }
    return views;
}

float distanceToCrease(const vec3& p) {
    std::array<float, 3> toWalls{};
    for (int axis = 0; axis < 3; ++axis) {
        toWalls[static_cast<size_t>(axis)] = std::abs(roomHalf - std::abs(p[axis]));
    }
    std::ranges::sort(toWalls);
    return toWalls[1];
}

bool onOneWall(const vec3& p) {
    return std::abs(std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z)}) - roomHalf) < 1e-3F &&
           distanceToCrease(p) > 0.06F;
}

size_t wallOf(const vec3& p) {
    for (int axis = 0; axis < 2; ++axis) {
        if (std::abs(p[axis]) > roomHalf - 0.01F) {
            return 2U * static_cast<size_t>(axis) + (p[axis] < 0.0F ? 1U : 0U);
        }
    }
    return p.z < 0.0F ? 5U : 4U;
}

}  // namespace reflet::test
