// PNG by libspng: what base/encoded_image.h calls for PNG.
#pragma once

#include "base/encoded_image.h"

namespace reflet {

EncodedImageHeader readPngHeader(std::span<const uint8_t> bytes);
std::vector<uint8_t> decodePng(std::span<const uint8_t> bytes, const EncodedImageHeader& header);

}  // namespace reflet
