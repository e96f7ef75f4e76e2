// Checks a JPEG image before stb_image decodes it.
#pragma once

#include <cstdint>
#include <span>
#include <string>

namespace reflet {

bool startsAsJpeg(std::span<const uint8_t> bytes);

/// What is wrong with the Huffman tables or the number of scans, as the end of an error message; empty: nothing.
/// Versions of stb_image before 2.28 write past a table of more than 256 codes, and decode by a table that the file
/// does not define. A scan of a few bytes makes all of them visit every block.
std::string jpegProblem(std::span<const uint8_t> bytes);

}  // namespace reflet
