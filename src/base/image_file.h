// Pictures in files: PNG for looking at, OpenEXR (several layers) and Radiance HDR for values.
// All writing is atomic (see base/file.h) and the same picture gives the same bytes. Rows run from the top.
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace reflet {

/// 8-bit picture. What the numbers mean (sRGB or not) is the caller's business.
struct Bitmap {
    uint32_t width = 0;
    uint32_t height = 0;
    uint32_t channels = 4;      ///< 1 grey, 2 grey and alpha, 3 RGB, 4 RGBA
    std::vector<uint8_t> data;  ///< width · height · channels bytes, interleaved
};

/// Linear picture.
struct FloatImage {
    uint32_t width = 0;
    uint32_t height = 0;
    std::vector<std::string> channels;  ///< "R" "G" "B", "X" "Y" "Z", "Y" ...; without dots
    std::vector<float> data;            ///< width · height · channels.size() values, interleaved
};

enum class PixelType : uint8_t { half, float32 };

/// One layer of an EXR file. Its channels are called NAME.CHANNEL in the file, or CHANNEL where the name is empty.
struct ImageLayer {
    std::string name;
    FloatImage image;
    PixelType pixelType = PixelType::float32;  ///< in the file; half clamps finite values to ±65504
};

/// Bitmap of 3 or 4 channels. Throws Error if the file cannot be written.
void writePng(const std::filesystem::path& path, const Bitmap& bitmap);

/// PNG, JPEG and the other 8-bit formats that stb knows; the channels that the file has. Throws Error.
Bitmap readBitmap(const std::filesystem::path& path);

/// At least one layer, all of one size, no two channels of one name. ZIP compression. Throws Error if the file cannot
/// be written.
void writeExr(const std::filesystem::path& path, std::span<const ImageLayer> layers);

/// All channels of the first part of an EXR file as layers, ordered by name (the unnamed one first); channels in the
/// order R G B A, then alphabetical. The size is that of the data window, at most 65536 pixels a side. Integer channels
/// become float. Throws Error.
std::vector<ImageLayer> readExr(const std::filesystem::path& path);

/// Radiance .hdr as "R" "G" "B". Throws Error.
FloatImage readHdr(const std::filesystem::path& path);

}  // namespace reflet
