// Decodes the images of a glTF file: PNG and JPEG, from a file, a data URI or a buffer view.
#pragma once

#include "scene/gltf_document.h"
#include "scene/scene.h"

namespace reflet {

/// Images of more than 8 bits per channel become 8 bits. Throws Error where it is no such image, has more than
/// 16384 pixels a side, or claims more pixels than its bytes can hold.
Image decodeGltfImage(const GltfDocument& document, size_t index, GltfReport& report);

}  // namespace reflet
