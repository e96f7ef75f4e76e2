// What subcommands that render on a device have in common.
#pragma once

#include "base/math.h"
#include "gpu/device.h"

#include <string>

namespace CLI {
class App;
}  // namespace CLI

namespace reflet {

/// Adds --device.
void addDeviceOption(CLI::App& command, std::string& device);

/// Throws UsageError for a picture that is larger than the device or the renderer can make.
void requireSize(const gpu::Device& device, uvec2 size);

}  // namespace reflet
