// Finds the place of most instances.
#include "scene/gltf/origin.h"

#include "scene/pose.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace reflet {

namespace {

// Times the size of the scene. A float has 2^24 steps of its distance from the origin, so 2^16 of the scene's size are
// left there.
constexpr double farAway = 256.0;

double medianOf(std::vector<double> values) {
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::ranges::nth_element(values, middle);
    return *middle;
}

}  // namespace

// Medians, so that a sky or a ground that is much larger than the rest does not decide.
glm::dvec3 nearbyOrigin(const Scene& scene) {
    const ScenePose pose = scenePose(scene, 0.0);
    std::vector<Aabb> boxes;
    for (size_t i = 0; i < scene.instances.size(); ++i) {
        const int32_t skin = scene.instances[i].skin;
        const size_t joints = skin < 0 ? 0 : scene.skins[static_cast<size_t>(skin)].joints.size();
        const Aabb box = instanceBounds(scene, pose, i, jointBounds(scene.meshes.at(scene.instances[i].mesh), joints));
        if (!box.empty()) {
            boxes.push_back(box);
        }
    }
    if (boxes.empty()) {
        return glm::dvec3(0.0);
    }
    glm::dvec3 center(0.0);
    std::vector<double> values(boxes.size());
    for (int axis = 0; axis < 3; ++axis) {
        std::ranges::transform(boxes, values.begin(), [&](const Aabb& box) { return box.center()[axis]; });
        center[axis] = medianOf(values);
    }
    std::ranges::transform(boxes, values.begin(), [&](const Aabb& box) {
        return glm::distance(center, glm::dvec3(box.center())) + 0.5 * glm::length(glm::dvec3(box.size()));
    });
    const double distance = glm::length(center);
    const double reach = std::max(medianOf(values), 1e-6 * distance);
    if (!(distance > farAway * reach) || !std::isfinite(distance)) {
        return glm::dvec3(0.0);
    }
    const double grid = std::exp2(std::ceil(std::log2(reach)));
    return grid * glm::round(center / grid);
}

}  // namespace reflet
