// Decodes images of the formats that a glTF file may have: one function per format. The bytes come from strangers: each
// checks the size that they claim before it takes memory, which it charges to the report.
#pragma once

#include "scene/gltf/report.h"
#include "scene/scene.h"

#include <cstdint>
#include <span>
#include <string>

namespace reflet {

bool isWebp(std::span<const uint8_t> bytes);
bool isKtx2(std::span<const uint8_t> bytes);
/// Whether a KTX 2 file holds Basis Universal data (ETC1S or UASTC), which are not decoded. The first 64 bytes are
/// enough.
bool isBasis(std::span<const uint8_t> bytes);

// part: the JSON path of the image. All throw Error for broken, too large or unsupported images; those without a name
// are returned.

/// PNG of 16 bits per channel are rounded to 8.
TextureImage decodePngOrJpeg(std::span<const uint8_t> bytes, const std::string& part, GltfReport& report);
TextureImage decodeWebp(std::span<const uint8_t> bytes, const std::string& part, GltfReport& report);
/// The largest level of a two-dimensional texture with one to four unsigned normalized channels of 8 bits each, as it
/// is or with Zstandard.
TextureImage decodeKtx2(std::span<const uint8_t> bytes, const std::string& part, GltfReport& report);

/// Throws Error if the size is 0 or more than 16384 pixels per side; charges four bytes per pixel.
void checkImageSize(uint64_t width, uint64_t height, const std::string& part, GltfReport& report);

}  // namespace reflet
