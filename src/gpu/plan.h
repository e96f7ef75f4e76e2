// What a list of passes becomes before it is recorded, as a function of plain values: which passes are needed, in which
// order, what shares memory, and where barriers stand. Nothing here knows a device.
//
// The idea of a frame as a function whose intermediate images are placed afterwards: Y. O'Donnell, FrameGraph (GDC
// 2017). Barriers: each hazard is an interval of positions that one of them must stand in; putting each as late as its
// first hazard allows needs the fewest (stabbing of intervals, greedy).
#pragma once

#include "gpu/resource.h"

#include <cstdint>
#include <vector>

namespace reflet::gpu {

/// How a pass accesses a resource.
struct Access {
    VkPipelineStageFlags2 stages = 0;
    VkAccessFlags2 access = 0;
    bool write = false;

    bool operator==(const Access&) const = default;
};

/// Both by one pass.
Access merged(const Access& a, const Access& b);

struct ResourceUse {
    uint32_t resource = 0;  ///< index of PassGraph::resources; at most once in a pass
    Access access;

    bool operator==(const ResourceUse&) const = default;
};

struct GraphPass {
    uint32_t firstUse = 0;  ///< in PassGraph::uses
    uint32_t useCount = 0;
    bool root = false;  ///< needed, whoever reads what it writes: read-backs

    bool operator==(const GraphPass&) const = default;
};

/// When the memory of something that is kept from frame to frame is free for what lives in one frame.
enum class HeldUse : uint8_t {
    busy,       ///< never
    untilLast,  ///< behind its last use in the list: nobody reads it again
    fromFirst,  ///< before its first use, which overwrites it
};

struct GraphResource {
    bool transient = false;   ///< its contents do not come from before the list, and it has no memory yet
    bool output = false;      ///< transient: its contents are read after the list
    bool image = false;       ///< has a layout
    bool undefined = false;   ///< not transient: an image that is in no layout, or whose memory others have used
    bool held = false;        ///< not transient: it lies in a heap, at one of GraphHeap::held
    uint32_t heap = 0;        ///< transient or held: index of PassGraph::heaps
    VkDeviceSize offset = 0;  ///< held: in the heap
    VkDeviceSize size = 0;    ///< transient or held
    VkDeviceSize alignment = 1;
    AccessState before;  ///< not transient: what its first use must wait for

    bool operator==(const GraphResource&) const = default;
};

struct MemoryRange {
    VkDeviceSize offset = 0;
    VkDeviceSize size = 0;

    bool operator==(const MemoryRange&) const = default;
};

/// Memory of something that is kept, but that others may use in part of the list.
struct HeldRange {
    static constexpr uint32_t unused = UINT32_MAX;

    MemoryRange range;
    HeldUse use = HeldUse::busy;
    uint32_t resource = unused;  ///< index of PassGraph::resources; unused: the list does not use it. It is free then
                                 ///< unless it is busy, but with fromFirst not for outputs: a later list writes it

    bool operator==(const HeldRange&) const = default;
};

/// Memory that transient resources are placed in: blocks, one after another in one space of offsets, in which nothing
/// lies across two blocks. Behind the last one is room without end, for a block that will be made.
struct GraphHeap {
    std::vector<VkDeviceSize> blocks;  ///< their sizes
    std::vector<MemoryRange> taken;    ///< by outputs of earlier lists of the frame
    std::vector<HeldRange> held;
    Access before;  ///< by what was in this memory before; write: its access has writes

    bool operator==(const GraphHeap&) const = default;
};

enum class PassOrder : uint8_t {
    byLevel,   ///< passes that need not wait for each other stand together: fewest barriers. For GPUs
    asListed,  ///< what a pass reads is still in the caches of a CPU, to which a barrier costs nothing
};

struct PassGraph {
    PassOrder order = PassOrder::byLevel;
    std::vector<GraphPass> passes;
    std::vector<ResourceUse> uses;
    std::vector<GraphResource> resources;
    std::vector<GraphHeap> heaps;

    bool operator==(const PassGraph&) const = default;
};

/// The change of an image from no layout to GENERAL, with its first use.
struct Transition {
    uint32_t resource = 0;
    Access from;
    Access to;
};

/// A memory barrier for all resources, and the transitions at the same place.
struct PlannedBarrier {
    uint32_t before = 0;  ///< position in Plan::order of the pass that follows
    Access from;          ///< stages 0: only transitions
    Access to;
    std::vector<Transition> transitions;
};

/// When a resource is used: positions in Plan::order.
struct Lifetime {
    uint32_t first = UINT32_MAX;  ///< UINT32_MAX: never
    uint32_t last = 0;
};

struct Plan {
    static constexpr VkDeviceSize unplaced = ~VkDeviceSize(0);

    std::vector<uint32_t> order;   ///< the passes that are needed
    std::vector<uint32_t> levels;  ///< of these: passes of one level share no memory. By level: the most dependencies
                                   ///< in a row before each; as listed: one for each pass
    std::vector<PlannedBarrier> barriers;
    std::vector<Lifetime> lifetimes;    ///< of each resource
    std::vector<VkDeviceSize> offsets;  ///< of each resource in its heap; unplaced: not transient, or not needed
    std::vector<AccessState> after;     ///< of each resource
    std::vector<VkDeviceSize> ends;     ///< of each heap: the end of what is placed in it by this list
};

/// Throws std::logic_error for uses of resources that do not exist.
Plan compile(const PassGraph& graph);

}  // namespace reflet::gpu
