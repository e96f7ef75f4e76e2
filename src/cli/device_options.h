// Options shared by the subcommands that render on a device.
#pragma once

#include "base/math.h"
#include "device/device.h"

#include <string>

namespace CLI {
class App;
}  // namespace CLI

namespace reflet {

/// Adds --device.
void addDeviceOption(CLI::App& command, std::string& device);

/// Throws UsageError for an image that is larger than the device or the renderer supports.
void requireSize(const gpu::Device& device, uvec2 size);

}  // namespace reflet
