// Images of any sizes as layers of one texture, for shaders that choose among them: the device floor has no arrays of
// descriptors that may be indexed freely.
#pragma once

#include "gpu/resource.h"

#include <span>
#include <string>

namespace reflet::gpu {

struct LayerImage {
    uvec2 size{0};
    std::span<const uint8_t> rgba;  ///< size.x · size.y · 4 bytes, rows from the top
    std::string name;
};

/// The level of a layer that an image fills: the smallest that is at least as large, 0 for images that are larger than
/// the layer.
uint32_t layerLevel(uvec2 layerSize, uvec2 imageSize);

/// A 2D array of `size` with mips down to 1x1, ready to be sampled. Each image is stretched over its layer's
/// layerLevel, where it keeps its texels if that has its size, and the levels below are made from there; finer levels
/// of the layer hold nothing. Larger images are shrunk.
Texture uploadTextureArray(Device& device, uvec2 size, std::span<const LayerImage> images, bool srgb,
                           const std::string& name);

}  // namespace reflet::gpu
