// Checks of the node hierarchy of a glTF document, and the roots of its scenes.
#include "scene/gltf/document.h"

#include <string>
#include <utility>

namespace reflet {

namespace {

/// Makes these children of other nodes roots.
void makeRoots(GltfDocument& document, const std::vector<bool>& roots) {
    for (tinygltf::Node& node : document.model.nodes) {
        std::erase_if(node.children, [&](int child) { return roots[static_cast<size_t>(child)]; });
    }
    for (size_t i = 0; i < roots.size(); ++i) {
        document.isChild[i] = document.isChild[i] && !roots[i];
    }
}

void checkParents(GltfDocument& document, GltfReport& report) {
    auto& nodes = document.model.nodes;
    document.isChild.assign(nodes.size(), false);
    for (size_t i = 0; i < nodes.size(); ++i) {
        std::erase_if(nodes[i].children, [&](int child) {
            const bool isFirst = report.tolerate("the node will be drawn below the first of its parents", [&] {
                if (document.isChild[static_cast<size_t>(child)]) {
                    report.fail(fmt::format("nodes[{}]", child), "has two parents; the second is nodes[{}]", i);
                }
            });
            document.isChild[static_cast<size_t>(child)] = true;
            return !isFirst;
        });
    }
}

/// All nodes, first those that the scenes list.
std::vector<size_t> inDrawnOrder(const tinygltf::Model& model) {
    std::vector<size_t> order;
    for (const tinygltf::Scene& scene : model.scenes) {
        order.insert(order.end(), scene.nodes.begin(), scene.nodes.end());
    }
    for (size_t i = 0; i < model.nodes.size(); ++i) {
        order.push_back(i);
    }
    return order;
}

/// Every node in a cycle has a parent, so a walk from the nodes without one never reaches it.
void checkCycles(GltfDocument& document, GltfReport& report) {
    std::vector<bool> reached(document.model.nodes.size(), false);
    std::vector<size_t> open;
    const auto walk = [&] {
        while (!open.empty()) {
            const size_t node = open.back();
            open.pop_back();
            reached[node] = true;
            for (const int child : document.model.nodes[node].children) {
                if (!reached[static_cast<size_t>(child)]) {
                    open.push_back(static_cast<size_t>(child));
                }
            }
        }
    };
    for (size_t i = 0; i < reached.size(); ++i) {
        if (!document.isChild[i]) {
            open.push_back(i);
        }
    }
    walk();
    std::vector<bool> roots(reached.size(), false);
    for (const size_t i : inDrawnOrder(document.model)) {
        roots[i] = roots[i] || !report.tolerate("the node will be drawn as a root", [&] {
            if (!reached[i]) {
                report.fail(fmt::format("nodes[{}]", i), "is in a cycle of nodes, or below one");
            }
        });
        open.push_back(i);
        walk();
    }
    makeRoots(document, roots);
}

void checkTransform(tinygltf::Node& node, const std::string& part, GltfReport& report) {
    const auto& m = node.matrix;
    const bool isAffine = report.tolerate("its last row will be taken for 0 0 0 1", [&] {
        if (m.size() == 16 && (m[3] != 0.0 || m[7] != 0.0 || m[11] != 0.0 || m[15] != 1.0)) {
            report.fail(part + ".matrix", "its last row is not 0 0 0 1");
        }
    });
    for (const size_t i : {3U, 7U, 11U, 15U}) {
        if (!isAffine) {
            node.matrix[i] = i == 15 ? 1.0 : 0.0;
        }
    }
    const auto& r = node.rotation;
    const bool isRotation = report.tolerate("the node will not be rotated", [&] {
        if (r.size() == 4 && r[0] * r[0] + r[1] * r[1] + r[2] * r[2] + r[3] * r[3] == 0.0) {
            report.fail(part + ".rotation", "is not a rotation: the quaternion's length is 0");
        }
    });
    if (!isRotation) {
        node.rotation.clear();
    }
}

void checkScenes(const GltfDocument& document, GltfReport& report) {
    const auto& scenes = document.model.scenes;
    std::vector<size_t> lastListedIn(document.model.nodes.size(), scenes.size());
    for (size_t s = 0; s < scenes.size(); ++s) {
        for (const int node : scenes[s].nodes) {
            const bool twice = std::exchange(lastListedIn[static_cast<size_t>(node)], s) == s;
            report.tolerate("the node will be drawn once", [&] {
                if (twice || document.isChild[static_cast<size_t>(node)]) {
                    report.fail(fmt::format("scenes[{}].nodes", s), "lists nodes[{}], which is {}", node,
                                twice ? "already in it" : "the child of another node");
                }
            });
        }
    }
}

}  // namespace

void checkGltfNodes(GltfDocument& document, GltfReport& report) {
    checkParents(document, report);
    checkCycles(document, report);
    for (size_t i = 0; i < document.model.nodes.size(); ++i) {
        checkTransform(document.model.nodes[i], fmt::format("nodes[{}]", i), report);
    }
    checkScenes(document, report);
}

std::vector<int> rootsOfGltfScene(GltfDocument& document, size_t scene) {
    const auto& nodes = document.model.nodes;
    const std::vector<int>& listed = document.model.scenes[scene].nodes;
    std::vector<bool> isListed(nodes.size(), false);
    for (const int node : listed) {
        isListed[static_cast<size_t>(node)] = true;
    }
    std::vector<bool> isRoot(nodes.size(), false);
    std::vector<std::pair<size_t, bool>> open;  // a node, and whether one above it is in the scene
    for (size_t i = 0; i < nodes.size(); ++i) {
        if (!document.isChild[i]) {
            open.emplace_back(i, false);
        }
    }
    while (!open.empty()) {
        const auto [node, isBelow] = open.back();
        open.pop_back();
        isRoot[node] = isListed[node] && !isBelow;
        for (const int child : nodes[node].children) {
            open.emplace_back(static_cast<size_t>(child), isBelow || isListed[node]);
        }
    }
    std::vector<int> roots;
    for (const int node : listed) {
        if (isListed[static_cast<size_t>(node)] && isRoot[static_cast<size_t>(node)]) {
            roots.push_back(node);
        }
        isListed[static_cast<size_t>(node)] = false;
    }
    makeRoots(document, isRoot);
    return roots;
}

}  // namespace reflet
