// Cross-checks of a glTF document: buffer views in buffers, accessors in views, the node hierarchy.
#include "scene/gltf_document.h"

#include <string>
#include <utility>

namespace reflet {

namespace {

uint64_t componentBytes(int componentType) {
    return static_cast<uint64_t>(tinygltf::GetComponentSizeInBytes(static_cast<uint32_t>(componentType)));
}

uint64_t elementBytes(const tinygltf::Accessor& accessor) {
    return componentBytes(accessor.componentType) *
           static_cast<uint64_t>(tinygltf::GetNumComponentsInType(static_cast<uint32_t>(accessor.type)));
}

/// The part of a buffer view that is read: `count` elements of `bytes` each, from `offset` on, `stride` bytes apart.
struct Reach {
    int view = -1;
    uint64_t offset = 0;
    uint64_t stride = 0;
    uint64_t bytes = 0;
    uint64_t count = 0;  ///< at least 1; count · stride < 2^63 by the schema
    uint64_t alignment = 1;
};

void checkReach(const tinygltf::Model& model, const Reach& reach, const std::string& part, const GltfReport& report) {
    const auto& view = model.bufferViews[static_cast<size_t>(reach.view)];
    const uint64_t end = reach.offset + (reach.count - 1) * reach.stride + reach.bytes;
    if (end > view.byteLength) {
        report.fail(part, "reaches {} bytes past bufferViews[{}]", end - view.byteLength, reach.view);
    }
    if (reach.stride < reach.bytes) {
        report.fail(part, "has elements of {} bytes, but bufferViews[{}].byteStride is {}", reach.bytes, reach.view,
                    reach.stride);
    }
    if ((view.byteOffset + reach.offset) % reach.alignment != 0 || reach.stride % reach.alignment != 0) {
        report.fail(part, "is misaligned: starts at byte {} with a stride of {}, but its components have {} bytes",
                    view.byteOffset + reach.offset, reach.stride, reach.alignment);
    }
}

void checkSparse(const tinygltf::Model& model, const tinygltf::Accessor& accessor, const std::string& part,
                 const GltfReport& report) {
    const auto& sparse = accessor.sparse;
    const auto count = static_cast<uint64_t>(sparse.count);
    if (count > accessor.count) {
        report.fail(part + ".sparse.count", "is {}, but the accessor has {} elements", count, accessor.count);
    }
    const uint64_t indexBytes = componentBytes(sparse.indices.componentType);
    checkReach(model,
               {.view = sparse.indices.bufferView,
                .offset = static_cast<uint64_t>(sparse.indices.byteOffset),
                .stride = indexBytes,
                .bytes = indexBytes,
                .count = count,
                .alignment = indexBytes},
               part + ".sparse.indices", report);
    checkReach(model,
               {.view = sparse.values.bufferView,
                .offset = static_cast<uint64_t>(sparse.values.byteOffset),
                .stride = elementBytes(accessor),
                .bytes = elementBytes(accessor),
                .count = count,
                .alignment = componentBytes(accessor.componentType)},
               part + ".sparse.values", report);
}

void checkAccessor(const tinygltf::Model& model, const tinygltf::Accessor& accessor, const std::string& part,
                   const GltfReport& report) {
    if (accessor.bufferView >= 0) {
        const uint64_t stride = model.bufferViews[static_cast<size_t>(accessor.bufferView)].byteStride;
        checkReach(model,
                   {.view = accessor.bufferView,
                    .offset = accessor.byteOffset,
                    .stride = stride != 0 ? stride : elementBytes(accessor),
                    .bytes = elementBytes(accessor),
                    .count = accessor.count,
                    .alignment = componentBytes(accessor.componentType)},
                   part, report);
    }
    if (accessor.sparse.isSparse) {
        checkSparse(model, accessor, part, report);
    }
}

/// Every node in a cycle has a parent, so a walk from the nodes without one never reaches it.
void checkCycles(const GltfDocument& document, const GltfReport& report) {
    std::vector<bool> reached(document.model.nodes.size(), false);
    std::vector<size_t> open;
    for (size_t i = 0; i < reached.size(); ++i) {
        if (!document.isChild[i]) {
            open.push_back(i);
        }
    }
    while (!open.empty()) {
        const size_t node = open.back();
        open.pop_back();
        reached[node] = true;
        for (const int child : document.model.nodes[node].children) {
            open.push_back(static_cast<size_t>(child));
        }
    }
    for (size_t i = 0; i < reached.size(); ++i) {
        if (!reached[i]) {
            report.fail(fmt::format("nodes[{}]", i), "is in a cycle of nodes, or below one");
        }
    }
}

}  // namespace

void checkGltfBuffers(const tinygltf::Model& model, const GltfReport& report) {
    for (size_t i = 0; i < model.bufferViews.size(); ++i) {
        const auto& view = model.bufferViews[i];
        const uint64_t size = model.buffers[static_cast<size_t>(view.buffer)].data.size();
        if (view.byteOffset + view.byteLength > size) {  // each at most 2^53 by the schema
            report.fail(fmt::format("bufferViews[{}]", i), "reaches {} bytes past buffers[{}]",
                        view.byteOffset + view.byteLength - size, view.buffer);
        }
    }
    for (size_t i = 0; i < model.accessors.size(); ++i) {
        checkAccessor(model, model.accessors[i], fmt::format("accessors[{}]", i), report);
    }
}

void checkGltfNodes(GltfDocument& document, const GltfReport& report) {
    const auto& nodes = document.model.nodes;
    document.isChild.assign(nodes.size(), false);
    for (size_t i = 0; i < nodes.size(); ++i) {
        for (const int child : nodes[i].children) {
            if (document.isChild[static_cast<size_t>(child)]) {
                report.fail(fmt::format("nodes[{}]", child), "has two parents; the second is nodes[{}]", i);
            }
            document.isChild[static_cast<size_t>(child)] = true;
        }
    }
    checkCycles(document, report);
    std::vector<size_t> lastListedIn(nodes.size(), document.model.scenes.size());
    for (size_t s = 0; s < document.model.scenes.size(); ++s) {
        for (const int node : document.model.scenes[s].nodes) {
            const bool twice = std::exchange(lastListedIn[static_cast<size_t>(node)], s) == s;
            if (twice || document.isChild[static_cast<size_t>(node)]) {
                report.fail(fmt::format("scenes[{}].nodes", s), "lists nodes[{}], which is {}", node,
                            twice ? "already in it" : "the child of another node");
            }
        }
    }
}

}  // namespace reflet
