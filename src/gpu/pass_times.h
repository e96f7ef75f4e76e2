// Device times of passes, by timestamp queries.
#pragma once

#include "gpu/vulkan.h"

#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace reflet::gpu {

class Context;

/// Device time of one pass in milliseconds; passes of the same name are summed. Independent passes overlap on a GPU:
/// the time of one then includes time of others.
struct PassTime {
    std::string name;
    double ms = 0.0;
    /// Size of the bound images and buffers, each counted once: the least memory traffic if the pass reads or writes
    /// all of them. Excludes what draws bind themselves (vertices, textures of materials).
    uint64_t bytes = 0;
    bool raster = false;  ///< draws triangles
};

class PassTimers {
public:
    /// measures: if false, passes get labels only, no times.
    PassTimers(Context& context, bool measures) : context_(context), measures_(measures) {}

    struct Timed {
        std::string_view name;
        uint32_t nameIndex = 0;  ///< equal for equal names
        uint64_t bytes = 0;
        bool raster = false;
    };
    /// Queries of one frame in flight.
    struct Frame {
        std::vector<VkQueryPool> pools;  ///< filled in turn
        std::vector<Timed> passes;       ///< times not yet read
    };

    void makePool(Frame& frame);
    void destroy(Frame& frame);
    void reset(Frame& frame, VkCommandBuffer commands) const;
    void begin(Frame& frame, VkCommandBuffer commands, const Timed& pass);
    void end(Frame& frame, VkCommandBuffer commands);
    /// Replaces `times`: "frame" first, then the passes in recording order.
    void read(const Frame& frame, std::vector<PassTime>& times);

private:
    std::pair<VkQueryPool, uint32_t> timestamp(Frame& frame, VkCommandBuffer commands, uint32_t which);

    Context& context_;
    bool measures_;
    std::vector<uint64_t> ticks_;
    std::vector<uint32_t> indices_;  ///< by name index: index into the times, plus 1
};

}  // namespace reflet::gpu
