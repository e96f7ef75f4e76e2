// Places what lives in one frame.
#include "gpu/transient_memory.h"

#include "base/error.h"
#include "gpu/context.h"

#include <algorithm>

namespace reflet::gpu {

namespace {

// Covers the alignment of most resources on most devices, so that they share memory.
constexpr VkDeviceSize leastHeapAlignment = 4096;

constexpr VkBufferUsageFlags bufferUsage = VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_INDIRECT_BUFFER_BIT |
                                           VK_BUFFER_USAGE_TRANSFER_SRC_BIT | VK_BUFFER_USAGE_TRANSFER_DST_BIT;

constexpr size_t mostNeeds = 4000;

// Images in the memory of a held one: sizes that frames come back to.
constexpr size_t mostSizes = 32;

VkBuffer makeBuffer(Context& context, VkDeviceSize size, VkBufferUsageFlags usage) {
    VkBufferCreateInfo create{VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO};
    create.size = size;
    create.usage = usage;
    context.share(create);
    ++context.counts().buffers;
    VkBuffer buffer = VK_NULL_HANDLE;
    vkCheck(context.vk.vkCreateBuffer(context.handle(), &create, context.allocator(), &buffer), "creating a buffer");
    return buffer;
}

}  // namespace

PlacedImage::~PlacedImage() {
    context.retire([&of = context, all = state] { destroyImage(of, all); });
}

HeldImage::~HeldImage() {
    for (const std::unique_ptr<Sized>& image : images) {
        context.retire([&of = context, all = image->state] { destroyImage(of, all); });
    }
    context.retire([&of = context, memory = allocation] { of.memory().release(memory); });
}

PlacedBuffer::~PlacedBuffer() {
    context.retire(
        [&of = context, buffer = state.buffer] { of.vk.vkDestroyBuffer(of.handle(), buffer, of.allocator()); });
}

TransientMemory::~TransientMemory() {
    release();
}

// Resources that may lie in the same kinds of memory share a heap. Its blocks begin and end at multiples of its
// alignment, which therefore never changes: only resources of very coarse alignment have heaps of their own.
uint32_t TransientMemory::heapOf(uint32_t memoryTypes, VkDeviceSize alignment) {
    alignment = std::max(alignment, leastHeapAlignment);
    for (uint32_t i = 0; i < requirements_.size(); ++i) {
        if (requirements_[i].memoryTypeBits == memoryTypes && requirements_[i].alignment == alignment) {
            return i;
        }
    }
    requirements_.push_back({0, alignment, memoryTypes});
    heaps_.emplace_back();
    blocks_.emplace_back();
    return static_cast<uint32_t>(heaps_.size() - 1);
}

TransientMemory::Needs TransientMemory::needsOf(const ImageInfo& info) {
    const auto known = imageNeeds_.find(info);
    if (known != imageNeeds_.end()) {
        return known->second;
    }
    ImageState probe;
    probe.image = makeImage(context_, info, "transient");
    VkMemoryRequirements needs{};
    context_.vk.vkGetImageMemoryRequirements(context_.handle(), probe.image, &needs);
    destroyImage(context_, probe);
    // Buffers and images lie side by side, in any order.
    const VkDeviceSize alignment = std::max(needs.alignment, context_.limits().bufferImageGranularity);
    const Needs made{heapOf(needs.memoryTypeBits, alignment), needs.size, alignment};
    if (imageNeeds_.size() == mostNeeds) {  // of a window that has had many sizes
        imageNeeds_.clear();
    }
    imageNeeds_.emplace(info, made);
    return made;
}

TransientMemory::Needs TransientMemory::needsOf(VkDeviceSize bufferSize) {
    const auto known = bufferNeeds_.find(bufferSize);
    if (known != bufferNeeds_.end()) {
        return known->second;
    }
    const VkBuffer probe = makeBuffer(context_, bufferSize, bufferUsage);
    VkMemoryRequirements needs{};
    context_.vk.vkGetBufferMemoryRequirements(context_.handle(), probe, &needs);
    context_.vk.vkDestroyBuffer(context_.handle(), probe, context_.allocator());
    const VkDeviceSize alignment = std::max(needs.alignment, context_.limits().bufferImageGranularity);
    const Needs made{heapOf(needs.memoryTypeBits, alignment), needs.size, alignment};
    if (bufferNeeds_.size() == mostNeeds) {
        bufferNeeds_.clear();
    }
    bufferNeeds_.emplace(bufferSize, made);
    return made;
}

void TransientMemory::reserve(const std::vector<VkDeviceSize>& ends) {
    for (size_t heap = 0; heap < ends.size(); ++heap) {
        VkDeviceSize start = 0;
        for (const VkDeviceSize size : heaps_[heap].blocks) {
            start += size;
        }
        if (ends[heap] <= start) {
            continue;
        }
        VkMemoryRequirements needs = requirements_[heap];
        needs.size = alignUp(ends[heap] - start, needs.alignment);
        blocks_[heap].reserve(blocks_[heap].size() + 1);
        heaps_[heap].blocks.reserve(heaps_[heap].blocks.size() + 1);
        blocks_[heap].push_back(
            {context_.memory().allocate(needs, MemoryUse::device, false), start, VK_NULL_HANDLE, false});
        heaps_[heap].blocks.push_back(needs.size);
    }
}

TransientMemory::Block& TransientMemory::blockOf(uint32_t heap, VkDeviceSize offset) {
    const auto behind = std::ranges::upper_bound(blocks_[heap], offset, {}, &Block::offset);
    REFLET_CHECK(behind != blocks_[heap].begin(), "no block at {}", offset);
    return *std::prev(behind);
}

std::shared_ptr<PlacedImage> TransientMemory::image(const ImageInfo& info, VkDeviceSize offset,
                                                    const std::string& name) {
    const std::pair<ImageInfo, VkDeviceSize> key(info, offset);
    std::erase_if(images_, [](const auto& entry) { return entry.second.expired(); });
    const auto known = std::ranges::find_if(images_, [&](const auto& entry) { return entry.first == key; });
    if (known != images_.end()) {
        return known->second.lock();
    }
    const Block& block = blockOf(needsOf(info).heap, offset);
    auto placed = std::make_shared<PlacedImage>(context_);
    ImageState& state = placed->state;
    state.image = makeImage(context_, info, name);
    state.id = nextResourceId();
    context_.nameImage(state.image, name);
    vkCheck(context_.vk.vkBindImageMemory(context_.handle(), state.image, block.allocation.memory,
                                          block.allocation.offset + offset - block.offset),
            "binding image memory");
    makeViews(context_, info, state);
    images_.emplace_back(key, placed);
    return placed;
}

std::shared_ptr<PlacedBuffer> TransientMemory::buffer(VkDeviceSize size, VkDeviceSize offset) {
    std::erase_if(buffers_, [](const auto& entry) { return entry.second.expired(); });
    std::weak_ptr<PlacedBuffer>& entry = buffers_[{size, offset}];
    if (std::shared_ptr<PlacedBuffer> known = entry.lock()) {
        return known;
    }
    const Block& block = blockOf(needsOf(size).heap, offset);
    auto placed = std::make_shared<PlacedBuffer>(context_);
    placed->state.buffer = makeBuffer(context_, size, bufferUsage);
    placed->state.id = nextResourceId();
    // As the specification demands once for every buffer, before its memory is bound.
    VkMemoryRequirements needs{};
    context_.vk.vkGetBufferMemoryRequirements(context_.handle(), placed->state.buffer, &needs);
    vkCheck(context_.vk.vkBindBufferMemory(context_.handle(), placed->state.buffer, block.allocation.memory,
                                           block.allocation.offset + offset - block.offset),
            "binding buffer memory");
    entry = placed;
    return placed;
}

std::shared_ptr<HeldImage> TransientMemory::hold(const ImageInfo& info, const std::string& name) {
    const Needs needs = needsOf(info);
    auto image = std::make_shared<HeldImage>(context_, name);
    VkMemoryRequirements requirements = requirements_[needs.heap];
    // Whole steps of the heap's alignment, as all of it is lent.
    requirements.size = alignUp(needs.size, requirements.alignment);
    image->allocation = context_.memory().allocate(requirements, MemoryUse::device, false);
    image->heap = needs.heap;
    image->size = requirements.size;
    image->current = &addSized(*image, info);
    addHeld({image, needs.heap, 0, 0}, *image);
    return image;
}

bool TransientMemory::show(HeldImage& held, const ImageInfo& info, uint64_t frame) {
    held.current->lastShown = frame;
    auto known = std::ranges::find_if(held.images, [&](const auto& image) { return image->info == info; });
    if (known == held.images.end()) {
        const Needs needs = needsOf(info);
        const VkMemoryRequirements& given = requirements_[held.heap];
        if (needs.size > held.size || requirements_[needs.heap].memoryTypeBits != given.memoryTypeBits ||
            needs.alignment > given.alignment) {
            return false;
        }
        if (held.images.size() >= mostSizes) {  // the longest unused one goes, but none of this and the last frame
            const auto oldest =
                std::ranges::min_element(held.images, {}, [](const auto& image) { return image->lastShown; });
            if ((*oldest)->lastShown + 1 < frame && oldest->get() != held.current) {
                context_.retire([&of = context_, all = (*oldest)->state] { destroyImage(of, all); });
                held.images.erase(oldest);
            }
        }
        addSized(held, info);
        known = std::prev(held.images.end());
    }
    held.current = known->get();
    held.current->lastShown = frame;
    return true;
}

HeldImage::Sized& TransientMemory::addSized(HeldImage& held, const ImageInfo& info) {
    held.images.reserve(held.images.size() + 1);
    auto sized = std::make_unique<HeldImage::Sized>();
    sized->info = info;
    ImageState& state = sized->state;
    state.image = makeImage(context_, info, held.name);
    try {
        VkMemoryRequirements needs{};
        context_.vk.vkGetImageMemoryRequirements(context_.handle(), state.image, &needs);
        state.bytes = needs.size;
        context_.nameImage(state.image, held.name);
        vkCheck(context_.vk.vkBindImageMemory(context_.handle(), state.image, held.allocation.memory,
                                              held.allocation.offset),
                "binding image memory");
        makeViews(context_, info, state);
    } catch (...) {
        destroyImage(context_, state);
        throw;
    }
    state.id = nextResourceId();
    state.name = held.name;
    state.aspect = aspectOf(info.format);
    state.held = &held;
    held.images.push_back(std::move(sized));
    return *held.images.back();
}

void TransientMemory::addHeld(HeldBlock block, HeldImage& image) {
    GraphHeap& heap = heaps_[block.heap];
    for (const VkDeviceSize size : heap.blocks) {
        block.offset += size;
    }
    block.size = image.size;
    heap.blocks.push_back(block.size);
    blocks_[block.heap].push_back({image.allocation, block.offset, VK_NULL_HANDLE, true});
    image.offset = block.offset;
    held_.push_back(block);
}

// Of a history, the image of the last frame is read until the list that writes this frame's; that one holds nothing
// before.
HeldUse TransientMemory::useOf(const HeldImage& image, uint64_t frame, bool otherIsListed) {
    const std::shared_ptr<HeldImage> other = image.other.lock();
    const auto written = [&](const HeldImage& next) { return next.usedFrame == frame + 1; };
    if (image.frame == frame) {
        if (image.isNext) {
            return written(image) || image.rescaledFrame == frame + 1 ? HeldUse::busy : HeldUse::fromFirst;
        }
        return other && (written(*other) || otherIsListed) ? HeldUse::untilLast : HeldUse::busy;
    }
    // Not asked for in this frame yet: what was written in the last one may still be.
    return image.isNext && image.frame + 1 == frame ? HeldUse::busy : HeldUse::fromFirst;
}

bool TransientMemory::isUntidy() const {
    return std::ranges::any_of(held_, [](const HeldBlock& block) { return block.image.expired(); });
}

void TransientMemory::release() {
    for (size_t heap = 0; heap < blocks_.size(); ++heap) {
        for (Block& block : blocks_[heap]) {
            context_.retire([&context = context_, held = block.held, allocation = block.allocation, all = block.all] {
                if (all != VK_NULL_HANDLE) {
                    context.vk.vkDestroyBuffer(context.handle(), all, context.allocator());
                }
                if (!held) {
                    context.memory().release(allocation);
                }
            });
        }
        blocks_[heap].clear();
        heaps_[heap].blocks.clear();
        heaps_[heap].taken.clear();
        heaps_[heap].before = {};
    }
    images_.clear();
    buffers_.clear();
    const std::vector<HeldBlock> before = std::move(held_);
    held_.clear();
    for (const HeldBlock& block : before) {
        if (const std::shared_ptr<HeldImage> image = block.image.lock()) {
            addHeld({image, block.heap, 0, 0}, *image);
        }
    }
}

VkDeviceSize TransientMemory::bytes() const {
    VkDeviceSize sum = 0;
    for (const std::vector<Block>& blocks : blocks_) {
        for (const Block& block : blocks) {
            sum += block.held ? 0 : block.allocation.size;
        }
    }
    return sum;
}

VkDeviceSize TransientMemory::heldBytes() const {
    VkDeviceSize sum = 0;
    for (const HeldBlock& block : held_) {
        sum += block.size;
    }
    return sum;
}

size_t TransientMemory::blockCount() const {
    size_t most = 0;
    for (const std::vector<Block>& blocks : blocks_) {
        most = std::max<size_t>(most, static_cast<size_t>(std::ranges::count(blocks, false, &Block::held)));
    }
    return most;
}

std::pair<VkBuffer, VkDeviceSize> TransientMemory::blockAt(uint32_t heap, VkDeviceSize offset) {
    Block& block = blockOf(heap, offset);
    if (block.all == VK_NULL_HANDLE) {
        const VkBuffer all = makeBuffer(context_, block.allocation.size, VK_BUFFER_USAGE_TRANSFER_DST_BIT);
        VkMemoryRequirements needs{};
        context_.vk.vkGetBufferMemoryRequirements(context_.handle(), all, &needs);
        vkCheck(
            context_.vk.vkBindBufferMemory(context_.handle(), all, block.allocation.memory, block.allocation.offset),
            "binding buffer memory");
        block.all = all;
    }
    return {block.all, offset - block.offset};
}

}  // namespace reflet::gpu
