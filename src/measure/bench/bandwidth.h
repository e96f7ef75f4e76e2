// Measures the device's memory bandwidth.
#pragma once

#include "device/device.h"

namespace reflet {

/// Bytes read plus written per second: the best of several copies of images (RGBA16F, one thread per texel, as in the
/// passes) and of buffers (the copy command), both larger than current caches. The best observed value, not the
/// hardware's limit.
double measureBandwidth(gpu::Device& device);

}  // namespace reflet
