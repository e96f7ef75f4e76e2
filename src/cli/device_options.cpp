// Options shared by the subcommands that render on a device.
#include "cli/device_options.h"

#include "base/error.h"
#include "base/home.h"
#include "base/progress.h"
#include "effects/lobe/rays.h"
#include "job/scene_options.h"
#include "renderer/shaders.h"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <memory>

namespace reflet {

void addDeviceOption(CLI::App& command, std::string& device) {
    command.add_option("--device", device, "Vulkan device: its number or part of its name (see reflet list devices)")
        ->type_name("NAME|INDEX");
}

gpu::DeviceOptions programDevice(const std::string& select, bool validation) {
    const auto cache = cacheFolder();
    return {.select = select,
            .validation = validation,
            .onMessage = printWarning,
            .shaders = {effectShaders(), rendererShaders()},
            .pipelineFolder = cache ? *cache / "pipelines" : std::filesystem::path(),
            .onCompile = [note = std::make_shared<WaitingNote>()](uint32_t shaders) {
                if (shaders > 0) {
                    note->begin(fmt::format("compiling {} shaders", shaders));
                } else {
                    note->end();
                }
            }};
}

void requireSize(const gpu::Device& device, uvec2 size) {
    if (const uint32_t limit = std::min(device.limits().maxImageDimension2D, maxFrameSize);
        std::max(size.x, size.y) > limit) {
        failUsage("--size {}x{}: '{}' supports sizes up to {}x{}", size.x, size.y, device.description().name, limit,
                  limit);
    }
}

}  // namespace reflet
