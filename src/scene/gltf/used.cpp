// Finds what the drawn scene uses by walking the document's references.
#include "scene/gltf/used.h"

#include "scene/gltf/schema.h"

#include <algorithm>
#include <set>

namespace reflet {

namespace {

using nlohmann::json;

size_t indexIn(const json& object, const char* name, size_t otherwise) {
    const auto found = object.find(name);
    return found != object.end() ? found->get<size_t>() : otherwise;
}

/// Calls `use` with the index of each material of the primitive.
template <class Use>
void eachMaterial(const json& primitive, const Use& use) {
    if (const auto material = primitive.find("material"); material != primitive.end()) {
        use(material->get<size_t>());
    }
    const auto extensions = primitive.find("extensions");
    if (extensions == primitive.end() || !extensions->contains("KHR_materials_variants")) {
        return;
    }
    for (const json& mapping : arrayIn(extensions->at("KHR_materials_variants"), "mappings")) {
        use(mapping.at("material").get<size_t>());
    }
}

/// Walks the nodes' references.
class UsedNodes {
public:
    explicit UsedNodes(const json& document)
        : nodes_(arrayIn(document, "nodes")),
          skins_(arrayIn(document, "skins")),
          used_(nodes_.size(), false),
          skinUsed_(skins_.size(), false),
          parents_(nodes_.size(), nodes_.size()) {
        for (size_t i = 0; i < nodes_.size(); ++i) {
            for (const json& child : arrayIn(nodes_[i], "children")) {
                parents_[child.get<size_t>()] = i;
            }
        }
    }

    /// The node, what is below it, and the joints of the skins there.
    void add(size_t root) {
        open_.push_back(root);
        while (!open_.empty()) {
            const size_t node = open_.back();
            open_.pop_back();
            if (used_[node]) {
                continue;
            }
            used_[node] = true;
            for (const json& child : arrayIn(nodes_[node], "children")) {
                open_.push_back(child.get<size_t>());
            }
            if (const size_t skin = indexIn(nodes_[node], "skin", skins_.size()); skin < skins_.size()) {
                addSkin(skin);
            }
        }
    }

    [[nodiscard]] const std::vector<bool>& used() const { return used_; }

private:
    /// Joints may be anywhere: they move with all nodes above them.
    void addSkin(size_t skin) {
        if (skinUsed_[skin]) {
            return;
        }
        skinUsed_[skin] = true;
        for (const json& joint : arrayIn(skins_[skin], "joints")) {
            for (size_t node = joint.get<size_t>(); node < nodes_.size() && !above_.contains(node);
                 node = parents_[node]) {
                above_.insert(node);
                open_.push_back(node);
            }
        }
    }

    const json& nodes_;
    const json& skins_;
    std::vector<bool> used_;
    std::vector<bool> skinUsed_;
    std::vector<size_t> parents_;  ///< nodes_.size(): none
    std::set<size_t> above_;       ///< joints, and nodes above them
    std::vector<size_t> open_;
};

std::vector<bool> usedNodes(const json& document, int scene) {
    UsedNodes nodes(document);
    const json& scenes = arrayIn(document, "scenes");
    if (scenes.empty()) {
        // NOLINTNEXTLINE(modernize-return-braced-init-list): braces would make a list of two
        return std::vector<bool>(arrayIn(document, "nodes").size(), true);
    }
    const size_t chosen = scene >= 0 ? static_cast<size_t>(scene) : indexIn(document, "scene", 0);
    if (chosen < scenes.size()) {
        for (const json& root : arrayIn(scenes[chosen], "nodes")) {
            nodes.add(root.get<size_t>());
        }
    }
    return nodes.used();
}

}  // namespace

std::vector<bool> usedGltfMaterials(const json& document) {
    std::vector<bool> used(arrayIn(document, "materials").size(), false);
    for (const json& mesh : arrayIn(document, "meshes")) {
        for (const json& primitive : arrayIn(mesh, "primitives")) {
            eachMaterial(primitive, [&](size_t material) { used[material] = true; });
        }
    }
    return used;
}

bool hasGltfPointer(const json& target) {
    const auto extensions = target.find("extensions");
    return extensions != target.end() && extensions->contains("KHR_animation_pointer");
}

std::vector<bool> usedGltfAnimations(const json& document, int scene) {
    const std::vector<bool> nodes = usedNodes(document, scene);
    std::vector<bool> used;
    for (const json& animation : arrayIn(document, "animations")) {
        used.push_back(std::ranges::any_of(arrayIn(animation, "channels"), [&](const json& channel) {
            const auto target = channel.find("target");
            const size_t node = target != channel.end() ? indexIn(*target, "node", nodes.size()) : nodes.size();
            const bool pointer = target != channel.end() && hasGltfPointer(*target);
            return pointer || (node < nodes.size() && nodes[node]);
        }));
    }
    return used;
}

}  // namespace reflet
