// Random access to the elements of a glTF accessor, including sparse and quantized ones, without copying.
#pragma once

#include "base/math.h"
#include "scene/gltf/document.h"

#include <cstdint>
#include <string_view>

namespace reflet {

/// A view of elements of equal size in bytes that it does not own.
struct AccessorView {
    const uint8_t* data = nullptr;  ///< of element 0; null: every element is zero
    uint64_t stride = 0;            ///< bytes
    int componentType = TINYGLTF_COMPONENT_TYPE_FLOAT;
    int components = 1;
    bool normalized = false;  ///< integers represent 0..1 or -1..1
    uint32_t count = 0;

    // Sparse substitution: sparseIndices, ascending, and the sparseValues of those elements.
    uint32_t sparseCount = 0;
    int sparseIndexType = TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT;
    const uint8_t* sparseIndices = nullptr;
    const uint8_t* sparseValues = nullptr;

    /// Up to four components as floats; missing ones are 0. i < count.
    [[nodiscard]] vec4 at(uint32_t i) const;
    /// Sixteen components, column-major. i < count.
    [[nodiscard]] mat4 matrixAt(uint32_t i) const;
    /// The first component of an unsigned integer type. i < count.
    [[nodiscard]] uint32_t integerAt(uint32_t i) const;

private:
    [[nodiscard]] const uint8_t* element(uint32_t i) const;
};

/// Throws Error if the accessor is too large, or if its sparse indices do not ascend or are out of range.
AccessorView viewAccessor(const GltfDocument& document, int index, GltfReport& report);

}  // namespace reflet
