// Image files: PNG for display, OpenEXR (several layers) and Radiance HDR for values.
// All writing is atomic (see base/file.h), and equal images give equal bytes. Rows run from the top.
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace reflet {

/// 8-bit image. The encoding (sRGB or not) is up to the caller.
struct Bitmap {
    uint32_t width = 0;
    uint32_t height = 0;
    uint32_t channels = 4;      ///< 1 grey, 2 grey and alpha, 3 RGB, 4 RGBA
    std::vector<uint8_t> data;  ///< width · height · channels bytes, interleaved
};

/// Linear image.
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

/// Writes a bitmap of 3 or 4 channels. Throws Error if the file cannot be written.
void writePng(const std::filesystem::path& path, const Bitmap& bitmap);

/// Reads PNG and JPEG, with the channels of the file. Throws Error, also for
/// an image beyond imageExcess (base/limits.h), as the readers below do.
Bitmap readBitmap(const std::filesystem::path& path);

/// Writes at least one layer; all of the same size, with unique channel names. ZIP compression. Throws Error if the
/// file cannot be written.
void writeExr(const std::filesystem::path& path, std::span<const ImageLayer> layers);

/// Reads all channels of the first part of an EXR file as layers, ordered by name (the unnamed one first); channels in
/// the order R G B A, then alphabetical. The size is that of the data window, at most 65536 pixels a side. Integer
/// channels become float. Throws Error.
std::vector<ImageLayer> readExr(const std::filesystem::path& path);

/// Whether a file has its end, by its suffix: PNG's last chunk, EXR's last line; others must not be empty. False for
/// what is no regular file or cannot be read. Reads little of the file: what a copy or a full disk left unfinished is
/// told from a finished file, not every damage.
bool isWholeImage(const std::filesystem::path& path);

/// Reads Radiance .hdr as "R" "G" "B". Throws Error.
FloatImage readHdr(const std::filesystem::path& path);

}  // namespace reflet
