// The device, its properties, and the counts of its objects.
#include "stub/driver.h"

#include "stub/functions.h"
#include "stub/objects.h"

#include <cstring>
#include <deque>
#include <mutex>

namespace reflet::stub {

namespace {

struct State {
    std::array<std::atomic<uint64_t>, kinds> made{};
    std::array<std::atomic<uint64_t>, kinds> live{};
    std::atomic<uint64_t> untilFault = 0;
    std::atomic<VkResult> fault = VK_SUCCESS;
    std::mutex mutex;  ///< of all below
    Device device;
    std::deque<Commands> all;
    std::vector<Commands*> idle;
    VkPhysicalDeviceFeatures2 features{};
    VkPhysicalDeviceVulkan12Features v12{};
    VkPhysicalDeviceVulkan13Features v13{};
};

State& state() {
    static auto* one = new State;
    return *one;
}

const char* const extensions[] = {VK_EXT_DEBUG_UTILS_EXTENSION_NAME};

VKAPI_ATTR void VKAPI_CALL properties(VkPhysicalDevice /*physical*/, VkPhysicalDeviceProperties2* to) {
    const std::scoped_lock lock(state().mutex);
    const Device& device = state().device;
    VkPhysicalDeviceProperties& p = to->properties;
    p.apiVersion = VK_API_VERSION_1_3;
    p.deviceType = device.cpu ? VK_PHYSICAL_DEVICE_TYPE_CPU : VK_PHYSICAL_DEVICE_TYPE_DISCRETE_GPU;
    std::strcpy(p.deviceName, "none");
    p.limits.maxImageDimension2D = device.maxImageSide;
    p.limits.maxStorageBufferRange = device.maxStorageBuffer;
    p.limits.minUniformBufferOffsetAlignment = 64;
    p.limits.bufferImageGranularity = 1024;
    p.limits.timestampPeriod = 1.0F;
    p.limits.maxSamplerLodBias = 16.0F;
    p.limits.maxSamplerAnisotropy = 16.0F;
}

VKAPI_ATTR void VKAPI_CALL memoryProperties(VkPhysicalDevice /*physical*/, VkPhysicalDeviceMemoryProperties* to) {
    to->memoryTypeCount = 2;
    to->memoryTypes[0] = {VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT, 0};
    to->memoryTypes[1] = {VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT, 0};
    to->memoryHeapCount = 1;
    const std::scoped_lock lock(state().mutex);
    to->memoryHeaps[0] = {state().device.memory, VK_MEMORY_HEAP_DEVICE_LOCAL_BIT};
}

VKAPI_ATTR void VKAPI_CALL formatProperties(VkPhysicalDevice /*physical*/, VkFormat /*format*/,
                                            VkFormatProperties* to) {
    const std::scoped_lock lock(state().mutex);
    to->optimalTilingFeatures = state().device.storesImages ? VK_FORMAT_FEATURE_STORAGE_IMAGE_BIT : 0;
}

PFN_vkVoidFunction find(const char* name) {
    static const Functions* const all = [] {
        auto* to = new Functions;
        addObjectFunctions(*to);
        addMemoryFunctions(*to);
        addCommandFunctions(*to);
        addFunction<PFN_vkGetPhysicalDeviceProperties2>(*to, "vkGetPhysicalDeviceProperties2", properties);
        addFunction<PFN_vkGetPhysicalDeviceMemoryProperties>(*to, "vkGetPhysicalDeviceMemoryProperties",
                                                             memoryProperties);
        addFunction<PFN_vkGetPhysicalDeviceFormatProperties>(*to, "vkGetPhysicalDeviceFormatProperties",
                                                             formatProperties);
        return to;
    }();
    const auto found = all->find(name);
    return found != all->end() ? found->second : nullptr;
}

VKAPI_ATTR PFN_vkVoidFunction VKAPI_CALL lookUpOnDevice(VkDevice /*device*/, const char* name) {
    return find(name);
}

VKAPI_ATTR PFN_vkVoidFunction VKAPI_CALL lookUp(VkInstance /*instance*/, const char* name) {
    return std::string_view(name) == "vkGetDeviceProcAddr" ? reinterpret_cast<PFN_vkVoidFunction>(lookUpOnDevice)
                                                           : find(name);
}

}  // namespace

const char* nameOf(size_t kind) {
    static constexpr std::array<const char*, kinds> names{
        "image",    "image view",     "buffer",  "memory", "shader",         "set layout", "layout",
        "pipeline", "pipeline cache", "sampler", "pool",   "descriptor set", "query pool", "command buffer"};
    return names.at(kind);
}

Counts counts() {
    Counts now;
    for (size_t i = 0; i < kinds; ++i) {
        now.made.at(i) = state().made.at(i);
        now.live.at(i) = state().live.at(i);
    }
    return now;
}

std::string leaks() {
    std::string text;
    const Counts now = counts();
    for (size_t i = 0; i < static_cast<size_t>(Kind::commands); ++i) {
        if (now.live.at(i) != 0) {
            text += std::string(nameOf(i)) + " " + std::to_string(now.live.at(i)) + " ";
        }
    }
    return text;
}

VkResult beginMaking() {
    State& s = state();
    uint64_t left = s.untilFault;
    while (left != 0 && !s.untilFault.compare_exchange_weak(left, left - 1)) {
    }
    return left == 1 ? s.fault.load() : VK_SUCCESS;
}

void noteMade(Kind kind) {
    ++state().made.at(static_cast<size_t>(kind));
    ++state().live.at(static_cast<size_t>(kind));
}

void noteGone(Kind kind) {
    --state().live.at(static_cast<size_t>(kind));
}

void failCall(uint64_t which, VkResult result) {
    state().fault = result;
    state().untilFault = which;
}

void setDevice(const Device& device) {
    const std::scoped_lock lock(state().mutex);
    state().device = device;
}

uint64_t memorySize() {
    const std::scoped_lock lock(state().mutex);
    return state().device.memory;
}

RefletContextInfo contextInfo() {
    State& s = state();
    const std::scoped_lock lock(s.mutex);
    s.v13 = {VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_3_FEATURES};
    s.v13.synchronization2 = VK_TRUE;
    s.v12 = {VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_2_FEATURES, &s.v13};
    s.v12.scalarBlockLayout = VK_TRUE;
    s.features = {VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_FEATURES_2, &s.v12};
    s.features.features.shaderStorageImageExtendedFormats = VK_TRUE;
    s.features.features.imageCubeArray = VK_TRUE;
    s.features.features.shaderStorageImageWriteWithoutFormat = s.device.writesWithoutFormat ? VK_TRUE : VK_FALSE;
    s.features.features.samplerAnisotropy = s.device.anisotropy ? VK_TRUE : VK_FALSE;
    RefletContextInfo info{};
    info.structSize = sizeof info;
    info.version = REFLET_VERSION;
    info.instance = hostHandle<VkInstance>(1);
    info.physicalDevice = hostHandle<VkPhysicalDevice>(2);
    info.device = hostHandle<VkDevice>(3);
    info.getInstanceProcAddr = lookUp;
    info.enabledFeatures = &s.features;
    info.enabledExtensions = extensions;
    info.enabledExtensionCount = s.device.debugUtils ? 1 : 0;
    return info;
}

VkCommandBuffer beginCommands() {
    State& s = state();
    const std::scoped_lock lock(s.mutex);
    if (s.idle.empty()) {
        s.idle.push_back(&s.all.emplace_back());
        noteMade(Kind::commands);
    }
    Commands* const commands = s.idle.back();
    s.idle.pop_back();
    ++commands->begun;
    return reinterpret_cast<VkCommandBuffer>(commands);
}

void finishCommands(VkCommandBuffer handle) {
    auto* const commands = reinterpret_cast<Commands*>(handle);
    commands->finished = commands->begun.load();
    const std::scoped_lock lock(state().mutex);
    state().idle.push_back(commands);
}

}  // namespace reflet::stub
