// Passes that show a lobe at full resolution: they include upsample.glsl, or upsample_specular.glsl.
#pragma once

#include "effects/lobe/rays.h"

namespace reflet {

/// Pixels along the side of the lobe's blocks; 0: the lobe is black, and need not be read.
uint32_t upsampledScale(const LobeLight& light);

/// An image of the lobe's surfaces; none is read at full resolution.
gpu::Image surfacesToUpsample(gpu::PassList& f, const LobeLight& light, gpu::Image image, VkFormat format);

/// Binds what upsample_specular.glsl reads.
gpu::ComputePass& bindUpsampledSpecular(gpu::PassList& f, gpu::ComputePass& pass, const LobeLight& specular);

}  // namespace reflet
