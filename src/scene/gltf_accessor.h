// The elements of an accessor, sparse and quantised ones too, read one at a time from the bytes where they lie.
#pragma once

#include "base/math.h"
#include "scene/gltf_document.h"

#include <cstdint>
#include <string_view>

namespace reflet {

/// Reads of elements of equal size out of bytes that someone else owns.
struct AccessorView {
    const uint8_t* data = nullptr;  ///< of element 0; null: every element is zero
    uint64_t stride = 0;            ///< bytes
    int componentType = TINYGLTF_COMPONENT_TYPE_FLOAT;
    int components = 1;
    bool normalized = false;  ///< integers stand for 0..1 or -1..1
    uint32_t count = 0;

    // Elements that stand elsewhere: sparseIndices, ascending, name them; sparseValues hold them.
    uint32_t sparseCount = 0;
    int sparseIndexType = TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT;
    const uint8_t* sparseIndices = nullptr;
    const uint8_t* sparseValues = nullptr;

    /// Up to four components as floats, those that are absent 0. i < count.
    [[nodiscard]] vec4 at(uint32_t i) const;
    /// Sixteen components, column after column. i < count.
    [[nodiscard]] mat4 matrixAt(uint32_t i) const;
    /// The first component of an unsigned integer type. i < count.
    [[nodiscard]] uint32_t integerAt(uint32_t i) const;

private:
    [[nodiscard]] const uint8_t* element(uint32_t i) const;
};

/// Throws Error where the accessor is too large, or its sparse indices do not ascend or reach past its count.
AccessorView viewAccessor(const GltfDocument& document, int index, GltfReport& report);

}  // namespace reflet
