// Memory, images and buffers of the driver without a device.
#include "stub/functions.h"
#include "stub/objects.h"

#include <sys/mman.h>

#include <map>
#include <mutex>

namespace reflet::stub {

uint64_t memorySize();

namespace {

constexpr uint64_t alignment = 1024;

// Of what the host may write. Kept for the next memory of the same size: mapping takes longer than all else.
class Mappings {
public:
    void* take(uint64_t bytes) {
        {
            const std::scoped_lock lock(mutex_);
            if (const auto found = free_.find(bytes); found != free_.end()) {
                void* const address = found->second;
                free_.erase(found);
                return address;
            }
        }
        void* const address =
            ::mmap(nullptr, bytes, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
        return address != MAP_FAILED ? address : nullptr;
    }
    void giveBack(void* address, uint64_t bytes) {
        const std::scoped_lock lock(mutex_);
        free_.emplace(bytes, address);
    }

private:
    std::mutex mutex_;
    std::multimap<uint64_t, void*> free_;
};

Mappings& mappings() {
    static auto* one = new Mappings;
    return *one;
}

std::atomic<uint64_t> allocated = 0;

uint64_t texelBytes(VkFormat format) {
    switch (format) {
        case VK_FORMAT_R8_UNORM:
            return 1;
        case VK_FORMAT_R16G16B16A16_SFLOAT:
        case VK_FORMAT_R32G32_UINT:
        case VK_FORMAT_R32G32_SFLOAT:
            return 8;
        case VK_FORMAT_R32G32B32A32_UINT:
        case VK_FORMAT_R32G32B32A32_SFLOAT:
            return 16;
        default:
            return 4;
    }
}

VKAPI_ATTR VkResult VKAPI_CALL allocate(VkDevice /*device*/, const VkMemoryAllocateInfo* info,
                                        const VkAllocationCallbacks* /*host*/, VkDeviceMemory* handle) {
    if ((allocated += info->allocationSize) > memorySize()) {
        allocated -= info->allocationSize;
        *handle = VK_NULL_HANDLE;
        return VK_ERROR_OUT_OF_DEVICE_MEMORY;
    }
    const VkResult result = make<Memory>(handle);
    if (result != VK_SUCCESS) {
        allocated -= info->allocationSize;
        return result;
    }
    auto& memory = known<Memory>(*handle, Kind::memory, "vkAllocateMemory");
    memory.bytes = info->allocationSize;
    memory.type = info->memoryTypeIndex;
    return result;
}

VKAPI_ATTR void VKAPI_CALL release(VkDevice /*device*/, VkDeviceMemory handle, const VkAllocationCallbacks* /*host*/) {
    if (handle != VK_NULL_HANDLE) {
        auto& memory = known<Memory>(handle, Kind::memory, "vkFreeMemory");
        if (memory.mapped != nullptr) {
            mappings().giveBack(memory.mapped, memory.bytes);
        }
        allocated -= memory.bytes;
        drop(memory);
    }
}

VKAPI_ATTR VkResult VKAPI_CALL map(VkDevice /*device*/, VkDeviceMemory handle, VkDeviceSize /*offset*/,
                                   VkDeviceSize /*size*/, VkMemoryMapFlags /*flags*/, void** address) {
    auto& memory = known<Memory>(handle, Kind::memory, "vkMapMemory");
    if (memory.type != 1 || memory.mapped != nullptr) {
        misuse("memory that the host cannot see, or that is mapped", "vkMapMemory");
    }
    if (const VkResult result = beginMaking(); result != VK_SUCCESS) {
        return result;
    }
    memory.mapped = mappings().take(memory.bytes);
    *address = memory.mapped;
    return memory.mapped != nullptr ? VK_SUCCESS : VK_ERROR_MEMORY_MAP_FAILED;
}

VKAPI_ATTR VkResult VKAPI_CALL createImage(VkDevice /*device*/, const VkImageCreateInfo* info,
                                           const VkAllocationCallbacks* /*host*/, VkImage* image) {
    return make<Image>(image, *info);
}

VKAPI_ATTR void VKAPI_CALL imageNeeds(VkDevice /*device*/, VkImage handle, VkMemoryRequirements* needs) {
    *needs = {known<Image>(handle, Kind::image, "vkGetImageMemoryRequirements").bytes, alignment, 3};
}

void checkRange(const Memory& memory, VkDeviceSize offset, uint64_t bytes, const char* call) {
    if (offset % alignment != 0 || offset > memory.bytes || bytes > memory.bytes - offset) {
        misuse("a range that is not in the memory", call);
    }
}

template <class T, Kind K, class Handle>
VKAPI_ATTR VkResult VKAPI_CALL bindMemory(VkDevice /*device*/, Handle handle, VkDeviceMemory memory,
                                          VkDeviceSize offset) {
    auto& object = known<T>(handle, K, "vkBindMemory");
    checkRange(known<Memory>(memory, Kind::memory, "vkBindMemory"), offset, object.bytes, "vkBindMemory");
    if (object.bound) {
        misuse("an object that has memory", "vkBindMemory");
    }
    const VkResult result = beginMaking();
    object.bound = result == VK_SUCCESS;
    return result;
}

VKAPI_ATTR VkResult VKAPI_CALL createView(VkDevice /*device*/, const VkImageViewCreateInfo* info,
                                          const VkAllocationCallbacks* /*host*/, VkImageView* handle) {
    auto& image = known<Image>(info->image, Kind::image, "vkCreateImageView");
    const VkImageSubresourceRange& range = info->subresourceRange;
    if (!image.bound || range.baseMipLevel + range.levelCount > image.mips ||
        range.baseArrayLayer + range.layerCount > image.layers) {
        misuse("an image without memory, or a range that it has not", "vkCreateImageView");
    }
    const VkResult result = make<ImageView>(handle);
    if (result == VK_SUCCESS) {
        known<ImageView>(*handle, Kind::imageView, "vkCreateImageView").image = &image;
    }
    return result;
}

VKAPI_ATTR VkResult VKAPI_CALL createBuffer(VkDevice /*device*/, const VkBufferCreateInfo* info,
                                            const VkAllocationCallbacks* /*host*/, VkBuffer* handle) {
    const VkResult result = make<Buffer>(handle);
    if (result == VK_SUCCESS) {
        known<Buffer>(*handle, Kind::buffer, "vkCreateBuffer").bytes = info->size;
    }
    return result;
}

VKAPI_ATTR void VKAPI_CALL bufferNeeds(VkDevice /*device*/, VkBuffer handle, VkMemoryRequirements* needs) {
    const uint64_t bytes = known<Buffer>(handle, Kind::buffer, "vkGetBufferMemoryRequirements").bytes;
    *needs = {(bytes + alignment - 1) / alignment * alignment, alignment, 3};
}

}  // namespace

Image::Image(const VkImageCreateInfo& info) : Object(Kind::image), mips(info.mipLevels), layers(info.arrayLayers) {
    uint64_t texels = 0;
    for (uint32_t level = 0; level < mips; ++level) {
        texels +=
            std::max<uint64_t>(info.extent.width >> level, 1) * std::max<uint64_t>(info.extent.height >> level, 1);
    }
    bytes = (texels * layers * texelBytes(info.format) + alignment - 1) / alignment * alignment;
}

void addMemoryFunctions(Functions& to) {
    REFLET_STUB(vkAllocateMemory, allocate)
    REFLET_STUB(vkFreeMemory, release)
    REFLET_STUB(vkMapMemory, map)
    REFLET_STUB(vkCreateImage, createImage)
    REFLET_STUB(vkDestroyImage, (Destroying<Image, Kind::image, PFN_vkDestroyImage>::call))
    REFLET_STUB(vkGetImageMemoryRequirements, imageNeeds)
    REFLET_STUB(vkBindImageMemory, (bindMemory<Image, Kind::image, VkImage>))
    REFLET_STUB(vkCreateImageView, createView)
    REFLET_STUB(vkDestroyImageView, (Destroying<ImageView, Kind::imageView, PFN_vkDestroyImageView>::call))
    REFLET_STUB(vkCreateBuffer, createBuffer)
    REFLET_STUB(vkDestroyBuffer, (Destroying<Buffer, Kind::buffer, PFN_vkDestroyBuffer>::call))
    REFLET_STUB(vkGetBufferMemoryRequirements, bufferNeeds)
    REFLET_STUB(vkBindBufferMemory, (bindMemory<Buffer, Kind::buffer, VkBuffer>))
}

}  // namespace reflet::stub
