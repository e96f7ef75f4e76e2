// Checks a JPEG image before stb_image decodes it.
#pragma once

#include <cstdint>
#include <span>
#include <string>

namespace reflet {

bool startsAsJpeg(std::span<const uint8_t> bytes);

/// What is wrong with the Huffman tables, as the end of an error message; empty: nothing. Versions of stb_image before
/// 2.28 write past a table of more than 256 codes, and decode by a table that the file does not define.
std::string jpegProblem(std::span<const uint8_t> bytes);

}  // namespace reflet
