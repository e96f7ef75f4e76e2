// Block allocator: first fit in blocks of 64 MiB; large resources get blocks of their own.
#include "gpu/memory.h"

#include "base/error.h"
#include "gpu/context.h"

#include <iterator>
#include <optional>
#include <span>

namespace reflet::gpu {

namespace {

constexpr VkDeviceSize blockSize = VkDeviceSize(64) << 20U;

}  // namespace

// Linear and optimal resources never share a block, so bufferImageGranularity does not matter.
struct MemoryBlock {
    uint32_t type = 0;
    bool linear = false;
    VkDeviceMemory memory = VK_NULL_HANDLE;
    VkDeviceSize size = 0;
    std::byte* mapped = nullptr;
    std::map<VkDeviceSize, VkDeviceSize> holes;  // offset → size

    std::optional<VkDeviceSize> take(VkDeviceSize bytes, VkDeviceSize alignment) {
        for (auto hole = holes.begin(); hole != holes.end(); ++hole) {
            const auto [start, length] = *hole;
            const VkDeviceSize offset = alignUp(start, alignment);
            if (offset + bytes > start + length) {
                continue;
            }
            holes.erase(hole);
            if (offset > start) {
                holes[start] = offset - start;
            }
            if (start + length > offset + bytes) {
                holes[offset + bytes] = start + length - offset - bytes;
            }
            return offset;
        }
        return std::nullopt;
    }

    void giveBack(VkDeviceSize offset, VkDeviceSize bytes) {
        auto hole = holes.emplace(offset, bytes).first;
        if (auto next = std::next(hole); next != holes.end() && hole->first + hole->second == next->first) {
            hole->second += next->second;
            holes.erase(next);
        }
        if (hole != holes.begin()) {
            if (auto previous = std::prev(hole); previous->first + previous->second == hole->first) {
                previous->second += hole->second;
                holes.erase(hole);
            }
        }
    }
};

thread_local std::shared_ptr<VkDeviceSize> Memory::account_;

Memory::Memory(Context& context, const VkPhysicalDeviceMemoryProperties& properties)
    : context_(context), properties_(properties) {}

Memory::~Memory() {
    for (const auto& block : blocks_) {
        context_.freeMemory(block->memory);
    }
}

namespace {

// These need features that are not enabled, or have no memory of their own.
constexpr VkMemoryPropertyFlags unusable = VK_MEMORY_PROPERTY_PROTECTED_BIT | VK_MEMORY_PROPERTY_LAZILY_ALLOCATED_BIT |
                                           VK_MEMORY_PROPERTY_DEVICE_COHERENT_BIT_AMD;

bool has(VkMemoryPropertyFlags flags, VkMemoryPropertyFlags wish) {
    return (flags & wish) == wish && (flags & unusable) == 0;
}

}  // namespace

Memory::Types Memory::typesFor(uint32_t allowed, MemoryUse use) const {
    constexpr VkMemoryPropertyFlags local = VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT;
    constexpr VkMemoryPropertyFlags host = VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT;
    constexpr VkMemoryPropertyFlags cached = VK_MEMORY_PROPERTY_HOST_CACHED_BIT;
    VkMemoryPropertyFlags wanted = local;
    VkMemoryPropertyFlags needed = 0;
    if (use != MemoryUse::device) {
        wanted = host | (use == MemoryUse::upload ? local : cached);
        needed = host;
    }
    Types types;
    for (const bool best : {true, false}) {
        for (uint32_t i = 0; i < properties_.memoryTypeCount; ++i) {
            const VkMemoryPropertyFlags flags = properties_.memoryTypes[i].propertyFlags;
            if (((allowed >> i) & 1U) != 0 && has(flags, needed) && has(flags, wanted) == best) {
                types.indices.at(types.count++) = i;
            }
        }
    }
    if (types.count == 0) {
        fail("the device has no memory type for this use");
    }
    return types;
}

MemoryBlock* Memory::addBlock(uint32_t type, bool linear, VkDeviceSize size, VkImage image) {
    auto block = std::make_unique<MemoryBlock>();
    block->holes[0] = size;
    blocks_.reserve(blocks_.size() + 1);
    VkMemoryAllocateFlagsInfo flags{VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_FLAGS_INFO};
    flags.flags = context_.hasRayQuery() && linear ? VK_MEMORY_ALLOCATE_DEVICE_ADDRESS_BIT : 0;
    const VkMemoryDedicatedAllocateInfo dedicated{VK_STRUCTURE_TYPE_MEMORY_DEDICATED_ALLOCATE_INFO, &flags, image,
                                                  VK_NULL_HANDLE};
    const void* next = image != VK_NULL_HANDLE ? static_cast<const void*>(&dedicated) : &flags;
    const VkMemoryAllocateInfo info{VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO, next, size, type};
    const VkResult result = context_.allocateMemory(info, &block->memory);
    if (result == VK_ERROR_OUT_OF_DEVICE_MEMORY) {
        return nullptr;
    }
    if (result != VK_SUCCESS) {
        failFor(size, result);
    }
    block->type = type;
    block->linear = linear;
    block->size = size;
    if ((properties_.memoryTypes[type].propertyFlags & VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT) != 0) {
        void* mapped = nullptr;
        const VkResult mapping =
            context_.vk.vkMapMemory(context_.handle(), block->memory, 0, VK_WHOLE_SIZE, 0, &mapped);
        if (mapping < 0) {
            context_.freeMemory(block->memory);
            vkCheck(mapping, "mapping device memory");
        }
        block->mapped = static_cast<std::byte*>(mapped);
    }
    reserved_ += size;
    ++context_.counts().memoryBlocks;
    return blocks_.emplace_back(std::move(block)).get();
}

void Memory::failFor(VkDeviceSize size, VkResult result) const {
    throw OutOfMemory(
        fmt::format("out of device memory: {} MiB needed in addition to {} MiB in use ({}); render at a smaller size",
                    size >> 20U, reserved_ >> 20U, resultName(result)));
}

MemoryBlock* Memory::addBlockFor(VkDeviceSize size, uint32_t type, bool linear, VkImage image) {
    if (size > blockSize / 2) {
        return addBlock(type, linear, size, image);
    }
    MemoryBlock* block = addBlock(type, linear, blockSize, VK_NULL_HANDLE);
    return block != nullptr ? block : addBlock(type, linear, size, VK_NULL_HANDLE);
}

Allocation Memory::allocate(const VkMemoryRequirements& needs, MemoryUse use, bool linear, VkImage image) {
    const Types types = typesFor(needs.memoryTypeBits, use);
    const std::scoped_lock lock(mutex_);
    const auto placed = [&](MemoryBlock& block, VkDeviceSize offset) {
        std::byte* mapped = block.mapped != nullptr ? block.mapped + offset : nullptr;
        used_[static_cast<size_t>(use)] += needs.size;
        if (account_) {
            *account_ += needs.size;
        }
        return Allocation{&block, block.memory, offset, needs.size, mapped, use, account_};
    };
    for (const uint32_t type : std::span(types.indices).first(types.count)) {
        for (const auto& block : blocks_) {
            if (block->type == type && block->linear == linear) {
                if (const auto offset = block->take(needs.size, needs.alignment)) {
                    return placed(*block, *offset);
                }
            }
        }
        if (MemoryBlock* block = addBlockFor(needs.size, type, linear, image)) {
            return placed(*block, block->take(needs.size, needs.alignment).value());
        }
    }
    failFor(needs.size, VK_ERROR_OUT_OF_DEVICE_MEMORY);
}

void Memory::release(const Allocation& allocation) {
    if (allocation.block == nullptr) {
        return;
    }
    const std::scoped_lock lock(mutex_);
    MemoryBlock& block = *allocation.block;
    used_[static_cast<size_t>(allocation.use)] -= allocation.size;
    if (allocation.account) {
        *allocation.account -= allocation.size;
    }
    block.giveBack(allocation.offset, allocation.size);
    if (block.holes.size() == 1 && block.holes.begin()->second == block.size) {
        context_.freeMemory(block.memory);
        reserved_ -= block.size;
        std::erase_if(blocks_, [&](const auto& b) { return b.get() == &block; });
    }
}

}  // namespace reflet::gpu
