// JPEG by libjpeg-turbo: what base/encoded_image.h calls for JPEG.
#pragma once

#include "base/encoded_image.h"

namespace reflet {

EncodedImageHeader readJpegHeader(std::span<const uint8_t> bytes);
/// Throws Error for more than 32 scans: each makes the decoder visit every block, which few bytes could ask for.
std::vector<uint8_t> decodeJpeg(std::span<const uint8_t> bytes, const EncodedImageHeader& header);

}  // namespace reflet
