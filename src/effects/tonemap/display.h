// Tone mapping for any display: sRGB, linear scRGB or PQ, in several formats, optionally into a host's image.
// Shared by C++ and GLSL.
//
// scRGB: IEC 61966-2-2, 1 is 80 nits. PQ: SMPTE ST 2084, primaries of ITU-R BT.2020, from BT.709 by ITU-R BT.2087.
#ifndef REFLET_EFFECTS_DISPLAY_H
#define REFLET_EFFECTS_DISPLAY_H

#include "base/shared.h"

SHARED_BEGIN

const uint transferSrgb = 0;
const uint transferScrgb = 1;
const uint transferPq = 2;

struct DisplayParams {
    uvec2 size;        // size of the radiance image
    uvec2 offset;      // where its top left pixel goes in the target
    float factor;      // exposure factor on radiance
    float paperWhite;  // luminance of white [nits]; not used for sRGB
    float peak;        // peak luminance of the display, in multiples of paperWhite, at least 1
};

SHARED_END

#ifdef __cplusplus

#include "effects/tonemap/tonemap.h"

namespace reflet {

/// Where a tone-mapped picture goes.
struct DisplayTarget {
    VkFormat format = VK_FORMAT_R8G8B8A8_UNORM;  ///< format of the new image, if `image` is none
    gpu::Image image{};  ///< a storage image of at least the picture's size; none: one of this frame
    uvec2 offset{0};     ///< of the picture in `image`
    uint32_t transfer = transferSrgb;
    float paperWhite = 203.0F;
    float peakNits = 1000.0F;  ///< at least paperWhite
};

/// Formats that displayFor() writes, whichever features the device has; others need
/// shaderStorageImageWriteWithoutFormat.
bool isPlainDisplayFormat(VkFormat format);

/// Applies exposure, tone curve and transfer function. exposure: R32F, 1x1: a factor on radiance in addition to the
/// settings' exposure; values that are not positive and finite count as 1. None: 1. Alpha is 1.
gpu::Image displayFor(gpu::PassList& f, gpu::Image radiance, const TonemapSettings& settings, gpu::Image exposure,
                      const DisplayTarget& target);

}  // namespace reflet
#endif

#endif
