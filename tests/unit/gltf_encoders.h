// Encodes what glTF extensions compress, for tests: images of other formats and meshopt buffer views.
#pragma once

#include "gltf_builder.h"

#include <cstdint>
#include <string>
#include <vector>

namespace reflet::test {

/// An RGBA image with 16 bits per channel.
std::vector<uint8_t> deepPngOf(uint32_t width, uint32_t height, const std::vector<uint16_t>& rgba);

/// Lossless.
std::vector<uint8_t> webpOf(int width, int height, const std::vector<uint8_t>& rgba);

/// A KTX 2 file with one level. format: a VkFormat; pixels: compressed with Zstandard if `zstd`.
std::vector<uint8_t> ktx2Of(uint32_t width, uint32_t height, uint32_t format, const std::vector<uint8_t>& pixels,
                            bool zstd);

/// A texture with this image in a buffer view: the texture's source, or that of the extension.
int addTextureOf(GltfBuilder& b, const std::vector<uint8_t>& image, const std::string& extension = "");

/// Encoded bytes that a buffer view decodes to `count` elements of `stride` bytes.
struct MeshoptView {
    std::vector<uint8_t> encoded;
    size_t count = 0;
    size_t stride = 0;
    const char* mode = "ATTRIBUTES";
    const char* filter = "NONE";
};
MeshoptView meshoptVertices(const void* vertices, size_t count, size_t stride, const char* filter = "NONE");
MeshoptView meshoptIndices(const std::vector<uint32_t>& indices, size_t stride, bool triangles);

/// Adds the bytes to the builder's buffer, and a view that decodes them into the fallback buffer 1. Returns the view.
int addMeshopt(GltfBuilder& b, const MeshoptView& view);
/// Adds both buffers, when all else has been added.
void addMeshoptBuffers(GltfBuilder& b);

/// A triangle with two morph targets: 0 moves the third vertex by (0, 0, 2) and its normal by (0, -1, 0), 1 (sparse)
/// the second one by (1, 0, 0). The weights go from (0, 0) to (1, 0.5) in 2 s.
GltfBuilder morphing();

/// A triangle from meshopt views, drawn as copies, with a WebP and a KTX 2 texture. exponential: its positions are
/// filtered.
GltfBuilder compressed(bool exponential = false);

}  // namespace reflet::test
