// Options shared by the subcommands that render on a device.
#include "cli/device_options.h"

#include "base/error.h"
#include "effects/lobe/rays.h"

#include <CLI/CLI.hpp>

#include <algorithm>

namespace reflet {

void addDeviceOption(CLI::App& command, std::string& device) {
    command.add_option("--device", device, "Vulkan device: its number or part of its name (see reflet list devices)")
        ->type_name("NAME|INDEX");
}

void requireSize(const gpu::Device& device, uvec2 size) {
    if (const uint32_t limit = std::min(device.limits().maxImageDimension2D, maxFrameSize);
        std::max(size.x, size.y) > limit) {
        failUsage("--size {}x{}: '{}' supports sizes up to {}x{}", size.x, size.y, device.description().name, limit,
                  limit);
    }
}

}  // namespace reflet
