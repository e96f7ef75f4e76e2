// Reads nodes, animations and skins of a glTF file.
#pragma once

#include "scene/gltf/document.h"
#include "scene/scene.h"

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

private:
    void readNodes();
    void readAnimation(size_t index, const tinygltf::Animation& source);
    void readSkin(size_t index);
    /// nullopt, with a warning, if it cannot be played.
    std::optional<Channel> readChannel(const tinygltf::Animation& animation, const tinygltf::AnimationChannel& channel,
                                       const std::string& part);

    const GltfDocument& document_;
    Scene& scene_;
    GltfReport& report_;
    std::vector<int32_t> nodes_;  ///< from the file's index to the scene's
    std::set<int> weighted_;      ///< the file's nodes with animated morph weights
    std::vector<int32_t> skins_;  ///< the same
};

}  // namespace reflet
