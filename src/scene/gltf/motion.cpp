// Reads nodes, animations and skins of a glTF file.
#include "scene/gltf/motion.h"

#include "scene/gltf/accessor.h"
#include "scene/gltf/channel.h"
#include "scene/gltf/morph.h"

#include <algorithm>
#include <cmath>

namespace reflet {

Node readGltfNode(const tinygltf::Node& node) {
    Node result;
    if (node.matrix.size() == 16) {
        glm::dmat4 m(1.0);
        for (int i = 0; i < 16; ++i) {
            m[i / 4][i % 4] = node.matrix[static_cast<size_t>(i)];
        }
        result.matrix = m;
        return result;
    }
    result.translation = vectorOr(node.translation, glm::dvec3(0.0));
    if (node.rotation.size() == 4) {
        const glm::dquat rotation(node.rotation[3], node.rotation[0], node.rotation[1], node.rotation[2]);
        result.rotation = rotation / glm::length(rotation);
    }
    result.scale = vectorOr(node.scale, glm::dvec3(1.0));
    return result;
}

GltfMotion::GltfMotion(const GltfDocument& document, Scene& scene, GltfReport& report)
    : document_(document), scene_(scene), report_(report) {
    if (document.animations.empty() && document.model.skins.empty()) {
        return;
    }
    readNodes();
    for (const auto& [index, animation] : document.animations) {
        readAnimation(index, animation);
    }
    skins_.assign(document.model.skins.size(), -1);
    for (size_t i = 0; i < document.model.skins.size(); ++i) {
        report_.tolerateUntilUsed("skins", i, [&] { readSkin(i); });
    }
}

// The nodes of all scenes, because joints may be anywhere.
void GltfMotion::readNodes() {
    const auto& nodes = document_.model.nodes;
    report_.charge("nodes", nodes.size() * (sizeof(Node) + sizeof(mat4)));
    nodes_.assign(nodes.size(), -1);
    std::vector<size_t> order;  // parents first
    for (size_t i = 0; i < nodes.size(); ++i) {
        if (!document_.isChild[i]) {
            order.push_back(i);
        }
    }
    for (size_t next = 0; next < order.size(); ++next) {
        const tinygltf::Node& node = nodes[order[next]];
        nodes_[order[next]] = static_cast<int32_t>(next);
        for (const int child : node.children) {
            order.push_back(static_cast<size_t>(child));
        }
    }
    for (const size_t index : order) {
        scene_.nodes.push_back(readGltfNode(nodes[index]));
    }
    for (const size_t index : order) {
        for (const int child : nodes[index].children) {
            scene_.nodes[static_cast<size_t>(nodes_[static_cast<size_t>(child)])].parent = nodes_[index];
        }
    }
}

void GltfMotion::readAnimation(size_t index, const tinygltf::Animation& source) {
    Animation animation{.name = source.name, .channels = {}};
    for (size_t i = 0; i < source.channels.size(); ++i) {
        const tinygltf::AnimationChannel& channel = source.channels[i];
        const std::string part = fmt::format("animations[{}].channels[{}]", index, i);
        const auto extension = channel.target_extensions.find("KHR_animation_pointer");
        report_.tolerate("the channel will be ignored", [&] {
            if (extension != channel.target_extensions.end() && channel.target_path == "pointer") {
                readPointer(animation, source, channel, extension->second.Get("pointer").Get<std::string>(), part);
            } else if (channel.target_node >= 0) {  // else an unknown extension defines the target
                readNodeChannel(animation, source, channel, part);
            }
        });
    }
    if (!animation.channels.empty() || !animation.properties.empty()) {
        scene_.animations.push_back(std::move(animation));
    }
}

void GltfMotion::readNodeChannel(Animation& animation, const tinygltf::Animation& source,
                                 const tinygltf::AnimationChannel& channel, const std::string& part) {
    if (std::optional<Channel> read = readChannel(source, channel, part)) {
        read->node = static_cast<uint32_t>(node(channel.target_node));
        animation.channels.push_back(std::move(*read));
    }
}

void GltfMotion::readPointer(Animation& animation, const tinygltf::Animation& source,
                             const tinygltf::AnimationChannel& channel, const std::string& pointer,
                             const std::string& part) {
    const auto target = parseGltfPointer(pointer);
    if (!target) {
        report_.warn("pointer", part + ".target", "'{}' will stand still: it cannot be animated", pointer);
        return;
    }
    const tinygltf::Model& model = document_.model;
    const size_t count = target->of == GltfPointer::Of::node       ? model.nodes.size()
                         : target->of == GltfPointer::Of::mesh     ? model.meshes.size()
                         : target->of == GltfPointer::Of::material ? document_.materialCount
                         : target->of == GltfPointer::Of::camera   ? model.cameras.size()
                                                                   : model.lights.size();
    if (target->index >= count) {
        report_.fail(part + ".target", "its pointer names {}[{}], but there are {}", arrayOf(target->of), target->index,
                     count);
    }
    if (target->nodePath.empty()) {
        readProperty(animation, *target, source, channel, part);
        return;
    }
    tinygltf::AnimationChannel moved = channel;
    moved.target_path = target->nodePath;
    moved.target_node = static_cast<int>(target->index);
    if (target->of == GltfPointer::Of::node) {
        readNodeChannel(animation, source, moved, part);
        return;
    }
    const auto [first, last] = nodesOfMeshes().equal_range(static_cast<int>(target->index));
    for (auto node = first; node != last; ++node) {
        report_.charge(part, sizeof(Channel));
        moved.target_node = node->second;
        readNodeChannel(animation, source, moved, part);
    }
}

/// The nodes that take the morph weights of their mesh.
const std::multimap<int, int>& GltfMotion::nodesOfMeshes() {
    if (!nodesOfMeshes_) {
        nodesOfMeshes_.emplace();
        for (size_t i = 0; i < document_.model.nodes.size(); ++i) {
            const tinygltf::Node& node = document_.model.nodes[i];
            if (node.mesh >= 0 && node.weights.empty()) {
                nodesOfMeshes_->emplace(node.mesh, static_cast<int>(i));
            }
        }
    }
    return *nodesOfMeshes_;
}

/// The targets of what is no node are found later.
void GltfMotion::readProperty(Animation& animation, const GltfPointer& target, const tinygltf::Animation& source,
                              const tinygltf::AnimationChannel& channel, const std::string& part) {
    std::optional<Channel> keys = readGltfChannel(document_, {source, channel, part, 0, target.components}, report_);
    if (!keys) {
        return;
    }
    PropertyChannel read{
        .property = target.property, .texture = target.texture, .targets = {}, .keys = std::move(*keys)};
    if (target.property == Property::orthographicHeight) {
        std::ranges::for_each(read.keys.values, [](vec4& value) { value *= 2.0F; });  // glTF has half of it
    }
    if (target.of == GltfPointer::Of::node) {
        if (read.keys.interpolation == Interpolation::cubicSpline) {
            report_.fail(part + ".sampler", "has splines, but a node is visible or not");
        }
        read.keys.interpolation = Interpolation::step;
        read.targets.push_back(static_cast<uint32_t>(node(static_cast<int>(target.index))));
        appearing_.insert(static_cast<int>(target.index));
    } else {
        open_.push_back({scene_.animations.size(), animation.properties.size(), target.of, target.index});
    }
    animation.properties.push_back(std::move(read));
}

std::optional<Channel> GltfMotion::readChannel(const tinygltf::Animation& animation,
                                               const tinygltf::AnimationChannel& channel, const std::string& part) {
    const tinygltf::Node& target = document_.model.nodes[static_cast<size_t>(channel.target_node)];
    const bool weights = channel.target_path == "weights";
    const size_t morphTargets = weights && target.mesh >= 0 ? gltfMorphTargets(document_, target.mesh, report_) : 0;
    if (weights && morphTargets == 0) {
        report_.warn("weights without targets", part + ".target.node",
                     "the channel will be ignored: nodes[{}] has no mesh with morph targets", channel.target_node);
        return std::nullopt;
    }
    if (!weights && !target.matrix.empty()) {
        report_.warn("animated matrix", part + ".target.node",
                     "nodes[{}] will not be animated: it has a matrix instead of translation, rotation and scale",
                     channel.target_node);
        return std::nullopt;
    }
    if (weights) {
        weighted_.insert(channel.target_node);
    }
    return readGltfChannel(document_, {animation, channel, part, morphTargets}, report_);
}

void GltfMotion::readSkin(size_t index) {
    const tinygltf::Skin& source = document_.model.skins[index];
    const std::string part = fmt::format("skins[{}]", index);
    if (source.joints.empty()) {
        report_.fail(part + ".joints", "is empty");
    }
    report_.charge(part, source.joints.size() * (sizeof(uint32_t) + 2 * sizeof(mat4)));
    Skin skin;
    for (const int joint : source.joints) {
        skin.joints.push_back(static_cast<uint32_t>(node(joint)));
    }
    skin.inverseBind.assign(skin.joints.size(), mat4(1.0F));
    if (source.inverseBindMatrices >= 0) {
        const AccessorView view = viewAccessor(document_, source.inverseBindMatrices, report_);
        const auto& accessor = document_.model.accessors[static_cast<size_t>(source.inverseBindMatrices)];
        if (accessor.type != TINYGLTF_TYPE_MAT4 || accessor.componentType != TINYGLTF_COMPONENT_TYPE_FLOAT) {
            report_.fail(part + ".inverseBindMatrices", "is not an accessor of MAT4 floats");
        }
        if (view.count < skin.joints.size()) {
            report_.fail(part + ".inverseBindMatrices", "has {} matrices for {} joints", view.count,
                         skin.joints.size());
        }
        for (uint32_t i = 0; i < skin.joints.size(); ++i) {
            skin.inverseBind[i] = view.matrixAt(i);
            for (int c = 0; c < 16; ++c) {
                if (!std::isfinite(skin.inverseBind[i][c / 4][c % 4])) {
                    report_.fail(part + ".inverseBindMatrices", "matrix {} is not finite", i);
                }
            }
        }
    }
    skins_[index] = static_cast<int32_t>(scene_.skins.size());
    scene_.skins.push_back(std::move(skin));
}

int32_t GltfMotion::skin(int index, uint32_t mesh, const std::string& part) const {
    report_.use("skins", static_cast<size_t>(index));
    const int32_t skin = skins_[static_cast<size_t>(index)];
    const Mesh& skinned = scene_.meshes[mesh];
    const size_t joints = scene_.skins[static_cast<size_t>(skin)].joints.size();
    if (skinned.skin.empty()) {
        report_.warn("skin without joints", part + ".skin",
                     "the mesh will not be deformed: it has no JOINTS_0 and WEIGHTS_0");
        return -1;
    }
    for (const JointWeight& moved : skinned.jointWeights) {
        if (moved.joint >= joints) {
            report_.fail(part + ".skin", "its mesh names joint {}, but there are {}", moved.joint, joints);
        }
    }
    report_.charge(part, skinned.positions.size() * (2 * sizeof(vec3) + sizeof(VertexAttributes)));
    return skin;
}

}  // namespace reflet
