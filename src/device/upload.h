// Fills new images and buffers from the host's memory, and waits until that is done: for loading, not for frames.
#pragma once

#include "gpu/resource.h"

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace reflet::gpu {

class Device;

/// Creates a sampled texture from 8-bit RGBA pixels, optionally with mips down to 1x1, in read-only layout for all
/// shaders.
Texture uploadTexture(Device& device, uvec2 size, std::span<const uint8_t> rgba, bool srgb, bool mips,
                      const std::string& name);

/// The same for one layer of any colour format. texels: of level 0, rows from the top, tightly packed; the other levels
/// are generated.
Texture uploadTexels(Device& device, const ImageInfo& info, std::span<const std::byte> texels, const std::string& name);

/// Creates a device buffer with these bytes.
Buffer uploadBuffer(Device& device, std::span<const std::byte> bytes, VkBufferUsageFlags usage,
                    const std::string& name);

/// Creates a device buffer with these values, or with a single zero value if there are none, because buffers cannot be
/// empty.
template <class T>
Buffer uploadVector(Device& device, const std::vector<T>& values, VkBufferUsageFlags usage, const std::string& name) {
    const T none{};
    const std::span<const T> span = values.empty() ? std::span(&none, 1) : std::span(values);
    return uploadBuffer(device, std::as_bytes(span), usage, name);
}

}  // namespace reflet::gpu
