// What the device moves between its memory and itself, measured.
#pragma once

#include "gpu/device.h"

namespace reflet {

/// Bytes read and written per second, the best of several copies of images (RGBA16F, one thread a texel, as passes do
/// it) and of buffers (the copy command), larger than caches of today are. No promise of what the hardware could do:
/// the most that was seen.
double measureBandwidth(gpu::Device& device);

}  // namespace reflet
