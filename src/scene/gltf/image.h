// Decodes PNG, JPEG, WebP and KTX 2 images of a glTF file, from a file, a data URI or a buffer view.
#pragma once

#include "scene/gltf/document.h"
#include "scene/scene.h"

namespace reflet {

/// Images with more than 8 bits per channel are reduced to 8. Throws Error if it is another format, has more than 16384
/// pixels per side, or claims more pixels than its bytes can encode.
TextureImage decodeGltfImage(const GltfDocument& document, size_t index, GltfReport& report);

/// Whether it is compressed with Basis Universal, which decodeGltfImage cannot decode.
bool gltfImageIsBasis(const GltfDocument& document, size_t index, GltfReport& report);

}  // namespace reflet
