// Adopts an open device.
#include "gpu/context.h"

#include "base/error.h"

#include <algorithm>

namespace reflet::gpu {

namespace {

template <class F>
F instanceFunction(const OpenDevice& open, const char* name) {
    const PFN_vkVoidFunction found = open.lookUp(open.instance, name);
    if (found == nullptr) {
        throw Unsupported(fmt::format(
            "the Vulkan instance has no {}: it was created for a version below 1.2 (VkApplicationInfo::apiVersion)",
            name));
    }
    return reinterpret_cast<F>(found);
}

void requireVersion(uint32_t version) {
    if (version < VK_API_VERSION_1_2) {
        throw Unsupported(fmt::format("the device has Vulkan {}.{}: 1.2 is needed", VK_API_VERSION_MAJOR(version),
                                      VK_API_VERSION_MINOR(version)));
    }
}

}  // namespace

Context::Context(const OpenDevice& open)
    : device_(open.device),
      allocator_(open.allocator),
      allocateMemory_(open.allocateMemory),
      freeMemory_(open.freeMemory),
      anisotropic_(open.samplerAnisotropy),
      rayQuery_(open.rayQuery),
      writesWithoutFormat_(open.writesWithoutFormat),
      queueFamilies_(open.queueFamilies),
      physical_(open.physical) {
    VkPhysicalDeviceAccelerationStructurePropertiesKHR structures{
        VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_ACCELERATION_STRUCTURE_PROPERTIES_KHR};
    VkPhysicalDeviceProperties2 properties{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PROPERTIES_2,
                                           rayQuery_ ? &structures : nullptr};
    instanceFunction<PFN_vkGetPhysicalDeviceProperties2>(open, "vkGetPhysicalDeviceProperties2")(open.physical,
                                                                                                 &properties);
    requireVersion(properties.properties.apiVersion);
    const auto lookUp = instanceFunction<PFN_vkGetDeviceProcAddr>(open, "vkGetDeviceProcAddr");
    vk = loadFunctions(lookUp, open.device, rayQuery_);
    if (open.debugUtils) {
        setName_ = reinterpret_cast<PFN_vkSetDebugUtilsObjectNameEXT>(lookUp(device_, "vkSetDebugUtilsObjectNameEXT"));
        beginLabel_ =
            reinterpret_cast<PFN_vkCmdBeginDebugUtilsLabelEXT>(lookUp(device_, "vkCmdBeginDebugUtilsLabelEXT"));
        endLabel_ = reinterpret_cast<PFN_vkCmdEndDebugUtilsLabelEXT>(lookUp(device_, "vkCmdEndDebugUtilsLabelEXT"));
    }
    formatProperties_ =
        instanceFunction<PFN_vkGetPhysicalDeviceFormatProperties>(open, "vkGetPhysicalDeviceFormatProperties");
    limits_ = properties.properties.limits;
    cpu_ = properties.properties.deviceType == VK_PHYSICAL_DEVICE_TYPE_CPU;
    scratchAlignment_ = structures.minAccelerationStructureScratchOffsetAlignment;
    VkPhysicalDeviceMemoryProperties memory{};
    instanceFunction<PFN_vkGetPhysicalDeviceMemoryProperties>(open, "vkGetPhysicalDeviceMemoryProperties")(
        open.physical, &memory);
    memory_ = std::make_unique<Memory>(*this, memory);
    pipelines_ = std::make_unique<PipelineCache>(*this, open.pipelines);
}

bool Context::storesImagesOf(VkFormat format) const {
    VkFormatProperties known{};
    formatProperties_(physical_, format, &known);
    return (known.optimalTilingFeatures & VK_FORMAT_FEATURE_STORAGE_IMAGE_BIT) != 0;
}

Context::~Context() {
    unfinished_.clear();
    pipelines_.reset();
    collectRetired();
    memory_.reset();
    for (const auto& [info, sampler] : samplers_) {
        vk.vkDestroySampler(device_, sampler, allocator());
    }
    for (const auto& [bindings, layout] : setLayouts_) {
        vk.vkDestroyDescriptorSetLayout(device_, layout, allocator());
    }
}

VkSampler Context::sampler(const SamplerInfo& info) {
    const std::scoped_lock lock(mutex_);
    for (const auto& [known, sampler] : samplers_) {
        if (known == info) {
            return sampler;
        }
    }
    VkSamplerCreateInfo create{VK_STRUCTURE_TYPE_SAMPLER_CREATE_INFO};
    create.magFilter = info.mag;
    create.minFilter = info.min;
    create.mipmapMode = info.mip;
    create.addressModeU = info.u;
    create.addressModeV = info.v;
    create.addressModeW = VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_EDGE;
    create.maxLod = info.maxLod;
    create.mipLodBias = std::clamp(info.lodBias, -limits_.maxSamplerLodBias, limits_.maxSamplerLodBias);
    create.anisotropyEnable =
        anisotropic_ && info.anisotropy > 1.0F && info.min == VK_FILTER_LINEAR ? VK_TRUE : VK_FALSE;
    create.maxAnisotropy = std::min(info.anisotropy, limits_.maxSamplerAnisotropy);
    VkSampler sampler = VK_NULL_HANDLE;
    vkCheck(vk.vkCreateSampler(device_, &create, allocator(), &sampler), "creating a sampler");
    samplers_.emplace_back(info, sampler);
    ++counts_.samplers;
    return sampler;
}

VkDescriptorSetLayout Context::setLayout(const std::vector<VkDescriptorType>& bindings) {
    const std::scoped_lock lock(mutex_);
    for (const auto& [known, layout] : setLayouts_) {
        if (known == bindings) {
            return layout;
        }
    }
    std::vector<VkDescriptorSetLayoutBinding> list(bindings.size());
    for (uint32_t i = 0; i < list.size(); ++i) {
        list[i] = {i, bindings[i], 1, VK_SHADER_STAGE_ALL, nullptr};
    }
    VkDescriptorSetLayoutCreateInfo info{VK_STRUCTURE_TYPE_DESCRIPTOR_SET_LAYOUT_CREATE_INFO};
    info.bindingCount = static_cast<uint32_t>(list.size());
    info.pBindings = list.data();
    auto& [key, layout] = setLayouts_.emplace_back(bindings, VkDescriptorSetLayout(VK_NULL_HANDLE));
    const VkResult result = vk.vkCreateDescriptorSetLayout(device_, &info, allocator(), &layout);
    if (result != VK_SUCCESS) {
        setLayouts_.pop_back();
        vkCheck(result, "creating a set layout");
    }
    return layout;
}

VkResult Context::allocateMemory(const VkMemoryAllocateInfo& info, VkDeviceMemory* memory) {
    return allocateMemory_ ? allocateMemory_(info, memory) : vk.vkAllocateMemory(device_, &info, allocator(), memory);
}

void Context::freeMemory(VkDeviceMemory memory) {
    if (freeMemory_) {
        freeMemory_(memory);
    } else {
        vk.vkFreeMemory(device_, memory, allocator());
    }
}

void Context::nameImage(VkImage image, const std::string& name) const {
    if (setName_ != nullptr) {
        VkDebugUtilsObjectNameInfoEXT info{VK_STRUCTURE_TYPE_DEBUG_UTILS_OBJECT_NAME_INFO_EXT};
        info.objectType = VK_OBJECT_TYPE_IMAGE;
        info.objectHandle = reinterpret_cast<uint64_t>(image);
        info.pObjectName = name.c_str();
        setName_(device_, &info);
    }
}

void Context::beginLabel(VkCommandBuffer commands, const char* name) const {
    if (beginLabel_ != nullptr) {
        VkDebugUtilsLabelEXT label{VK_STRUCTURE_TYPE_DEBUG_UTILS_LABEL_EXT};
        label.pLabelName = name;
        beginLabel_(commands, &label);
    }
}

void Context::endLabel(VkCommandBuffer commands) const {
    if (endLabel_ != nullptr) {
        endLabel_(commands);
    }
}

uint64_t Context::beginWork() {
    const std::scoped_lock lock(mutex_);
    unfinished_.push_back(++lastSerial_);
    return lastSerial_;
}

void Context::finishWork(uint64_t serial) {
    const std::scoped_lock lock(mutex_);
    std::erase(unfinished_, serial);
    collectRetired();
}

// Allocates nothing itself: called by destructors.
void Context::collectRetired() noexcept {
    const uint64_t oldest = unfinished_.empty() ? UINT64_MAX : unfinished_.front();
    while (!retired_.empty() && retired_.front().serial < oldest) {
        const std::function<void()> destroy = std::move(retired_.front().destroy);
        retired_.pop_front();
        destroyNow(destroy);
    }
}

void Context::destroyNow(const std::function<void()>& destroy) noexcept {
    try {
        destroy();
    } catch (const std::bad_alloc&) {  // of the list of free memory, which then has a hole less
        return;
    }
}

}  // namespace reflet::gpu
