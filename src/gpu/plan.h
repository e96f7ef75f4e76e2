// Compiles a frame graph before it is recorded, as a function of plain values: culls unused passes, orders the others,
// aliases memory, and places barriers. Independent of any device.
//
// Frame graph with transient resources placed afterwards: Y. O'Donnell, FrameGraph (GDC 2017). Barriers: each hazard is
// an interval of positions, one of which needs a barrier; placing each barrier as late as the first open hazard allows
// needs the fewest (greedy interval stabbing).
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

/// Both accesses by one pass.
Access merged(const Access& a, const Access& b);

struct ResourceUse {
    uint32_t resource = 0;  ///< index of PassGraph::resources; at most once in a pass
    Access access;

    bool operator==(const ResourceUse&) const = default;
};

struct GraphPass {
    uint32_t firstUse = 0;  ///< in PassGraph::uses
    uint32_t useCount = 0;
    bool root = false;  ///< never culled, even if no pass reads its output: read-backs

    bool operator==(const GraphPass&) const = default;
};

/// When the memory of a resource that is kept from frame to frame is free for transient resources.
enum class HeldUse : uint8_t {
    busy,       ///< never
    untilLast,  ///< after its last use in the list: no one reads it again
    fromFirst,  ///< before its first use, which overwrites it
};

struct GraphResource {
    bool transient = false;   ///< it has no contents from before the list, and no memory yet
    bool output = false;      ///< transient: its contents are read after the list
    bool image = false;       ///< has a layout
    bool undefined = false;   ///< not transient: an image in the undefined layout, or whose memory others have used
    bool held = false;        ///< not transient: it lies in a heap, at one of GraphHeap::held
    uint32_t heap = 0;        ///< transient or held: index of PassGraph::heaps
    VkDeviceSize offset = 0;  ///< held: in the heap
    VkDeviceSize size = 0;    ///< transient or held
    VkDeviceSize alignment = 1;
    AccessState before;  ///< not transient: the state that its first use must wait for

    bool operator==(const GraphResource&) const = default;
};

struct MemoryRange {
    VkDeviceSize offset = 0;
    VkDeviceSize size = 0;

    bool operator==(const MemoryRange&) const = default;
};

/// Memory of a resource that is kept from frame to frame, but that others may use in part of the list.
struct HeldRange {
    static constexpr uint32_t unused = UINT32_MAX;

    MemoryRange range;
    HeldUse use = HeldUse::busy;
    uint32_t resource = unused;  ///< index of PassGraph::resources; unused: the list does not use it. Then the memory
                                 ///< is free unless busy; with fromFirst not for outputs, as a later list writes it

    bool operator==(const HeldRange&) const = default;
};

/// Memory that transient resources are placed in: consecutive blocks in one space of offsets. No resource crosses a
/// block boundary. After the last block there is unlimited space, for a block still to be allocated.
struct GraphHeap {
    std::vector<VkDeviceSize> blocks;  ///< sizes of the blocks
    std::vector<MemoryRange> taken;    ///< occupied by outputs of earlier lists of the frame
    std::vector<HeldRange> held;
    Access before;  ///< access by earlier users of this memory; write: it has writes

    bool operator==(const GraphHeap&) const = default;
};

enum class PassOrder : uint8_t {
    byLevel,   ///< groups independent passes: fewest barriers. For GPUs
    asListed,  ///< keeps a pass's inputs in the cache. For CPUs, where barriers cost nothing
};

struct PassGraph {
    PassOrder order = PassOrder::byLevel;
    std::vector<GraphPass> passes;
    std::vector<ResourceUse> uses;
    std::vector<GraphResource> resources;
    std::vector<GraphHeap> heaps;

    bool operator==(const PassGraph&) const = default;
};

/// Layout transition of an image from UNDEFINED to GENERAL, at its first use.
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

    std::vector<uint32_t> order;   ///< the passes that are not culled
    std::vector<uint32_t> levels;  ///< level of each pass in `order`: passes of one level share no memory. byLevel:
                                   ///< length of the longest dependency chain before it; asListed: one for each pass
    std::vector<PlannedBarrier> barriers;
    std::vector<Lifetime> lifetimes;    ///< of each resource
    std::vector<VkDeviceSize> offsets;  ///< of each resource in its heap; unplaced: not transient, or not used
    std::vector<AccessState> after;     ///< state of each resource after the list
    std::vector<VkDeviceSize> ends;     ///< for each heap: the end of the placements by this list
};

/// Throws std::logic_error for uses of resources that do not exist.
Plan compile(const PassGraph& graph);

}  // namespace reflet::gpu
