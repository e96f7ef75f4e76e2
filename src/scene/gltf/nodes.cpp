// Places instances, cameras, lamps and the sun by the nodes of a glTF scene.
#include "scene/gltf/nodes.h"

#include "scene/environment.h"
#include "scene/gltf/instancing.h"
#include "scene/gltf/lens.h"
#include "scene/gltf/morph.h"
#include "scene/gltf/motion.h"
#include "scene/gltf/origin.h"
#include "scene/morph.h"
#include "scene/pose.h"

#include <algorithm>
#include <cmath>
#include <map>

namespace reflet {

namespace {

constexpr uint64_t posedVertexBytes = 2 * sizeof(vec3) + sizeof(VertexAttributes);
constexpr float narrowest = 1e-3F;  // of spot lights whose angles are invalid [rad]
constexpr float sharpEdge = 0.99F;  // of the outer angle
constexpr float minNear = 1e-3F;    // metres; for orthographic cameras, whose znear may be 0 in glTF

Camera placeCamera(const tinygltf::Camera& source, const mat4& toWorld, const std::string& part, GltfReport& report) {
    Camera camera;
    camera.name = source.name;
    setTransform(camera, toWorld);
    camera.aims = false;
    if (source.type == "orthographic") {
        const auto& ortho = source.orthographic;
        if (!(static_cast<float>(ortho.zfar) > static_cast<float>(ortho.znear))) {  // as they are used
            report.fail(part + ".orthographic", "zfar {} is not beyond znear {}", ortho.zfar, ortho.znear);
        }
        camera.orthographicHeight = static_cast<float>(2.0 * ortho.ymag);
        camera.far = static_cast<float>(ortho.zfar);
        camera.near = std::max(static_cast<float>(ortho.znear), std::min(minNear, 0.5F * camera.far));
    } else {
        camera.fovY = static_cast<float>(source.perspective.yfov);
        camera.near = static_cast<float>(source.perspective.znear);
    }
    report.tolerate("the camera will be a pinhole", [&] { readGltfLens(source.extras, part, camera, report); });
    return camera;
}

/// Sets the angles. glTF has no spot light with a hard edge.
void readCone(const tinygltf::SpotLight& source, const std::string& part, Lamp& lamp, GltfReport& report) {
    lamp.innerAngle = static_cast<float>(source.innerConeAngle);
    lamp.outerAngle = static_cast<float>(source.outerConeAngle);
    const bool isCone = report.tolerate("the edge of its cone will be sharp", [&] {
        if (!(source.innerConeAngle < source.outerConeAngle)) {
            report.fail(part + ".spot", "innerConeAngle {} is not less than outerConeAngle {}", source.innerConeAngle,
                        source.outerConeAngle);
        }
    });
    if (!isCone) {
        lamp.outerAngle = std::max(lamp.outerAngle, narrowest);
        lamp.innerAngle = sharpEdge * lamp.outerAngle;
    }
}

Lamp placeLamp(const tinygltf::Light& source, const mat4& toWorld, const std::string& part, GltfReport& report) {
    Lamp lamp;
    lamp.name = source.name;
    lamp.type = source.type == "spot"          ? Lamp::Type::spot
                : source.type == "directional" ? Lamp::Type::directional
                                               : Lamp::Type::point;
    setTransform(lamp, toWorld);
    const glm::dvec3 intensity = vectorOr(source.color, glm::dvec3(1.0)) * source.intensity;
    lamp.intensity = vec3(intensity);
    if (!(std::max({intensity.x, intensity.y, intensity.z}) <= largestRadiance)) {
        report.fail(part, "color times intensity is beyond {:g}", largestRadiance);
    }
    lamp.range = static_cast<float>(source.range);
    if (lamp.type == Lamp::Type::spot) {
        readCone(source.spot, part, lamp, report);
    }
    if (lamp.type != Lamp::Type::directional && source.extras.Has("radius")) {
        lamp.radius = static_cast<float>(source.extras.Get("radius").GetNumberAsDouble());
    }
    return lamp;
}

/// KHR_node_visibility, of the node itself.
bool isVisible(const tinygltf::Node& node) {
    const auto found = node.extensions.find("KHR_node_visibility");
    return found == node.extensions.end() || !found->second.Has("visible") || found->second.Get("visible").Get<bool>();
}

class NodePlacer {
public:
    NodePlacer(const GltfDocument& document, GltfMeshes& meshes, const GltfMotion& motion, Scene& scene,
               GltfReport& report)
        : document_(document), meshes_(meshes), motion_(motion), scene_(scene), report_(report) {}

    /// Returns the node's own object-to-world matrix. Of a node that is not visible, only cameras are placed. appears:
    /// it or one above it is visible at some times alone.
    glm::dmat4 place(int index, const glm::dmat4& parentToWorld, bool visible, bool appears) {
        const tinygltf::Node& node = document_.model.nodes[static_cast<size_t>(index)];
        const std::string part = fmt::format("nodes[{}]", index);
        const glm::dmat4 exact = parentToWorld * localTransform(readGltfNode(node));
        const mat4 toWorld(exact);
        if (!isFinite(toWorld)) {
            report_.fail(part, "its transform to the world is not finite");
        }
        appears_ = appears;
        if (node.mesh >= 0 && visible) {
            addCopies(index, exact, part);
        }
        if (node.camera >= 0) {
            report_.tolerate("the camera will be missing", [&] { addCamera(node.camera, index, exact); });
        }
        const auto light = node.extensions.find("KHR_lights_punctual");
        if (light != node.extensions.end() && visible) {
            const int which = light->second.Get("light").GetNumberAsInt();
            report_.tolerate("the lamp will be missing", [&] { addLight(which, index, exact); });
        }
        return exact;
    }

    /// Puts the origin of the world near the instances, if they are far from that of the file.
    GltfPlacement finish() {
        placement_.open = motion_.open();
        moveToOrigin();
        return std::move(placement_);
    }

private:
    void moveToOrigin() {
        scene_.origin = nearbyOrigin(scene_);
        if (scene_.origin == glm::dvec3(0.0)) {
            return;
        }
        const glm::dmat4 toWorld = fileToWorld(scene_);
        for (size_t i = 0; i < scene_.instances.size(); ++i) {
            scene_.instances[i].objectToWorld = mat4(toWorld * exactInstances_[i]);
        }
        for (size_t i = 0; i < scene_.cameras.size(); ++i) {
            setTransform(scene_.cameras[i], mat4(toWorld * exactCameras_[i]));
        }
        for (size_t i = 0; i < scene_.lamps.size(); ++i) {
            setTransform(scene_.lamps[i], mat4(toWorld * exactLamps_[i]));
        }
    }

    void addCopies(int index, const glm::dmat4& nodeToWorld, const std::string& part) {
        const tinygltf::Node& node = document_.model.nodes[static_cast<size_t>(index)];
        for (const glm::dmat4& toNode : readGltfCopies(document_, node, part, report_)) {
            const glm::dmat4 exact = nodeToWorld * toNode;
            const mat4 toWorld(exact);
            report_.tolerate("the mesh will not be drawn", [&] {
                if (!isFinite(toWorld)) {
                    report_.fail(part, "the transform of an instance to the world is not finite");
                }
                addInstances(index, toWorld, mat4(toNode), part);
            });
            exactInstances_.resize(scene_.instances.size(), exact);
            if (node.skin >= 0) {
                break;  // joints alone place a skinned mesh: all copies would be in the same place
            }
        }
    }

    void addInstances(int index, const mat4& toWorld, const mat4& toNode, const std::string& part) {
        const tinygltf::Node& node = document_.model.nodes[static_cast<size_t>(index)];
        const std::vector<float> weights = gltfMorphWeights(document_, node, part, report_);
        for (const uint32_t primitive : meshes_.use(node.mesh)) {
            report_.tolerate("the mesh will not be drawn", [&] {
                Instance instance{.name = node.name, .mesh = primitive, .objectToWorld = toWorld};
                instance.objectToNode = toNode;
                addInstance(index, std::move(instance), weights, part);
            });
        }
    }

    void addInstance(int index, Instance instance, const std::vector<float>& weights, const std::string& part) {
        const tinygltf::Node& node = document_.model.nodes[static_cast<size_t>(index)];
        const bool animated = !weights.empty() && motion_.animatesWeights(index);
        instance.mesh = animated ? instance.mesh : shaped(instance.mesh, weights, part);
        const Mesh& mesh = scene_.meshes[instance.mesh];
        const Aabb box = transformed(mesh.bounds, instance.objectToWorld);
        if (!std::isfinite(glm::length(glm::dvec3(box.min) - glm::dvec3(box.max)))) {
            report_.fail(part, "its mesh extends beyond the range of floats");
        }
        if (node.skin >= 0) {
            report_.tolerate("the mesh will not be deformed",
                             [&] { instance.skin = motion_.skin(node.skin, instance.mesh, part); });
        }
        if (instance.skin >= 0 && appears_) {
            instance.skin = shownSkin(instance.skin, motion_.node(index), part);
        }
        report_.charge(part,
                       sizeof(Instance) + node.name.size() + (animated ? posedVertexBytes * mesh.positions.size() : 0));
        instance.node = motion_.node(index);
        instance.weights = animated ? weights : std::vector<float>{};
        scene_.instances.push_back(std::move(instance));
    }

    /// A copy of the skin that the node hides.
    int32_t shownSkin(int32_t skin, int32_t node, const std::string& part) {
        const auto [found, isNew] = shownSkins_.try_emplace({skin, node}, static_cast<int32_t>(scene_.skins.size()));
        if (isNew) {
            Skin shown = scene_.skins[static_cast<size_t>(skin)];
            report_.charge(part, shown.joints.size() * (sizeof(uint32_t) + 2 * sizeof(mat4)));
            shown.shownBy = node;
            scene_.skins.push_back(std::move(shown));
        }
        return found->second;
    }

    /// The mesh with weights that never change: a mesh of its own unless they are 0.
    uint32_t shaped(uint32_t mesh, const std::vector<float>& weights, const std::string& part) {
        if (std::ranges::all_of(weights, [](float w) { return w == 0.0F; })) {
            return mesh;
        }
        const auto [found, isNew] = shaped_.try_emplace({mesh, weights}, static_cast<uint32_t>(scene_.meshes.size()));
        if (isNew) {
            report_.charge(part, scene_.meshes[mesh].positions.size() * (posedVertexBytes + sizeof(VertexSkin)) +
                                     scene_.meshes[mesh].indices.size() * sizeof(uint32_t));
            scene_.meshes.push_back(morphed(scene_.meshes[mesh], weights));
        }
        return found->second;
    }

    void addCamera(int camera, int node, const glm::dmat4& toWorld) {
        const auto& source = document_.model.cameras[static_cast<size_t>(camera)];
        scene_.cameras.push_back(placeCamera(source, mat4(toWorld), fmt::format("cameras[{}]", camera), report_));
        scene_.cameras.back().node = motion_.node(node);
        exactCameras_.push_back(toWorld);
        placement_.cameras.emplace(camera, scene_.cameras.back().node);
    }

    void addLight(int light, int node, const glm::dmat4& toWorld) {
        const std::string part = fmt::format("extensions.KHR_lights_punctual.lights[{}]", light);
        Lamp lamp = placeLamp(document_.model.lights[static_cast<size_t>(light)], mat4(toWorld), part, report_);
        lamp.node = motion_.node(node);
        placement_.lights.emplace(light, lamp.node);
        if (lamp.type == Lamp::Type::directional && !scene_.sun) {
            scene_.sun = Sun{.direction = lamp.direction, .irradiance = lamp.intensity, .node = lamp.node};
        } else {
            scene_.lamps.push_back(std::move(lamp));
            exactLamps_.push_back(toWorld);
        }
    }

    const GltfDocument& document_;
    GltfMeshes& meshes_;
    const GltfMotion& motion_;
    Scene& scene_;
    GltfReport& report_;
    bool appears_ = false;  ///< the node that is being placed
    GltfPlacement placement_;
    std::map<std::pair<uint32_t, std::vector<float>>, uint32_t> shaped_;  ///< by mesh and weights
    std::map<std::pair<int32_t, int32_t>, int32_t> shownSkins_;           ///< by skin and node
    /// To the coordinates of the file, of the scene's.
    std::vector<glm::dmat4> exactInstances_;
    std::vector<glm::dmat4> exactCameras_;
    std::vector<glm::dmat4> exactLamps_;
};

}  // namespace

GltfPlacement placeGltfNodes(const GltfDocument& document, const std::vector<int>& roots, GltfMeshes& meshes,
                             Scene& scene, GltfReport& report) {
    struct Open {
        int node;
        glm::dmat4 parentToWorld;
        bool visible;  ///< the parent
        bool appears;  ///< the same
    };
    const GltfMotion motion(document, scene, report);
    NodePlacer placer(document, meshes, motion, scene, report);
    std::vector<Open> open;  // an explicit stack: a long chain of nodes would overflow the call stack
    const auto push = [&](const std::vector<int>& nodes, const glm::dmat4& parentToWorld, bool visible, bool appears) {
        for (size_t i = nodes.size(); i-- > 0;) {  // in reverse, so that the first is popped first
            open.push_back({nodes[i], parentToWorld, visible, appears});
        }
    };
    push(roots, glm::dmat4(1.0), true, false);
    while (!open.empty()) {
        const Open next = open.back();
        open.pop_back();
        report.tolerate("the node and those below it will not be drawn", [&] {
            const tinygltf::Node& node = document.model.nodes[static_cast<size_t>(next.node)];
            const bool appears = motion.appears(next.node);
            const bool visible = next.visible && (isVisible(node) || appears);
            const glm::dmat4 toWorld = placer.place(next.node, next.parentToWorld, visible, next.appears || appears);
            push(node.children, toWorld, visible, next.appears || appears);
        });
    }
    return placer.finish();
}

}  // namespace reflet
