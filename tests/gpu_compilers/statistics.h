// Everything that was recorded, as a file for docs/gpu_model.py.
#pragma once

#include "gpu_compilers/recorder.h"

#include <filesystem>
#include <map>
#include <string>

namespace reflet::gpu_compilers {

/// JSON: driver, kernels with their loops, frames with their passes.
void writeStatistics(const std::filesystem::path& file, const std::string& driver,
                     const std::map<std::string, RecordedFrame>& frames);

}  // namespace reflet::gpu_compilers
