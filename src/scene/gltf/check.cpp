// Cross-checks of a glTF document: buffer views in buffers, accessors in views.
#include "scene/gltf/document.h"

#include <string>

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

void checkReach(const tinygltf::Model& model, const Reach& reach, const std::string& part, GltfReport& report) {
    report.use("bufferViews", static_cast<size_t>(reach.view));
    const auto& view = model.bufferViews[static_cast<size_t>(reach.view)];
    const uint64_t end = reach.offset + (reach.count - 1) * reach.stride + reach.bytes;
    if (end > view.byteLength) {
        report.fail(part, "reaches {} bytes past bufferViews[{}]", end - view.byteLength, reach.view);
    }
    if (reach.stride < reach.bytes) {
        report.fail(part, "has elements of {} bytes, but bufferViews[{}].byteStride is {}", reach.bytes, reach.view,
                    reach.stride);
    }
    report.tolerate("it will be read as it is", [&] {
        if ((view.byteOffset + reach.offset) % reach.alignment != 0 || reach.stride % reach.alignment != 0) {
            report.fail(part, "is misaligned: starts at byte {} with a stride of {}, but its components have {} bytes",
                        view.byteOffset + reach.offset, reach.stride, reach.alignment);
        }
    });
}

void checkSparse(const tinygltf::Model& model, const tinygltf::Accessor& accessor, const std::string& part,
                 GltfReport& report) {
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
                   GltfReport& report) {
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

void checkView(const tinygltf::Model& model, size_t index, const GltfReport& report) {
    const auto& view = model.bufferViews[index];
    const uint64_t size = model.buffers[static_cast<size_t>(view.buffer)].data.size();
    if (view.byteOffset + view.byteLength > size) {  // each at most 2^53 by the schema
        report.fail(fmt::format("bufferViews[{}]", index), "reaches {} bytes past buffers[{}]",
                    view.byteOffset + view.byteLength - size, view.buffer);
    }
}

}  // namespace

void checkGltfBuffers(tinygltf::Model& model, GltfReport& report) {
    for (size_t i = 0; i < model.bufferViews.size(); ++i) {
        tinygltf::BufferView& view = model.bufferViews[i];
        const bool isValid = report.tolerateUntilUsed("bufferViews", i, [&] {
            report.use("buffers", static_cast<size_t>(view.buffer));
            checkView(model, i, report);
        });
        if (!isValid) {
            view.byteOffset = 0;
            view.byteLength = 0;
        }
    }
    for (size_t i = 0; i < model.accessors.size(); ++i) {
        tinygltf::Accessor& accessor = model.accessors[i];
        const bool isValid = report.tolerateUntilUsed(
            "accessors", i, [&] { checkAccessor(model, accessor, fmt::format("accessors[{}]", i), report); });
        if (!isValid) {
            accessor.bufferView = -1;
            accessor.sparse.isSparse = false;
            accessor.count = 1;
        }
    }
}

}  // namespace reflet
