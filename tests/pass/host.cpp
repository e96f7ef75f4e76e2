// Opens a device with plain Vulkan.
#include "pass/host.h"

#include "base/error.h"

#include <volk.h>

namespace reflet::test {

namespace {

void check(VkResult result, const char* what) {
    REFLET_CHECK(result == VK_SUCCESS, "{}: {}", what, static_cast<int>(result));
}

}  // namespace

template <class F>
F Host::instanceFunction(const char* name) const {
    return reinterpret_cast<F>(vkGetInstanceProcAddr(instance_, name));
}

template <class F>
F Host::deviceFunction(const char* name) const {
    const auto lookUp = instanceFunction<PFN_vkGetDeviceProcAddr>("vkGetDeviceProcAddr");
    return reinterpret_cast<F>(lookUp(device_, name));
}

VkBool32 Host::note(VkDebugUtilsMessageSeverityFlagBitsEXT, VkDebugUtilsMessageTypeFlagsEXT types,
                    const VkDebugUtilsMessengerCallbackDataEXT* data, void* self) {
    if ((types & VK_DEBUG_UTILS_MESSAGE_TYPE_VALIDATION_BIT_EXT) != 0) {
        static_cast<Host*>(self)->messages_.emplace_back(data->pMessage);
    }
    return VK_FALSE;
}

Host::Host() {
    openInstance();
    openDevice();
    makeFrames();
}

void Host::openInstance() {
    check(volkInitialize(), "loading Vulkan");
    VkApplicationInfo app{VK_STRUCTURE_TYPE_APPLICATION_INFO};
    app.apiVersion = VK_API_VERSION_1_3;
    const VkValidationFeatureEnableEXT synchronization = VK_VALIDATION_FEATURE_ENABLE_SYNCHRONIZATION_VALIDATION_EXT;
    VkValidationFeaturesEXT validation{VK_STRUCTURE_TYPE_VALIDATION_FEATURES_EXT};
    validation.enabledValidationFeatureCount = 1;
    validation.pEnabledValidationFeatures = &synchronization;
    const char* layer = "VK_LAYER_KHRONOS_validation";
    const char* extension = VK_EXT_DEBUG_UTILS_EXTENSION_NAME;
    VkInstanceCreateInfo info{VK_STRUCTURE_TYPE_INSTANCE_CREATE_INFO, &validation};
    info.pApplicationInfo = &app;
    info.enabledLayerCount = 1;
    info.ppEnabledLayerNames = &layer;
    info.enabledExtensionCount = 1;
    info.ppEnabledExtensionNames = &extension;
    check(instanceFunction<PFN_vkCreateInstance>("vkCreateInstance")(&info, nullptr, &instance_), "instance");
    VkDebugUtilsMessengerCreateInfoEXT messenger{VK_STRUCTURE_TYPE_DEBUG_UTILS_MESSENGER_CREATE_INFO_EXT};
    messenger.messageSeverity =
        VK_DEBUG_UTILS_MESSAGE_SEVERITY_WARNING_BIT_EXT | VK_DEBUG_UTILS_MESSAGE_SEVERITY_ERROR_BIT_EXT;
    messenger.messageType = VK_DEBUG_UTILS_MESSAGE_TYPE_VALIDATION_BIT_EXT;
    messenger.pfnUserCallback = note;
    messenger.pUserData = this;
    check(instanceFunction<PFN_vkCreateDebugUtilsMessengerEXT>("vkCreateDebugUtilsMessengerEXT")(instance_, &messenger,
                                                                                                 nullptr, &messenger_),
          "messenger");
}

void Host::openDevice() {
    uint32_t one = 1;
    instanceFunction<PFN_vkEnumeratePhysicalDevices>("vkEnumeratePhysicalDevices")(instance_, &one, &physical_);
    REFLET_CHECK(physical_ != VK_NULL_HANDLE, "{} devices", one);
    VkPhysicalDeviceVulkan13Features v13{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_3_FEATURES};
    v13.dynamicRendering = VK_TRUE;
    v13.synchronization2 = VK_TRUE;
    VkPhysicalDeviceVulkan12Features v12{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_2_FEATURES, &v13};
    v12.scalarBlockLayout = VK_TRUE;
    VkPhysicalDeviceFeatures2 features{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_FEATURES_2, &v12};
    features.features.shaderStorageImageExtendedFormats = VK_TRUE;
    features.features.imageCubeArray = VK_TRUE;
    features.features.shaderStorageImageWriteWithoutFormat = VK_TRUE;
    const float priority = 1.0F;
    VkDeviceQueueCreateInfo queue{VK_STRUCTURE_TYPE_DEVICE_QUEUE_CREATE_INFO};
    queue.queueCount = 1;
    queue.pQueuePriorities = &priority;
    VkDeviceCreateInfo info{VK_STRUCTURE_TYPE_DEVICE_CREATE_INFO, &features};
    info.queueCreateInfoCount = 1;
    info.pQueueCreateInfos = &queue;
    check(instanceFunction<PFN_vkCreateDevice>("vkCreateDevice")(physical_, &info, nullptr, &device_), "device");
    deviceFunction<PFN_vkGetDeviceQueue>("vkGetDeviceQueue")(device_, 0, 0, &queue_);
}

void Host::makeFrames() {
    const VkCommandPoolCreateInfo pool{VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO, nullptr,
                                       VK_COMMAND_POOL_CREATE_RESET_COMMAND_BUFFER_BIT, 0};
    check(deviceFunction<PFN_vkCreateCommandPool>("vkCreateCommandPool")(device_, &pool, nullptr, &pool_), "pool");
    VkCommandBufferAllocateInfo allocate{VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO};
    allocate.commandPool = pool_;
    allocate.level = VK_COMMAND_BUFFER_LEVEL_PRIMARY;
    allocate.commandBufferCount = framesInFlight;
    check(
        deviceFunction<PFN_vkAllocateCommandBuffers>("vkAllocateCommandBuffers")(device_, &allocate, commands_.data()),
        "command buffers");
    for (VkFence& fence : fences_) {
        const VkFenceCreateInfo info{VK_STRUCTURE_TYPE_FENCE_CREATE_INFO, nullptr, VK_FENCE_CREATE_SIGNALED_BIT};
        check(deviceFunction<PFN_vkCreateFence>("vkCreateFence")(device_, &info, nullptr, &fence), "fence");
    }
}

Host::~Host() {
    waitForAll();
    for (VkFence fence : fences_) {
        deviceFunction<PFN_vkDestroyFence>("vkDestroyFence")(device_, fence, nullptr);
    }
    deviceFunction<PFN_vkDestroyCommandPool>("vkDestroyCommandPool")(device_, pool_, nullptr);
    deviceFunction<PFN_vkDestroyDevice>("vkDestroyDevice")(device_, nullptr);
    instanceFunction<PFN_vkDestroyDebugUtilsMessengerEXT>("vkDestroyDebugUtilsMessengerEXT")(instance_, messenger_,
                                                                                             nullptr);
    instanceFunction<PFN_vkDestroyInstance>("vkDestroyInstance")(instance_, nullptr);
}

gpu::OpenDevice Host::device() const {
    return {.instance = instance_, .physical = physical_, .device = device_, .lookUp = vkGetInstanceProcAddr};
}

void Host::frame(const std::function<void(VkCommandBuffer)>& record) {
    const uint32_t slot = frames_++ % framesInFlight;
    VkCommandBuffer commands = commands_.at(slot);
    VkFence fence = fences_.at(slot);
    deviceFunction<PFN_vkWaitForFences>("vkWaitForFences")(device_, 1, &fence, VK_TRUE, UINT64_MAX);
    const VkCommandBufferBeginInfo begin{VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO};
    check(deviceFunction<PFN_vkBeginCommandBuffer>("vkBeginCommandBuffer")(commands, &begin), "begin");
    record(commands);
    check(deviceFunction<PFN_vkEndCommandBuffer>("vkEndCommandBuffer")(commands), "end");
    VkSubmitInfo submit{VK_STRUCTURE_TYPE_SUBMIT_INFO};
    submit.commandBufferCount = 1;
    submit.pCommandBuffers = &commands;
    // Not before: if recording fails, nothing would ever signal it.
    deviceFunction<PFN_vkResetFences>("vkResetFences")(device_, 1, &fence);
    check(deviceFunction<PFN_vkQueueSubmit>("vkQueueSubmit")(queue_, 1, &submit, fence), "submit");
}

void Host::waitForAll() {
    deviceFunction<PFN_vkWaitForFences>("vkWaitForFences")(device_, framesInFlight, fences_.data(), VK_TRUE,
                                                           UINT64_MAX);
}

}  // namespace reflet::test
