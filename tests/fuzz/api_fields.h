// Spoils structs of the C API: what a host may get wrong in each field, but pointers to memory that is not there.
#pragma once

#include "api_bytes.h"

#include "stub/driver.h"

#include <span>

namespace reflet::fuzz {

enum class FieldKind : uint8_t {
    size,     ///< structSize
    reals,    ///< floats
    words,    ///< unsigned numbers
    wide,     ///< 64 bits
    value,    ///< an enum. C++ knows no value above MAX_ENUM.
    image,    ///< RefletImage
    pointer,  ///< becomes NULL
    count,    ///< of an array: the content may become smaller, or larger than all limits
};

struct Field {
    size_t offset;
    size_t bytes;
    FieldKind kind;
};

std::span<const Field> fieldsOf(const RefletContextInfo& of);
std::span<const Field> fieldsOf(const RefletMemoryCallbacks& of);
std::span<const Field> fieldsOf(const RefletViewInfo& of);
std::span<const Field> fieldsOf(const RefletGBuffer& of);
std::span<const Field> fieldsOf(const RefletFrameInfo& of);
std::span<const Field> fieldsOf(const RefletSunShadow& of);
std::span<const Field> fieldsOf(const RefletLampShadow& of);
std::span<const Field> fieldsOf(const RefletContactLight& of);
std::span<const Field> fieldsOf(const RefletEnvironment& of);
std::span<const Field> fieldsOf(const RefletProbe& of);
std::span<const Field> fieldsOf(const RefletPlanarView& of);
std::span<const Field> fieldsOf(const RefletIndirectLight& of);
std::span<const Field> fieldsOf(const RefletLens& of);
std::span<const Field> fieldsOf(const RefletToneMapInfo& of);
std::span<const Field> fieldsOf(const RefletRayAnswers& of);
std::span<const Field> fieldsOf(const RefletPrepareInfo& of);

void spoilImage(RefletImage& image, ApiBytes& bytes);
void spoilFields(void* of, std::span<const Field> fields, ApiBytes& bytes);

/// One field.
template <class T>
void spoil(T& of, ApiBytes& bytes) {
    spoilFields(&of, fieldsOf(of), bytes);
}
inline void spoil(RefletImage& of, ApiBytes& bytes) {
    spoilImage(of, bytes);
}

}  // namespace reflet::fuzz
