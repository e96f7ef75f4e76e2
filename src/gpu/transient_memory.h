// Transient memory: blocks in which a plan places the images and buffers of one frame, and these resources themselves,
// which are bound to a place once and reused in every frame with the same plan.
#pragma once

#include "gpu/memory.h"
#include "gpu/plan.h"
#include "gpu/resource.h"

#include <cstdint>
#include <map>
#include <memory>
#include <unordered_map>
#include <utility>
#include <vector>

namespace reflet::gpu {

class Context;

/// An image bound to its place in memory. Destroyed once the device has finished with it.
struct PlacedImage {
    Context& context;
    ImageState state;

    explicit PlacedImage(Context& of) : context(of) {}
    ~PlacedImage();
    PlacedImage(const PlacedImage&) = delete;
    PlacedImage& operator=(const PlacedImage&) = delete;
};

/// One of the two images of a history. It keeps its contents from one frame to the next, in memory that is aliased
/// while they are not needed. Images of several sizes may lie in that memory, one of which has the contents.
struct HeldImage {
    /// An image at the start of the memory.
    struct Sized {
        ImageInfo info;
        ImageState state;
        uint64_t lastShown = 0;  ///< frame number
    };

    Context& context;
    std::string name;
    std::vector<std::unique_ptr<Sized>> images;  ///< one per size; few
    Sized* current = nullptr;                    ///< the one in `images` that frames use now
    uint64_t occupant = 0;                       ///< ImageState::id of the last one used as the current one
    Allocation allocation;
    uint32_t heap = 0;
    VkDeviceSize offset = 0;  ///< in the heap
    VkDeviceSize size = 0;
    // Its current role in the history.
    uint64_t frame = 0;          ///< number of the frame for which isNext is valid
    bool isNext = false;         ///< it is written in this frame; otherwise it was in the last one
    uint64_t usedFrame = 0;      ///< last frame in which an earlier list used it, plus 1
    uint64_t recordedFrame = 0;  ///< last frame in which a list that uses it was recorded, plus 1
    uint64_t rescaledFrame = 0;  ///< last frame in which it was written as the next one after its content of another
                                 ///< size had been resampled, plus 1

    std::weak_ptr<HeldImage> other;  ///< the other image of the same history

    HeldImage(Context& of, std::string called) : context(of), name(std::move(called)) {}
    ~HeldImage();
    HeldImage(const HeldImage&) = delete;
    HeldImage& operator=(const HeldImage&) = delete;
};

struct PlacedBuffer {
    Context& context;
    BufferState state;

    explicit PlacedBuffer(Context& of) : context(of) {}
    ~PlacedBuffer();
    PlacedBuffer(const PlacedBuffer&) = delete;
    PlacedBuffer& operator=(const PlacedBuffer&) = delete;
};

class TransientMemory {
public:
    explicit TransientMemory(Context& context) : context_(context) {}
    ~TransientMemory();
    TransientMemory(const TransientMemory&) = delete;
    TransientMemory& operator=(const TransientMemory&) = delete;

    struct Needs {
        uint32_t heap = 0;  ///< index of heaps()
        VkDeviceSize size = 0;
        VkDeviceSize alignment = 1;
    };
    /// Memory requirements of an image or buffer.
    Needs needsOf(const ImageInfo& info);
    Needs needsOf(VkDeviceSize bufferSize);

    /// The heaps as a plan sees them.
    [[nodiscard]] std::vector<GraphHeap>& heaps() { return heaps_; }

    /// Allocates memory up to the end of a plan's placements in each heap.
    void reserve(const std::vector<VkDeviceSize>& ends);
    /// The image with this info at this offset; reuses one that is alive.
    std::shared_ptr<PlacedImage> image(const ImageInfo& info, VkDeviceSize offset, const std::string& name);
    std::shared_ptr<PlacedBuffer> buffer(VkDeviceSize size, VkDeviceSize offset);

    /// Creates an image that is held until its owner releases it.
    std::shared_ptr<HeldImage> hold(const ImageInfo& info, const std::string& name);
    /// Makes an image with this info the current one of `held`. Returns false, and does nothing, if its memory does not
    /// fit.
    bool show(HeldImage& held, const ImageInfo& info, uint64_t frame);
    /// Adds to `heaps` when held memory is free in the current list. resourceOf: resource index of an image state, or
    /// HeldRange::unused.
    template <class F>
    void describeHeld(std::vector<GraphHeap>& heaps, uint64_t frame, const F& resourceOf) const {
        for (const HeldBlock& block : held_) {
            const std::shared_ptr<HeldImage> image = block.image.lock();
            HeldRange range{{block.offset, block.size}, HeldUse::busy, HeldRange::unused};
            if (image) {
                const std::shared_ptr<HeldImage> other = image->other.lock();
                range.use = useOf(*image, frame, other && resourceOf(other->current->state) != HeldRange::unused);
                range.resource = resourceOf(image->current->state);
            }
            heaps[block.heap].held.push_back(range);
        }
    }
    /// Whether a held image is gone, which leaves a gap: release() lays out the remaining ones without it.
    [[nodiscard]] bool isUntidy() const;

    /// Frees all blocks that are not held, so that one block of the right size replaces them; placed resources must not
    /// be used again.
    void release();
    [[nodiscard]] VkDeviceSize bytes() const;      ///< bytes without held images
    [[nodiscard]] VkDeviceSize heldBytes() const;  ///< bytes of held images
    [[nodiscard]] size_t blockCount() const;
    /// For tests: a buffer over a whole block, to fill memory that is free. offset: in the heap; returns the offset in
    /// the block.
    std::pair<VkBuffer, VkDeviceSize> blockAt(uint32_t heap, VkDeviceSize offset);

private:
    struct Block {
        Allocation allocation;
        VkDeviceSize offset = 0;  ///< in the heap
        VkBuffer all = VK_NULL_HANDLE;
        bool held = false;  ///< its memory belongs to a HeldImage
    };
    // Range of a held image in its heap's space of offsets.
    struct HeldBlock {
        std::weak_ptr<HeldImage> image;
        uint32_t heap = 0;
        VkDeviceSize offset = 0;
        VkDeviceSize size = 0;
    };
    struct InfoHash {
        size_t operator()(const ImageInfo& info) const {
            return (info.size.x + 16411U * size_t(info.size.y)) * 31 + static_cast<size_t>(info.format) * 131071 +
                   size_t(info.mips) * 7 + size_t(info.layers) * 13;
        }
    };
    static HeldUse useOf(const HeldImage& image, uint64_t frame, bool otherIsListed);
    void addHeld(HeldBlock block, HeldImage& image);
    HeldImage::Sized& addSized(HeldImage& held, const ImageInfo& info);
    uint32_t heapOf(uint32_t memoryTypes, VkDeviceSize alignment);
    Block& blockOf(uint32_t heap, VkDeviceSize offset);

    Context& context_;
    std::vector<GraphHeap> heaps_;
    std::vector<VkMemoryRequirements> requirements_;  ///< of each heap: its memory types and alignment
    std::vector<std::vector<Block>> blocks_;          ///< of each heap
    std::vector<HeldBlock> held_;
    std::unordered_map<ImageInfo, Needs, InfoHash> imageNeeds_;
    std::map<VkDeviceSize, Needs> bufferNeeds_;
    std::vector<std::pair<std::pair<ImageInfo, VkDeviceSize>, std::weak_ptr<PlacedImage>>> images_;
    std::map<std::pair<VkDeviceSize, VkDeviceSize>, std::weak_ptr<PlacedBuffer>> buffers_;
};

}  // namespace reflet::gpu
