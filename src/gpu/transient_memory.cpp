// Places what lives in one frame.
#include "gpu/transient_memory.h"

#include "base/error.h"
#include "gpu/context.h"

#include <algorithm>

namespace reflet::gpu {

namespace {

constexpr VkBufferUsageFlags bufferUsage = VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_INDIRECT_BUFFER_BIT |
                                           VK_BUFFER_USAGE_TRANSFER_SRC_BIT | VK_BUFFER_USAGE_TRANSFER_DST_BIT;

constexpr size_t mostNeeds = 1000;

VkBuffer makeBuffer(Context& context, VkDeviceSize size, VkBufferUsageFlags usage) {
    VkBufferCreateInfo create{VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO};
    create.size = size;
    create.usage = usage;
    ++context.counts().buffers;
    VkBuffer buffer = VK_NULL_HANDLE;
    vkCheck(context.vk.vkCreateBuffer(context.handle(), &create, nullptr, &buffer), "creating a buffer");
    return buffer;
}

}  // namespace

PlacedImage::~PlacedImage() {
    context.retire([&of = context, all = state] { destroyImage(of, all); });
}

PlacedBuffer::~PlacedBuffer() {
    context.retire([&of = context, buffer = state.buffer] { of.vk.vkDestroyBuffer(of.handle(), buffer, nullptr); });
}

TransientMemory::~TransientMemory() {
    release();
}

// Resources that may lie in the same kinds of memory share a heap.
uint32_t TransientMemory::heapOf(uint32_t memoryTypes, VkDeviceSize alignment) {
    for (uint32_t i = 0; i < requirements_.size(); ++i) {
        if (requirements_[i].memoryTypeBits == memoryTypes) {
            requirements_[i].alignment = std::max(requirements_[i].alignment, alignment);
            return i;
        }
    }
    requirements_.push_back({0, alignment, memoryTypes});
    heaps_.emplace_back();
    blocks_.emplace_back();
    return static_cast<uint32_t>(heaps_.size() - 1);
}

TransientMemory::Needs TransientMemory::needsOf(const ImageInfo& info) {
    const auto known = std::ranges::find(imageNeeds_, info, &std::pair<ImageInfo, Needs>::first);
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
    imageNeeds_.emplace_back(info, made);
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
    context_.vk.vkDestroyBuffer(context_.handle(), probe, nullptr);
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
        blocks_[heap].push_back({context_.memory().allocate(needs, MemoryUse::device, false), start, VK_NULL_HANDLE});
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

void TransientMemory::release() {
    for (size_t heap = 0; heap < blocks_.size(); ++heap) {
        for (Block& block : blocks_[heap]) {
            context_.retire([&context = context_, allocation = block.allocation, all = block.all] {
                if (all != VK_NULL_HANDLE) {
                    context.vk.vkDestroyBuffer(context.handle(), all, nullptr);
                }
                context.memory().release(allocation);
            });
        }
        blocks_[heap].clear();
        heaps_[heap].blocks.clear();
        heaps_[heap].taken.clear();
        heaps_[heap].before = {};
    }
    images_.clear();
    buffers_.clear();
}

VkDeviceSize TransientMemory::bytes() const {
    VkDeviceSize sum = 0;
    for (const GraphHeap& heap : heaps_) {
        for (const VkDeviceSize size : heap.blocks) {
            sum += size;
        }
    }
    return sum;
}

size_t TransientMemory::blockCount() const {
    size_t most = 0;
    for (const GraphHeap& heap : heaps_) {
        most = std::max(most, heap.blocks.size());
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
