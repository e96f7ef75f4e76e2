// Resamples an image that is kept from frame to frame when the size of the frames changes (gpu::HistoryImage): motion
// and reprojection are in uv, so that nothing else has to know. Shared by C++ and GLSL.
#ifndef REFLET_EFFECTS_RESCALE_H
#define REFLET_EFFECTS_RESCALE_H

#include "base/shared.h"

SHARED_BEGIN

struct RescaleParams {
    uvec2 from;  // size in pixels
    uvec2 to;
    vec2 ratio;   // texels of `from` per texel of `to`. Not that of the sizes: a coarse grid may reach beyond the frame
    vec2 centre;  // where in a texel its pixel has its centre: that of a coarse grid's shows one pixel of a block
};

SHARED_END

#ifdef __cplusplus

#include "gpu/pass_list.h"

#include <span>

namespace reflet {

/// Writes all of `to`, which shows the same in another size. RGBA16F; RG16F: linear; R32F, RG32F: nearest; RG32_UINT:
/// with depth in one channel.
void rescaleHistory(gpu::PassList& f, const gpu::Image& from, const gpu::Image& to, gpu::Resample resample);

/// The formats that rescaleHistory takes.
std::span<const VkFormat> rescaledFormats();

}  // namespace reflet
#endif

#endif
