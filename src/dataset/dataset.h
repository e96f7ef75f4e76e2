// Makes data sets for training and testing denoisers: noisy and clean images of one view with features.
#pragma once

#include "dataset/options.h"
#include "device/device.h"

#include <functional>

namespace reflet {

/// Makes the frames of this share that are missing, and the index once no share misses any. device: called once, if
/// presets are rendered. Throws UsageError, and Error when interrupted.
void makeDataset(const DatasetOptions& options, const std::function<gpu::Device&()>& device);

}  // namespace reflet
