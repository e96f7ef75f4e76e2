// Boxes, cameras, suns and points for tests of how the sun's shadow maps are fitted.
#pragma once

#include "effects/shadow/shadow.h"
#include "renderer/renderer.h"
#include "shader/directions.h"

#include <cmath>
#include <random>
#include <vector>

namespace reflet::test {

inline Aabb boxOf(const vec3& min, const vec3& max) {
    Aabb box;
    box.add(min);
    box.add(max);
    return box;
}

inline Camera cameraAt(const vec3& position, const vec3& target) {
    Camera camera;
    camera.position = position;
    camera.target = target;
    if (std::abs(glm::normalize(target - position).y) > 0.99F) {
        camera.up = {0, 0, 1};
    }
    return camera;
}

inline const std::vector<vec3>& sunDirections() {
    static const std::vector<vec3> directions = [] {
        std::vector<vec3> d = {{0, -1, 0}, {0, 1, 0}, {1, 0, 0}, {0, 0, -1}, glm::normalize(vec3(0.01F, -1, 0))};
        for (const vec3& spread : spreadDirections(20)) {
            d.push_back(glm::normalize(spread));
        }
        return d;
    }();
    return directions;
}

inline std::vector<vec3> pointsIn(const Aabb& box, int count) {
    std::mt19937 random(5);
    const auto number = [&] { return static_cast<float>(random() >> 8U) / 16777216.0F; };
    std::vector<vec3> points;
    for (unsigned i = 0; i < 8; ++i) {
        points.push_back(box.corner(i));
    }
    for (int i = 0; i < count; ++i) {
        points.push_back(box.min + vec3(number(), number(), number()) * box.size());
    }
    return points;
}

inline bool isVisible(const ViewParams& view, const vec3& p) {
    const vec4 clip = view.worldToClip * vec4(p, 1.0F);
    return clip.w > 0.0F && std::abs(clip.x) <= clip.w && std::abs(clip.y) <= clip.w && clip.z <= clip.w;
}

inline vec3 inMap(const ShadowMapParams& map, const vec3& p) {
    return {map.worldToShadow * vec4(p, 1.0F)};
}

}  // namespace reflet::test
