// The passes of a frame and their resources as plain values, for showing them.
#pragma once

#include "base/math.h"
#include "gpu/vulkan.h"

#include <cstdint>
#include <string>
#include <vector>

namespace reflet::gpu {

struct PassListing {
    struct Pass {
        std::string name;  ///< with its scopes: "diffuse.trace_screen"
        bool raster = false;
        std::vector<std::string> reads;  ///< names of resources
        std::vector<std::string> writes;
        uint64_t bytes = 0;  ///< size of all resources that it reads and writes
        uint32_t level = 0;  ///< passes of one level do not depend on each other
    };
    struct Resource {
        std::string name;
        std::string format;  ///< image format; empty: a buffer
        uvec2 size{0};       ///< image size, pixels
        uint64_t bytes = 0;
        int first = -1;       ///< index of the first pass that uses it; < 0: kept from frame to frame
        int last = -1;        ///< index of the last pass that uses it
        uint64_t offset = 0;  ///< in the memory that all transient resources share, bytes
    };

    std::vector<Pass> passes;  ///< in the order in which they are recorded
    std::vector<Resource> resources;
};

/// "R16G16B16A16_SFLOAT".
std::string formatName(VkFormat format);

}  // namespace reflet::gpu
