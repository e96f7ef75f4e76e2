// Records the passes of a frame into a given command buffer: plans the list (gpu/plan.h), allocates transient
// resources, binds descriptors, sets barriers, and times every pass on the device. It never submits or waits.
#pragma once

#include "gpu/descriptor_sets.h"
#include "gpu/listing.h"
#include "gpu/pass_list.h"
#include "gpu/pass_times.h"
#include "gpu/transient_memory.h"

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

namespace reflet::gpu {

/// Cost of recording a frame.
struct RecordingCounts {
    double ms = 0.0;      ///< host time from begin() to end(), including the code that lists the passes
    uint32_t passes = 0;  ///< recorded passes, including copies and clears
    uint32_t barriers = 0;
    uint32_t plans = 0;  ///< lists without a cached plan
};

class Recorder : public PassList {
public:
    static constexpr uint32_t maxFramesInFlight = 4;

    /// framesInFlight: 1 to maxFramesInFlight. timesPasses: measures device times, for passTimes().
    explicit Recorder(Context& context, uint32_t framesInFlight = 1, bool timesPasses = true);
    /// The device must have finished all frames.
    ~Recorder();
    Recorder(const Recorder&) = delete;
    Recorder& operator=(const Recorder&) = delete;

    /// Starts a frame: everything up to end() is recorded into `commands`, outside of render passes. The device must
    /// have finished the frame that was begun `framesInFlight` frames before; its times and read-backs are available
    /// from now on. Frames must be submitted in the order in which they begin. If an exception keeps a frame from
    /// ending, it is abandoned: its commands must not be submitted.
    void begin(VkCommandBuffer commands);
    /// Redirects later flushes into this command buffer. The device must execute the command buffers in this order, and
    /// each must see the writes of the earlier ones: by barriers on one queue, by a semaphore between two.
    void recordInto(VkCommandBuffer commands) { commands_ = commands; }
    /// Plans and records the passes listed so far, for callers that record commands of their own before the next ones.
    /// Transient resources that are used later must be kept (PassList::keep).
    void flush();
    /// Discards the passes that were listed since the last flush.
    void drop() { nextList(false); }
    /// Records the remaining passes and ends the frame. The caller may continue to record into the command buffer:
    /// bound pipelines and descriptor sets are undefined.
    void end();
    /// The device has finished all frames begun so far: frees resources that only they used; times and read-backs of
    /// the last one are available.
    void finish();
    /// As finish(), but without times and read-backs. Also for a lost device.
    void abandon() noexcept;

    /// Use instead of begin(), until end(): lists are planned but not recorded. Images, buffers and memory are created
    /// as in a frame; pipelines that the passes need and the context lacks are added to `missing`.
    void prepare(std::vector<PipelineInfo>& missing);
    /// Defragments memory from the next frame on: for callers that have flushed several lists, the first of which was
    /// planned without the histories of the later ones.
    void tidy() { tidies_ = true; }

    /// Read-back data of the last frame that the device has finished: rows from the top, tightly packed.
    [[nodiscard]] std::span<const std::byte> bytes(Readback readback) const;

    /// Pass times of the last frame that the device has finished, in recording order. The first entry, "frame", is from
    /// start to end.
    [[nodiscard]] const std::vector<PassTime>& passTimes() const { return times_; }
    /// Counts of the last frame that was ended.
    [[nodiscard]] const RecordingCounts& counts() const { return counted_; }
    /// Bytes of the memory that transient images and buffers share.
    [[nodiscard]] VkDeviceSize transientBytes() const { return memory().bytes(); }

    /// Enables listing() from the next frame on.
    void listPasses() { lists_ = true; }
    /// Passes of the last frame that was ended.
    [[nodiscard]] const PassListing& listing() const { return listing_; }

    /// Sets the pass order from the next list on; by default the one that suits the device.
    void orderPasses(PassOrder order) { graph_.order = order; }

    /// For tests: fills transient resources with NaN before their first and after their last use. Slow.
    void poisonTransients(bool poisons) { poisons_ = poisons; }

protected:
    /// Called after each recorded pass; the command buffer must be in the recording state when it returns. If it
    /// throws, the frame is abandoned as after any exception. Empty: nothing is called.
    void betweenPasses(std::function<void()> call) { betweenPasses_ = std::move(call); }

private:
    struct WithoutSlots {};
    Recorder(Context& context, bool timesPasses, WithoutSlots /*tag*/);

    // A block of uniform memory, and its identity for descriptor caching.
    struct UniformBlock {
        Buffer buffer;
        uint64_t id = 0;
    };
    struct UniformSlice {
        const UniformBlock* block = nullptr;
        VkDeviceSize offset = 0;
    };
    // Resources of one frame in flight.
    struct Slot {
        uint64_t serial = 0;                 ///< serial number of its work; 0: no unfinished work
        std::vector<UniformBlock> uniforms;  ///< filled in turn
        size_t uniformBlock = 0;             ///< index of the block being filled
        VkDeviceSize uniformsUsed = 0;       ///< bytes used in that block
        PassTimers::Frame timed;
        std::vector<Buffer> readbacks;
    };
    // A planned list, with the resources placed for it.
    struct CachedPlan {
        PassGraph graph;
        std::vector<ImageInfo> infos;  ///< of each resource; none for buffers
        Plan plan;
        std::vector<std::shared_ptr<PlacedImage>> images;    ///< of each resource, or none
        std::vector<std::shared_ptr<PlacedBuffer>> buffers;  ///< of each resource, or none
        uint64_t lastUse = 0;                                ///< frame number
    };
    // A resource of the current list.
    struct Listed {
        Image image;
        BufferView buffer;
    };

    void start();
    void finish(Slot& slot);
    [[nodiscard]] Slot& slot() { return slots_[number_ % slots_.size()]; }
    uint32_t listed(const Image& view);
    uint32_t listed(const BufferView& view);
    void makeGraph();
    CachedPlan& planned();
    void place(CachedPlan& cached);
    void applyPlaces(const CachedPlan& cached);
    void makePipelines(const Plan& plan);
    void record(const CachedPlan& cached);
    void recordBarrier(const PlannedBarrier& barrier);
    void recordPass(PassRecord& pass);
    void recordTransfer(const PassRecord& pass);
    void bindPass(PassRecord& pass, VkPipelineBindPoint point);
    void recordDraw(PassRecord& pass);
    void recordReadback(const PassRecord& pass);
    void noteAfter(const CachedPlan& cached);
    void addToListing(const CachedPlan& cached);
    void noteFailure(const CachedPlan& cached);
    void noteLayouts(const CachedPlan& cached);
    void poison(const CachedPlan& cached, uint32_t position, bool before);
    void dropUnused();
    void dropPlans();
    UniformBlock makeUniforms();
    UniformSlice uploadUniforms(const PassRecord& pass);

    std::function<void()> betweenPasses_;
    std::vector<Slot> slots_;
    DescriptorSets sets_;
    PassTimers timers_;
    VkCommandBuffer commands_ = VK_NULL_HANDLE;  ///< null between frames
    std::vector<PipelineInfo>* missing_ = nullptr;
    uint64_t preparation_ = 0;  ///< serial number of the work of prepare()
    size_t finished_ = 0;       ///< slot of the last frame that the device has finished
    bool poisons_ = false;
    bool lists_ = false;
    PassListing listing_;
    uint32_t listsOfFrame_ = 0;
    bool tidies_ = false;       ///< memory is in several blocks, or too large, and one list makes a frame
    uint32_t roomyFrames_ = 0;  ///< number of consecutive frames that used less than half of the memory
    RecordingCounts counting_;
    RecordingCounts counted_;
    std::chrono::steady_clock::time_point began_;
    std::vector<PassTime> times_;
    // The current list.
    PassGraph graph_;
    std::vector<ImageInfo> infos_;
    std::vector<Listed> resources_;
    std::unordered_multimap<uint64_t, std::unique_ptr<CachedPlan>> plans_;  ///< by hash of graph and infos
    // Scratch, so that a steady frame allocates no memory.
    std::vector<VkImageMemoryBarrier2> imageBarriers_;
    std::vector<uint32_t> dynamicOffsets_;
    std::vector<VkRenderingAttachmentInfo> attachments_;
};

}  // namespace reflet::gpu
