// A Vulkan device that the host or the program has opened, and the state shared by all recording on it: functions,
// memory, samplers, shaders, pipelines. A context never submits, waits or touches a queue.
#pragma once

#include "gpu/functions.h"
#include "gpu/memory.h"
#include "gpu/pipeline.h"
#include "gpu/shader.h"

#include <atomic>
#include <cstdint>
#include <deque>
#include <functional>
#include <memory>
#include <mutex>
#include <new>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace reflet::gpu {

/// An open device, as its owner describes it. The handles must outlive the context.
struct OpenDevice {
    VkInstance instance = VK_NULL_HANDLE;
    VkPhysicalDevice physical = VK_NULL_HANDLE;
    VkDevice device = VK_NULL_HANDLE;
    PFN_vkGetInstanceProcAddr lookUp = nullptr;
    // Optional features that were enabled; Vulkan has no query for them.
    bool samplerAnisotropy = false;
    /// VK_KHR_acceleration_structure, VK_KHR_ray_query and buffer device addresses.
    bool rayQuery = false;
    /// VK_EXT_debug_utils: names images and labels passes.
    bool debugUtils = false;
    /// Host memory of Vulkan objects; none: the driver's own.
    std::optional<VkAllocationCallbacks> allocator;
    /// The host's own allocator of device memory; both or none.
    std::function<VkResult(const VkMemoryAllocateInfo&, VkDeviceMemory*)> allocateMemory;
    std::function<void(VkDeviceMemory)> freeMemory;
    PipelineMaking pipelines;
    /// Queue families that share images and buffers (concurrent sharing); fewer than two: exclusive ownership.
    std::vector<uint32_t> queueFamilies{};
    /// shaderStorageImageWriteWithoutFormat.
    bool writesWithoutFormat = false;
};

/// Parameters of a sampler.
struct SamplerInfo {
    VkFilter mag = VK_FILTER_NEAREST;
    VkFilter min = VK_FILTER_NEAREST;
    VkSamplerMipmapMode mip = VK_SAMPLER_MIPMAP_MODE_NEAREST;
    VkSamplerAddressMode u = VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_EDGE;
    VkSamplerAddressMode v = VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_EDGE;
    float maxLod = VK_LOD_CLAMP_NONE;
    float anisotropy = 1.0F;  ///< maximum anisotropy; 1: off. Clamped to the device's limit
    float lodBias = 0.0F;     ///< added to the mip level. Clamped to the device's limit

    bool operator==(const SamplerInfo&) const = default;
};

/// A thread-safe counter.
class Counter {
public:
    Counter() = default;
    Counter(const Counter& other) : value_(other.value_.load()) {}
    Counter& operator=(const Counter& other) {
        value_ = other.value_.load();
        return *this;
    }
    Counter& operator++() {
        ++value_;
        return *this;
    }
    operator uint64_t() const { return value_; }
    bool operator==(const Counter& other) const { return value_ == other.value_; }

private:
    std::atomic<uint64_t> value_ = 0;
};

/// Number of objects that a context and its recorders have created so far. In a steady state none of them grows.
struct ObjectCounts {
    Counter images;
    Counter buffers;
    Counter memoryBlocks;
    Counter pipelines;
    Counter samplers;
    Counter descriptorPools;

    bool operator==(const ObjectCounts&) const = default;
};

/// Thread-safe, including the objects that it owns. A recorder must be used by one thread at a time.
class Context {
public:
    /// Throws Error that names a function that the device lacks.
    explicit Context(const OpenDevice& open);
    /// The device must have finished all recorded work.
    ~Context();
    Context(const Context&) = delete;
    Context& operator=(const Context&) = delete;

    [[nodiscard]] const VkPhysicalDeviceLimits& limits() const { return limits_; }
    /// Whether the device is a CPU: barriers are free, and its caches hold the last writes.
    [[nodiscard]] bool isCpu() const { return cpu_; }
    /// Whether acceleration structures can be built and queried by shaders.
    [[nodiscard]] bool hasRayQuery() const { return rayQuery_; }
    /// Alignment of the memory that building an acceleration structure needs; 0 without ray query.
    [[nodiscard]] VkDeviceSize scratchAlignment() const { return scratchAlignment_; }
    /// Whether shaders may write storage images without a declared format.
    [[nodiscard]] bool writesWithoutFormat() const { return writesWithoutFormat_; }
    /// Whether this format supports storage images.
    [[nodiscard]] bool storesImagesOf(VkFormat format) const;
    /// Sets the sharing mode of a VkImageCreateInfo or VkBufferCreateInfo.
    template <class CreateInfo>
    void share(CreateInfo& create) const {
        if (queueFamilies_.size() > 1) {
            create.sharingMode = VK_SHARING_MODE_CONCURRENT;
            create.queueFamilyIndexCount = static_cast<uint32_t>(queueFamilies_.size());
            create.pQueueFamilyIndices = queueFamilies_.data();
        }
    }
    [[nodiscard]] VkDevice handle() const { return device_; }
    [[nodiscard]] const VkAllocationCallbacks* allocator() const { return allocator_ ? &*allocator_ : nullptr; }
    [[nodiscard]] Memory& memory() { return *memory_; }
    [[nodiscard]] ShaderLibrary& shaders() { return shaders_; }
    [[nodiscard]] PipelineCache& pipelines() { return *pipelines_; }
    [[nodiscard]] ObjectCounts& counts() { return counts_; }

    /// Equal infos share one sampler, which lives as long as the context.
    VkSampler sampler(const SamplerInfo& info);

    /// A layout of single descriptors, by binding, for all stages. Equal layouts share one object, which lives as long
    /// as the context, so that pipelines created with it are reused from one scene to the next.
    VkDescriptorSetLayout setLayout(const std::vector<VkDescriptorType>& bindings);

    /// Announces commands that are going to be recorded and submitted; returns their serial number for finishWork.
    uint64_t beginWork();
    /// The device has finished these commands, or they will never be submitted. Destroys retired objects that only they
    /// could use.
    void finishWork(uint64_t serial);

    /// Deferred destruction: runs `destroy` once all work that has begun is finished; at once if there is none. For
    /// destructors: if host memory is exhausted, the objects leak until the device is destroyed.
    template <class F>
    void retire(F destroy) noexcept;

    /// A call has returned VK_ERROR_DEVICE_LOST: no recorded commands can be executed any more.
    void noteLost() { lost_ = true; }
    [[nodiscard]] bool isLost() const { return lost_; }

    VkResult allocateMemory(const VkMemoryAllocateInfo& info, VkDeviceMemory* memory);
    void freeMemory(VkDeviceMemory memory);
    /// For debuggers; do nothing without VK_EXT_debug_utils.
    void nameImage(VkImage image, const std::string& name) const;
    void beginLabel(VkCommandBuffer commands, const char* name) const;
    void endLabel(VkCommandBuffer commands) const;

    /// Device-level functions.
    DeviceFunctions vk{};

private:
    struct Retired {
        uint64_t serial;  ///< serial number of the last work that may use it
        std::function<void()> destroy;
    };

    void collectRetired() noexcept;
    static void destroyNow(const std::function<void()>& destroy) noexcept;

    VkDevice device_ = VK_NULL_HANDLE;
    std::optional<VkAllocationCallbacks> allocator_;
    std::function<VkResult(const VkMemoryAllocateInfo&, VkDeviceMemory*)> allocateMemory_;
    std::function<void(VkDeviceMemory)> freeMemory_;
    PFN_vkSetDebugUtilsObjectNameEXT setName_ = nullptr;
    PFN_vkCmdBeginDebugUtilsLabelEXT beginLabel_ = nullptr;
    PFN_vkCmdEndDebugUtilsLabelEXT endLabel_ = nullptr;
    VkPhysicalDeviceLimits limits_{};
    VkDeviceSize scratchAlignment_ = 0;
    bool anisotropic_ = false;
    bool rayQuery_ = false;
    bool cpu_ = false;
    std::atomic<bool> lost_ = false;
    bool writesWithoutFormat_ = false;
    std::vector<uint32_t> queueFamilies_;
    VkPhysicalDevice physical_ = VK_NULL_HANDLE;
    PFN_vkGetPhysicalDeviceFormatProperties formatProperties_ = nullptr;
    ObjectCounts counts_;
    std::unique_ptr<Memory> memory_;
    ShaderLibrary shaders_;
    std::unique_ptr<PipelineCache> pipelines_;
    std::vector<std::pair<SamplerInfo, VkSampler>> samplers_;
    std::vector<std::pair<std::vector<VkDescriptorType>, VkDescriptorSetLayout>> setLayouts_;
    std::recursive_mutex mutex_;  ///< guards all below, samplers_ and setLayouts_; recursive: destroying retires more
    uint64_t lastSerial_ = 0;
    std::vector<uint64_t> unfinished_;  ///< ascending
    std::deque<Retired> retired_;       ///< serials ascend
};

template <class F>
void Context::retire(F destroy) noexcept {
    try {
        const std::scoped_lock lock(mutex_);
        if (unfinished_.empty()) {
            destroy();
        } else {
            retired_.push_back({lastSerial_, std::move(destroy)});
        }
    } catch (const std::bad_alloc&) {  // leaked, as the device may be using it
        return;
    }
}

}  // namespace reflet::gpu
