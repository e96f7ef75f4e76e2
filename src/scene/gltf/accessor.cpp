// Reads elements of glTF accessors.
#include "scene/gltf/accessor.h"

#include <algorithm>
#include <cstring>

namespace reflet {

namespace {

// Elements without data in the file, which are zero: all of them, or all but some.
constexpr uint64_t maxZeros = 1ULL << 16U;
constexpr uint64_t maxUnbackedCount = 1ULL << 22U;

template <class T>
T load(const uint8_t* bytes) {
    T value;  // NOLINT(cppcoreguidelines-init-variables)
    std::memcpy(&value, bytes, sizeof value);
    return value;
}

/// glTF 2.0, 3.6.2.2: signed types have one more negative value than positive ones.
template <class T>
float converted(const uint8_t* bytes, bool normalized) {
    const auto value = static_cast<float>(load<T>(bytes));
    return normalized ? std::max(value / static_cast<float>(std::numeric_limits<T>::max()), -1.0F) : value;
}

float component(const uint8_t* bytes, int type, bool normalized) {
    switch (type) {
        case TINYGLTF_COMPONENT_TYPE_BYTE:
            return converted<int8_t>(bytes, normalized);
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
            return converted<uint8_t>(bytes, normalized);
        case TINYGLTF_COMPONENT_TYPE_SHORT:
            return converted<int16_t>(bytes, normalized);
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
            return converted<uint16_t>(bytes, normalized);
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
            return converted<uint32_t>(bytes, normalized);
        default:
            return load<float>(bytes);
    }
}

uint32_t integer(const uint8_t* bytes, int type) {
    switch (type) {
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
            return load<uint8_t>(bytes);
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
            return load<uint16_t>(bytes);
        default:
            return load<uint32_t>(bytes);
    }
}

uint32_t bytesOf(int componentType) {
    return static_cast<uint32_t>(tinygltf::GetComponentSizeInBytes(static_cast<uint32_t>(componentType)));
}

const uint8_t* bytesAt(const tinygltf::Model& model, int view, uint64_t offset) {
    const auto& bufferView = model.bufferViews[static_cast<size_t>(view)];
    return model.buffers[static_cast<size_t>(bufferView.buffer)].data.data() + bufferView.byteOffset + offset;
}

void addSparse(AccessorView& view, const GltfDocument& document, int index, GltfReport& report) {
    const auto& sparse = document.model.accessors[static_cast<size_t>(index)].sparse;
    view.sparseCount = static_cast<uint32_t>(sparse.count);
    view.sparseIndexType = sparse.indices.componentType;
    view.sparseIndices =
        bytesAt(document.model, sparse.indices.bufferView, static_cast<uint64_t>(sparse.indices.byteOffset));
    view.sparseValues =
        bytesAt(document.model, sparse.values.bufferView, static_cast<uint64_t>(sparse.values.byteOffset));
    const uint32_t size = bytesOf(view.sparseIndexType);
    const std::string part = fmt::format("accessors[{}].sparse.indices", index);
    report.charge(part, uint64_t(view.sparseCount) * size);  // limits the total time where accessors share bytes
    for (uint32_t i = 0; i < view.sparseCount; ++i) {
        const uint32_t named = integer(view.sparseIndices + uint64_t(i) * size, view.sparseIndexType);
        if (named >= view.count) {
            report.fail(part, "index {} is {}, but there are {} elements", i, named, view.count);
        }
        if (i > 0 && named <= integer(view.sparseIndices + uint64_t(i - 1) * size, view.sparseIndexType)) {
            report.fail(part, "index {} is not greater than the one before it", i);
        }
    }
}

}  // namespace

const uint8_t* AccessorView::element(uint32_t i) const {
    const uint32_t size = bytesOf(sparseIndexType);
    uint32_t low = 0;
    for (uint32_t length = sparseCount; length > 0;) {  // binary search: the first sparse index not below i
        const uint32_t half = length / 2;
        const bool below = integer(sparseIndices + uint64_t(low + half) * size, sparseIndexType) < i;
        low = below ? low + half + 1 : low;
        length = below ? length - half - 1 : half;
    }
    if (low < sparseCount && integer(sparseIndices + uint64_t(low) * size, sparseIndexType) == i) {
        return sparseValues + uint64_t(low) * bytesOf(componentType) * static_cast<uint64_t>(components);
    }
    return data != nullptr ? data + stride * i : nullptr;
}

vec4 AccessorView::at(uint32_t i) const {
    vec4 result(0.0F);
    if (const uint8_t* bytes = element(i)) {
        for (int c = 0; c < std::min(components, 4); ++c) {
            result[c] = component(bytes + static_cast<size_t>(c) * bytesOf(componentType), componentType, normalized);
        }
    }
    return result;
}

mat4 AccessorView::matrixAt(uint32_t i) const {
    mat4 result(0.0F);
    const uint8_t* bytes = element(i);
    for (int c = 0; bytes != nullptr && c < 16; ++c) {
        result[c / 4][c % 4] =
            component(bytes + static_cast<size_t>(c) * bytesOf(componentType), componentType, normalized);
    }
    return result;
}

uint32_t AccessorView::integerAt(uint32_t i) const {
    const uint8_t* bytes = element(i);
    return bytes != nullptr ? integer(bytes, componentType) : 0;
}

AccessorView viewAccessor(const GltfDocument& document, int index, GltfReport& report) {
    report.use("accessors", static_cast<size_t>(index));
    const auto& accessor = document.model.accessors[static_cast<size_t>(index)];
    AccessorView view;
    view.componentType = accessor.componentType;
    view.components = tinygltf::GetNumComponentsInType(static_cast<uint32_t>(accessor.type));
    view.normalized = accessor.normalized;
    view.count = static_cast<uint32_t>(accessor.count);
    if (accessor.bufferView >= 0) {
        const auto stride = document.model.bufferViews[static_cast<size_t>(accessor.bufferView)].byteStride;
        view.data = bytesAt(document.model, accessor.bufferView, accessor.byteOffset);
        view.stride = stride != 0 ? stride : bytesOf(view.componentType) * static_cast<uint64_t>(view.components);
    } else if (const uint64_t most = accessor.sparse.isSparse ? maxUnbackedCount : maxZeros; accessor.count > most) {
        report.fail(fmt::format("accessors[{}]", index),
                    "has {} elements without a buffer view, but at most {} are supported", accessor.count, most);
    }
    if (accessor.sparse.isSparse) {
        addSparse(view, document, index, report);
    }
    return view;
}

}  // namespace reflet
