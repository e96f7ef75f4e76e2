// Decodes PNG, JPEG, WebP and KTX 2 images of a glTF file, from a file, a data URI or a buffer view.
#pragma once

#include "scene/gltf/document.h"
#include "scene/scene.h"

#include <compare>
#include <string_view>

namespace reflet {

/// Images with more than 8 bits per channel are reduced to 8. Throws Error if it is another format, has more than 16384
/// pixels per side, or claims more pixels than its bytes can encode.
TextureImage decodeGltfImage(const GltfDocument& document, size_t index, GltfReport& report);

/// Where an image's bytes are. Images of one place are one image.
struct GltfImagePlace {
    std::string_view uri;  ///< of the document's model
    int buffer = -1;       ///< where there is no URI
    size_t offset = 0;
    size_t length = 0;

    auto operator<=>(const GltfImagePlace&) const = default;  // NOLINT(modernize-use-nullptr)
};

/// report: throws the problem of the image's buffer view, if it has one.
GltfImagePlace placeOfGltfImage(const GltfDocument& document, size_t index, const GltfReport& report);

/// Whether it is compressed with Basis Universal, which decodeGltfImage cannot decode.
bool gltfImageIsBasis(const GltfDocument& document, size_t index, GltfReport& report);

}  // namespace reflet
