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

/// How the program opens a device for rendering: messages and what takes long are said on standard error, and compiled
/// pipelines are kept in the user's cache folder.
gpu::DeviceOptions programDevice(const std::string& select, bool validation = false);

/// Throws UsageError for an image that is larger than the device or the renderer supports.
void requireSize(const gpu::Device& device, uvec2 size);

}  // namespace reflet
