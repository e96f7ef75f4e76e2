// Finds the plane of focus.
#include "scene/focus.h"

#include "base/error.h"
#include "base/text.h"

#include <algorithm>

namespace reflet {

namespace {

vec3 viewAxis(const Camera& camera) {
    return glm::normalize(camera.target - camera.position);
}

float along(const Camera& camera, const vec3& point) {
    return glm::dot(point - camera.position, viewAxis(camera));
}

float automaticFocus(const Camera& camera, const Scene& scene) {
    const float toTarget = glm::distance(camera.target, camera.position);
    if (camera.aims) {
        return toTarget;
    }
    const Aabb bounds = scene.bounds();
    const float toCenter = bounds.empty() ? 0.0F : along(camera, bounds.center());
    return toCenter > camera.near ? toCenter : toTarget;
}

bool hasInstance(const Scene& scene, const std::string& name) {
    return std::ranges::find(scene.instances, name, &Instance::name) != scene.instances.end();
}

void requireInstance(const Scene& scene, const std::string& name, const std::string& where) {
    if (hasInstance(scene, name)) {
        return;
    }
    std::vector<std::string> names;
    std::ranges::transform(scene.instances, std::back_inserter(names), &Instance::name);
    fail("{}: no node with a mesh is called '{}'{}", where, name, suggestion(name, names));
}

float distanceTo(const FocusTarget& target, const Camera& camera, const Scene& scene, const ScenePose& pose) {
    switch (target.kind) {
        case FocusTarget::Kind::distance:
            return target.distance;
        case FocusTarget::Kind::point:
            return along(camera, target.point);
        case FocusTarget::Kind::node:
            return along(camera, centerOfNode(target.node, scene, pose, "camera.focus"));
        case FocusTarget::Kind::automatic:
            break;
    }
    return automaticFocus(camera, scene);
}

}  // namespace

vec3 centerOfNode(const std::string& name, const Scene& scene, const ScenePose& pose, const std::string& where) {
    requireInstance(scene, name, where);
    Aabb box;
    for (size_t i = 0; i < scene.instances.size(); ++i) {
        const Instance& instance = scene.instances[i];
        if (instance.name == name) {
            const size_t joints = instance.skin < 0 ? 0 : scene.skins[static_cast<size_t>(instance.skin)].joints.size();
            box.add(instanceBounds(scene, pose, i, jointBounds(scene.meshes.at(instance.mesh), joints)));
        }
    }
    return box.center();
}

bool hasFocusToFind(const Camera& camera) {
    return camera.apertureRadius > 0.0F && (!camera.focus.empty() || camera.focusDistance <= 0.0F);
}

float foundFocus(const Camera& camera, const Scene& scene, const ScenePose& pose) {
    if (camera.focus.empty()) {
        return std::max(camera.focusDistance > 0.0F ? camera.focusDistance : automaticFocus(camera, scene),
                        camera.near);
    }
    float sum = 0.0F;
    float weights = 0.0F;
    for (const FocusTarget& target : camera.focus) {
        if (target.weight <= 0.0F) {
            continue;
        }
        sum += target.weight * std::max(distanceTo(target, camera, scene, pose), camera.near);
        weights += target.weight;
    }
    return weights > 0.0F ? sum / weights : automaticFocus(camera, scene);
}

void checkFocus(const Camera& camera, const Scene& scene, const std::string& where) {
    for (const FocusTarget& target : camera.focus) {
        if (target.kind == FocusTarget::Kind::node) {
            requireInstance(scene, target.node, where);
        }
    }
}

}  // namespace reflet
