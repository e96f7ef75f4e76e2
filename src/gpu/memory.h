// Device memory: a block allocator. Small enough to be replaced by the Vulkan Memory Allocator behind this header.
#pragma once

#include "gpu/vulkan.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <mutex>
#include <utility>
#include <vector>

namespace reflet::gpu {

class Context;
struct MemoryBlock;

/// The next multiple of `alignment`.
constexpr VkDeviceSize alignUp(VkDeviceSize value, VkDeviceSize alignment) {
    return (value + alignment - 1) / alignment * alignment;
}

enum class MemoryUse : uint8_t {
    device,    ///< device-local, not accessed by the host
    upload,    ///< written by the host, coherent
    readback,  ///< read by the host, cached if possible
};

/// A range of device memory, copied by value; return it with Memory::release.
struct Allocation {
    MemoryBlock* block = nullptr;
    VkDeviceMemory memory = VK_NULL_HANDLE;
    VkDeviceSize offset = 0;
    VkDeviceSize size = 0;
    std::byte* mapped = nullptr;  ///< persistently mapped if host-visible
    MemoryUse use = MemoryUse::device;
    std::shared_ptr<VkDeviceSize> account;  ///< counter that the bytes are added to
};

/// Thread-safe.
class Memory {
public:
    /// Buffers have device addresses if the context has ray query.
    Memory(Context& context, const VkPhysicalDeviceMemoryProperties& properties);
    ~Memory();
    Memory(const Memory&) = delete;
    Memory& operator=(const Memory&) = delete;

    /// `linear`: for a buffer or a linear image. Throws Error if device memory is exhausted.
    /// image: optional, the image that the memory is for; a large one gets a dedicated allocation.
    Allocation allocate(const VkMemoryRequirements& needs, MemoryUse use, bool linear, VkImage image = VK_NULL_HANDLE);
    void release(const Allocation& allocation);

    /// Bytes in use by resources of this kind; retired resources count until they are destroyed.
    [[nodiscard]] VkDeviceSize used(MemoryUse use) const {
        const std::scoped_lock lock(mutex_);
        return used_[static_cast<size_t>(use)];
    }

    /// Counts the bytes of this thread's allocations from now on, until they are released; none: not counted.
    static void setAccount(std::shared_ptr<VkDeviceSize> account) { account_ = std::move(account); }
    /// Current bytes of an account.
    [[nodiscard]] VkDeviceSize read(const std::shared_ptr<VkDeviceSize>& account) const {
        const std::scoped_lock lock(mutex_);
        return *account;
    }

    /// Bytes of all blocks, as allocated from the device.
    [[nodiscard]] VkDeviceSize reserved() const {
        const std::scoped_lock lock(mutex_);
        return reserved_;
    }

private:
    struct Types {
        std::array<uint32_t, VK_MAX_MEMORY_TYPES> indices{};
        uint32_t count = 0;
    };

    /// Memory types that suit the use, best first. The others are used when a heap is full: 256 MiB of host-visible
    /// device memory on GPUs without resizable BAR, or VRAM that other programs use.
    Types typesFor(uint32_t allowed, MemoryUse use) const;
    // Both: null if the device has no memory of this type left.
    MemoryBlock* addBlock(uint32_t type, bool linear, VkDeviceSize size, VkImage image);
    /// A block with room for `size` bytes: of the usual size, or, for large resources or in nearly full heaps, of
    /// exactly that size.
    MemoryBlock* addBlockFor(VkDeviceSize size, uint32_t type, bool linear, VkImage image);

    [[noreturn]] void failFor(VkDeviceSize size, VkResult result) const;

    static thread_local std::shared_ptr<VkDeviceSize> account_;

    Context& context_;
    mutable std::mutex mutex_;  ///< guards all below
    VkPhysicalDeviceMemoryProperties properties_;
    std::vector<std::unique_ptr<MemoryBlock>> blocks_;
    VkDeviceSize reserved_ = 0;  ///< bytes allocated from the device
    std::array<VkDeviceSize, 3> used_{};
};

}  // namespace reflet::gpu
