// Images of any sizes as layers of one texture array, for shaders that index among them: the minimum requirements do
// not include descriptor indexing.
#pragma once

#include "device/upload.h"

#include <span>
#include <string>

namespace reflet::gpu {

struct LayerImage {
    uvec2 size{0};
    std::span<const uint8_t> rgba;  ///< size.x · size.y · 4 bytes, rows from the top
    std::string name;
};

/// The mip level of a layer that an image fills: the smallest that is at least as large as the image; 0 for images
/// larger than the layer.
uint32_t layerLevel(uvec2 layerSize, uvec2 imageSize);

/// Creates a 2D array of `size` with mips down to 1x1, in read-only layout. Each image is resampled to its layerLevel
/// (unchanged if the sizes are equal), and the smaller levels are generated from there; finer levels have no content.
/// Larger images are minified.
Texture uploadTextureArray(Device& device, uvec2 size, std::span<const LayerImage> images, bool srgb,
                           const std::string& name);

}  // namespace reflet::gpu
