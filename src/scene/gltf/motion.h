// Reads nodes, animations and skins of a glTF file.
#pragma once

#include "scene/gltf/document.h"
#include "scene/gltf/properties.h"
#include "scene/scene.h"

#include <map>
#include <optional>
#include <set>
#include <vector>

namespace reflet {

/// The node's own transform: its matrix, or translation, rotation and scale.
Node readGltfNode(const tinygltf::Node& node);

class GltfMotion {
public:
    /// Fills nodes, animations and skins of the scene, unless the file has neither animations nor skins. Throws Error.
    /// All three must outlive this object.
    GltfMotion(const GltfDocument& document, Scene& scene, GltfReport& report);

    /// Index into Scene::nodes of the file's node; < 0: the scene is static.
    [[nodiscard]] int32_t node(int index) const { return nodes_.empty() ? -1 : nodes_[static_cast<size_t>(index)]; }
    /// Index into Scene::skins of the file's skin; < 0: the mesh has no joints and weights. Throws Error if the mesh
    /// refers to a joint that the skin does not have. part: of the node.
    [[nodiscard]] int32_t skin(int index, uint32_t mesh, const std::string& part) const;

    /// Whether a channel animates the morph weights of the file's node.
    [[nodiscard]] bool animatesWeights(int index) const { return weighted_.contains(index); }
    /// Whether a channel animates the visibility of the file's node.
    [[nodiscard]] bool appears(int index) const { return appearing_.contains(index); }
    /// Channels that still need their targets.
    [[nodiscard]] const std::vector<GltfOpenProperty>& open() const { return open_; }

private:
    void readNodes();
    void readAnimation(size_t index, const tinygltf::Animation& source);
    void readNodeChannel(Animation& animation, const tinygltf::Animation& source,
                         const tinygltf::AnimationChannel& channel, const std::string& part);
    void readPointer(Animation& animation, const tinygltf::Animation& source, const tinygltf::AnimationChannel& channel,
                     const std::string& pointer, const std::string& part);
    void readProperty(Animation& animation, const GltfPointer& target, const tinygltf::Animation& source,
                      const tinygltf::AnimationChannel& channel, const std::string& part);
    void readSkin(size_t index);
    /// nullopt, with a warning, if it cannot be played.
    std::optional<Channel> readChannel(const tinygltf::Animation& animation, const tinygltf::AnimationChannel& channel,
                                       const std::string& part);

    const std::multimap<int, int>& nodesOfMeshes();

    const GltfDocument& document_;
    Scene& scene_;
    GltfReport& report_;
    std::vector<int32_t> nodes_;  ///< from the file's index to the scene's
    std::set<int> weighted_;      ///< the file's nodes with animated morph weights
    std::set<int> appearing_;     ///< those with animated visibility
    std::vector<int32_t> skins_;  ///< from the file's index to the scene's
    std::vector<GltfOpenProperty> open_;
    std::optional<std::multimap<int, int>> nodesOfMeshes_;
};

}  // namespace reflet
