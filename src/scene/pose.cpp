// Evaluates a scene at a time: keyframes, then nodes, then instances, skins, morph targets, cameras and lights.
#include "scene/pose.h"

#include "scene/focus.h"
#include "scene/gltf/normals.h"
#include "scene/morph.h"
#include "scene/sample_channel.h"

#include <algorithm>
#include <cmath>

namespace reflet {

namespace {

void apply(const Channel& channel, double time, Node& node) {
    const glm::dvec4 value = sampleChannel(channel, time);
    switch (channel.target) {
        case Channel::Target::translation:
            node.translation = glm::dvec3(value);
            break;
        case Channel::Target::rotation:
            node.rotation = glm::dquat(value.w, value.x, value.y, value.z);
            break;
        case Channel::Target::scale:
            node.scale = glm::dvec3(value);
            break;
        case Channel::Target::weights:  // of instances, not of the node
        case Channel::Target::property:
            break;
    }
}

// Products of large numbers may overflow a float; `otherwise` replaces them.
mat4 finiteOr(const glm::dmat4& m, const mat4& otherwise) {
    const mat4 rounded(m);
    for (int i = 0; i < 16; ++i) {
        if (!std::isfinite(rounded[i / 4][i % 4])) {
            return otherwise;
        }
    }
    return rounded;
}

bool isMoving(int32_t node, const ScenePose& pose) {
    return node >= 0 && pose.moving[static_cast<size_t>(node)];
}

const mat4& placeOf(int32_t node, const ScenePose& pose) {
    return pose.nodeToWorld[static_cast<size_t>(node)];
}

mat4 placeOf(const Instance& instance, const ScenePose& pose) {
    return finiteOr(glm::dmat4(placeOf(instance.node, pose)) * glm::dmat4(instance.objectToNode), mat4(1.0F));
}

bool isHidden(int32_t node, const ScenePose& pose) {
    return node >= 0 && !pose.hidden.empty() && pose.hidden[static_cast<size_t>(node)];
}

/// Everything is where the origin was.
mat4 collapsed(const mat4& m) {
    mat4 point(0.0F);
    point[3] = m[3];
    return point;
}

/// Fills `hidden`. Nodes whose visibility is animated count as moving.
void hide(const Scene& scene, ScenePose& pose) {
    if (pose.properties.visible.empty()) {
        return;
    }
    pose.hidden.assign(scene.nodes.size(), false);
    for (const auto& [node, visible] : pose.properties.visible) {
        pose.hidden[static_cast<size_t>(node)] = !visible;
        pose.moving[static_cast<size_t>(node)] = true;
    }
    for (size_t i = 0; i < scene.nodes.size(); ++i) {
        pose.hidden[i] = pose.hidden[i] || isHidden(scene.nodes[i].parent, pose);
    }
}

// Automatic focus stays automatic when the view is posed again, at another time.
void keepAutomatic(Camera& camera) {
    if (camera.focus.empty()) {
        camera.focus.push_back({});
    }
}

/// The mesh deformed by its skin, in world space.
Mesh skinned(const Mesh& source, const std::vector<mat4>& joints) {
    Mesh mesh = source;
    mesh.skin.clear();
    mesh.jointWeights.clear();
    mesh.bounds = Aabb{};
    for (size_t i = 0; i < mesh.positions.size(); ++i) {
        const mat4 m = skinToWorld(source.jointsOf(i), joints);
        const mat3 turn(m);
        const mat3 cofactors(glm::cross(turn[1], turn[2]), glm::cross(turn[2], turn[0]), glm::cross(turn[0], turn[1]));
        const float side = glm::dot(turn[0], cofactors[0]) < 0.0F ? -1.0F : 1.0F;
        VertexAttributes& a = mesh.attributes[i];
        mesh.positions[i] = vec3(m * vec4(source.positions[i], 1.0F));
        a.normal = unitOr(side * (cofactors * a.normal), a.normal);
        a.tangent = vec4(unitOr(turn * vec3(a.tangent), vec3(a.tangent)), side * a.tangent.w);
        mesh.bounds.add(mesh.positions[i]);
    }
    if (flipsWinding(joints)) {
        for (size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
            std::swap(mesh.indices[i + 1], mesh.indices[i + 2]);
        }
    }
    return mesh;
}

}  // namespace

glm::dmat4 localTransform(const Node& node) {
    if (node.matrix) {
        return *node.matrix;
    }
    const glm::dmat4 moved = glm::translate(glm::dmat4(1.0), node.translation) * glm::mat4_cast(node.rotation);
    return glm::scale(moved, node.scale);
}

glm::dmat4 fileToWorld(const Scene& scene) {
    return glm::translate(glm::dmat4(1.0), -scene.origin);
}

double animationDuration(const Scene& scene) {
    double last = 0.0;
    for (const Animation& animation : scene.animations) {
        for (const Channel& channel : animation.channels) {
            last = std::max<double>(last, channel.times.back());
        }
        for (const PropertyChannel& channel : animation.properties) {
            last = std::max<double>(last, channel.keys.times.back());
        }
    }
    return last;
}

double loopedTime(const Scene& scene, double time) {
    const double duration = animationDuration(scene);
    return duration > 0.0 ? std::fmod(time, duration) : 0.0;
}

ScenePose scenePose(const Scene& scene, double time) {
    ScenePose pose;
    pose.time = loopedTime(scene, time);
    std::vector<Node> nodes = scene.nodes;
    pose.moving.assign(nodes.size(), false);
    std::vector<const Channel*> weightsOf(nodes.size(), nullptr);
    for (const Animation& animation : scene.animations) {
        for (const Channel& channel : animation.channels) {
            if (channel.target == Channel::Target::weights) {
                weightsOf[channel.node] = &channel;
                continue;
            }
            apply(channel, pose.time, nodes[channel.node]);
            pose.moving[channel.node] = true;
        }
    }
    pose.properties = animatedProperties(
        scene, [&](const PropertyChannel& channel) { return vec4(sampleChannel(channel.keys, pose.time)); });
    hide(scene, pose);
    std::vector<glm::dmat4> toWorld;
    toWorld.reserve(nodes.size());
    for (size_t i = 0; i < nodes.size(); ++i) {
        const auto parent = static_cast<size_t>(std::max(nodes[i].parent, 0));
        const bool hangs = nodes[i].parent >= 0;
        pose.moving[i] = pose.moving[i] || (hangs && pose.moving[parent]);
        toWorld.push_back((hangs ? toWorld[parent] : fileToWorld(scene)) * localTransform(nodes[i]));
        pose.nodeToWorld.push_back(finiteOr(toWorld.back(), mat4(1.0F)));
    }
    for (const Instance& instance : scene.instances) {
        const mat4 place = instance.skin >= 0              ? mat4(1.0F)
                           : isMoving(instance.node, pose) ? placeOf(instance, pose)
                                                           : instance.objectToWorld;
        pose.objectToWorld.push_back(isHidden(instance.node, pose) && instance.skin < 0 ? collapsed(place) : place);
        const Channel* weights = instance.node >= 0 ? weightsOf[static_cast<size_t>(instance.node)] : nullptr;
        pose.weights.push_back(instance.weights.empty() || weights == nullptr ? instance.weights
                                                                              : sampleWeights(*weights, pose.time));
    }
    for (const Skin& skin : scene.skins) {
        std::vector<mat4>& joints = pose.skins.emplace_back();
        for (size_t j = 0; j < skin.joints.size(); ++j) {
            const mat4 joint = finiteOr(toWorld[skin.joints[j]] * glm::dmat4(skin.inverseBind[j]), mat4(1.0F));
            joints.push_back(isHidden(skin.shownBy, pose) ? collapsed(joint) : joint);
        }
    }
    return pose;
}

const Material& materialAt(const Scene& scene, const ScenePose* pose, uint32_t material) {
    const Material& resting = scene.materials.at(material);
    if (pose == nullptr) {
        return resting;
    }
    const auto found = pose->properties.materials.find(material);
    return found != pose->properties.materials.end() ? found->second : resting;
}

bool isDeformed(const Instance& instance) {
    return instance.skin >= 0 || !instance.weights.empty();
}

bool isAnimated(const ScenePose& pose, const Instance& instance) {
    return isDeformed(instance) || isMoving(instance.node, pose);
}

mat4 skinToWorld(std::span<const JointWeight> vertex, const std::vector<mat4>& joints) {
    mat4 sum(0.0F);
    for (const JointWeight& moved : vertex) {
        sum += moved.weight * joints[moved.joint];
    }
    return sum;
}

bool flipsWinding(const std::vector<mat4>& joints) {
    return glm::determinant(mat3(joints.front())) < 0.0F;
}

std::vector<vec3> worldPositions(const Scene& scene, const ScenePose& pose, size_t instance) {
    const Instance& placed = scene.instances[instance];
    const Mesh& mesh = scene.meshes.at(placed.mesh);
    std::vector<vec3> positions;
    positions.reserve(mesh.positions.size());
    for (size_t i = 0; i < mesh.positions.size(); ++i) {
        const mat4 toWorld = placed.skin >= 0
                                 ? skinToWorld(mesh.jointsOf(i), pose.skins[static_cast<size_t>(placed.skin)])
                                 : pose.objectToWorld[instance];
        positions.emplace_back(toWorld * vec4(morphedPosition(mesh, i, pose.weights[instance]), 1.0F));
    }
    return positions;
}

std::vector<JointBounds> jointBounds(const Mesh& mesh, size_t joints) {
    std::vector<JointBounds> bounds;
    std::vector<int32_t> places(joints, -1);  // in `bounds`
    for (size_t i = 0; joints > 0 && i < mesh.skin.size(); ++i) {
        for (const JointWeight& moved : mesh.jointsOf(i)) {
            int32_t& place = places[moved.joint];
            if (place < 0) {
                place = static_cast<int32_t>(bounds.size());
                bounds.push_back({.joint = moved.joint, .box = {}});
            }
            bounds[static_cast<size_t>(place)].box.add(mesh.positions[i]);
        }
    }
    return bounds;
}

Aabb instanceBounds(const Scene& scene, const ScenePose& pose, size_t instance,
                    const std::vector<JointBounds>& byJoint) {
    const Instance& placed = scene.instances[instance];
    const Mesh& mesh = scene.meshes.at(placed.mesh);
    if (mesh.bounds.empty()) {
        return {};
    }
    const auto boundsOf = [&](const Aabb& box) { return morphedBounds(mesh, box, pose.weights[instance]); };
    if (placed.skin < 0) {
        return transformed(boundsOf(mesh.bounds), pose.objectToWorld[instance]);
    }
    const std::vector<mat4>& joints = pose.skins[static_cast<size_t>(placed.skin)];
    Aabb result;
    for (const JointBounds& moved : byJoint) {
        result.add(transformed(boundsOf(moved.box), joints[moved.joint]));
    }
    return result;
}

Camera posed(Camera camera, const ScenePose& pose) {
    if (isMoving(camera.node, pose)) {
        setTransform(camera, placeOf(camera.node, pose));
    }
    if (const auto found = pose.properties.lenses.find(camera.node); found != pose.properties.lenses.end()) {
        const auto& [resting, now] = found->second;
        for (float Camera::*member : {&Camera::fovY, &Camera::near, &Camera::far, &Camera::orthographicHeight}) {
            camera.*member = camera.*member == resting.*member ? now.*member : camera.*member;
        }
    }
    return camera;
}

Lamp posed(Lamp lamp, const ScenePose& pose) {
    if (isMoving(lamp.node, pose)) {
        setTransform(lamp, placeOf(lamp.node, pose));
    }
    if (const auto found = pose.properties.lights.find(lamp.node); found != pose.properties.lights.end()) {
        const Lamp& now = found->second.now;
        lamp.intensity = now.intensity;
        lamp.range = now.range;
        lamp.innerAngle = now.innerAngle;
        lamp.outerAngle = now.outerAngle;
    }
    lamp.intensity = isHidden(lamp.node, pose) ? vec3(0.0F) : lamp.intensity;
    return lamp;
}

Sun posed(Sun sun, const ScenePose& pose) {
    if (isMoving(sun.node, pose)) {
        sun.direction = unitOr(-vec3(placeOf(sun.node, pose)[2]), vec3(0, 0, -1));
    }
    const auto found = pose.properties.lights.find(sun.node);
    if (found != pose.properties.lights.end() && sun.irradiance == found->second.resting.intensity) {
        sun.irradiance = found->second.now.intensity;
    }
    sun.irradiance = isHidden(sun.node, pose) ? vec3(0.0F) : sun.irradiance;
    return sun;
}

View posed(View view, const Scene& scene) {
    view.time = loopedTime(scene, view.time);
    const bool focuses = hasFocusToFind(view.camera);
    if (view.camera.node >= 0 || view.sun.node >= 0 || focuses) {
        const ScenePose pose = scenePose(scene, view.time);
        view.camera = posed(view.camera, pose);
        view.sun = posed(view.sun, pose);
        if (focuses) {
            keepAutomatic(view.camera);
            view.camera.focusDistance = foundFocus(view.camera, scene, pose);
        }
    }
    return view;
}

Scene frozen(const Scene& scene, double time) {
    const ScenePose pose = scenePose(scene, time);
    Scene still = scene;
    for (size_t i = 0; i < still.instances.size(); ++i) {
        Instance& instance = still.instances[i];
        if (isDeformed(instance)) {
            Mesh mesh = scene.meshes.at(instance.mesh);
            if (!pose.weights[i].empty()) {
                mesh = morphed(mesh, pose.weights[i]);
            }
            if (instance.skin >= 0) {
                mesh = skinned(mesh, pose.skins[static_cast<size_t>(instance.skin)]);
            }
            still.meshes.push_back(std::move(mesh));
            instance.mesh = static_cast<uint32_t>(still.meshes.size() - 1);
        }
        instance.objectToWorld = pose.objectToWorld[i];
        instance.skin = -1;
        instance.weights.clear();
        instance.node = -1;
    }
    for (const auto& [index, material] : pose.properties.materials) {
        still.materials[index] = material;
    }
    for (Lamp& lamp : still.lamps) {
        lamp = posed(lamp, pose);
        lamp.node = -1;
    }
    for (Camera& camera : still.cameras) {
        camera = posed(camera, pose);
        camera.node = -1;
    }
    if (still.sun) {
        still.sun = posed(*still.sun, pose);
        still.sun->node = -1;
    }
    still.nodes.clear();
    still.animations.clear();
    still.resting.clear();
    still.skins.clear();
    return still;
}

}  // namespace reflet
