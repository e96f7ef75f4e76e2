// Opens a Vulkan device and tracks submitted work by serial numbers, for waiting and for deferred destruction.
#include "device/device.h"

#include "base/error.h"
#include "device/physical_device.h"

#include <algorithm>
#include <exception>
#include <future>
#include <thread>
#include <vector>

namespace reflet::gpu {

namespace {

/// Software drivers wait for ever for threads of their own that could not be started.
void requireThreads(VkPhysicalDevice physical) {
    VkPhysicalDeviceProperties properties{};
    vkGetPhysicalDeviceProperties(physical, &properties);
    if (properties.deviceType != VK_PHYSICAL_DEVICE_TYPE_CPU) {
        return;
    }
    const unsigned wanted = std::clamp(std::thread::hardware_concurrency(), 1U, 32U) + 1;
    std::promise<void> end;
    const std::shared_future<void> ended = end.get_future().share();
    std::vector<std::jthread> threads;
    threads.reserve(wanted);
    bool started = true;
    try {
        for (unsigned i = 0; i < wanted; ++i) {
            threads.emplace_back([ended] { ended.wait(); });
        }
    } catch (const std::exception&) {
        started = false;
    }
    end.set_value();
    if (!started) {
        fail(
            "opening the device: only {} of {} threads could be started: raise the limit of processes (ulimit -u), or "
            "end others",
            threads.size(), wanted);
    }
}

constexpr const char* validationLayer = "VK_LAYER_KHRONOS_validation";

VkDebugUtilsMessengerCreateInfoEXT messengerInfo(PFN_vkDebugUtilsMessengerCallbackEXT callback, void* self) {
    VkDebugUtilsMessengerCreateInfoEXT info{VK_STRUCTURE_TYPE_DEBUG_UTILS_MESSENGER_CREATE_INFO_EXT};
    info.messageSeverity =
        VK_DEBUG_UTILS_MESSAGE_SEVERITY_WARNING_BIT_EXT | VK_DEBUG_UTILS_MESSAGE_SEVERITY_ERROR_BIT_EXT;
    info.messageType = VK_DEBUG_UTILS_MESSAGE_TYPE_VALIDATION_BIT_EXT | VK_DEBUG_UTILS_MESSAGE_TYPE_GENERAL_BIT_EXT;
    info.pfnUserCallback = callback;
    info.pUserData = self;
    return info;
}

}  // namespace

DeviceHandles::DeviceHandles(std::function<void(const std::string&)> onMessage) : onMessage_(std::move(onMessage)) {}

DeviceHandles::DeviceHandles(const DeviceOptions& options) : DeviceHandles(options.onMessage) {
    createInstance(options);
    physical_ = choosePhysicalDevice(instance_, options.select);
    description_ = describe(physical_);
    createDevice(!options.windowExtensions.empty());
    keepPipelines(options);
}

DeviceHandles::~DeviceHandles() {
    pipelines_.reset();
    if (device_ != VK_NULL_HANDLE) {
        functions_.vkDestroyDevice(device_, nullptr);
    }
    if (messenger_ != VK_NULL_HANDLE) {
        // Looked up for this instance: another one, made later without the extension, has replaced the global pointer.
        const auto destroy = reinterpret_cast<PFN_vkDestroyDebugUtilsMessengerEXT>(
            vkGetInstanceProcAddr(instance_, "vkDestroyDebugUtilsMessengerEXT"));
        destroy(instance_, messenger_, nullptr);
    }
    if (instance_ != VK_NULL_HANDLE) {
        vkDestroyInstance(instance_, nullptr);
    }
}

VkBool32 DeviceHandles::onValidation(VkDebugUtilsMessageSeverityFlagBitsEXT severity,
                                     VkDebugUtilsMessageTypeFlagsEXT types,
                                     const VkDebugUtilsMessengerCallbackDataEXT* data, void* self) {
    // Messages of the loader (about a driver that does not load, say) matter only if they are errors.
    if ((types & VK_DEBUG_UTILS_MESSAGE_TYPE_VALIDATION_BIT_EXT) == 0 &&
        severity < VK_DEBUG_UTILS_MESSAGE_SEVERITY_ERROR_BIT_EXT) {
        return VK_FALSE;
    }
    auto& device = *static_cast<DeviceHandles*>(self);
    // Newer layers leave the identifier out of the text.
    const std::string_view text = data->pMessage;
    const std::string_view id = data->pMessageIdName == nullptr ? "" : data->pMessageIdName;
    device.messages_.push_back(text.find(id) != std::string_view::npos ? std::string(text)
                                                                       : fmt::format("{}: {}", id, text));
    if (device.onMessage_) {
        device.onMessage_(device.messages_.back());
    }
    return VK_FALSE;
}

void DeviceHandles::createInstance(const DeviceOptions& options) {
    instance_ = makeInstance(options.validation ? validationLayer : nullptr, options.windowExtensions);
    if (options.validation) {
        const auto info = messengerInfo(onValidation, this);
        VkDebugUtilsMessengerEXT made = VK_NULL_HANDLE;
        vkCheck(vkCreateDebugUtilsMessengerEXT(instance_, &info, nullptr, &made), "creating the messenger");
        messenger_ = made;
    }
}

void DeviceHandles::createDevice(bool fillsWindows) {
    queueFamily_ = graphicsQueueFamily(physical_).value();
    const float priority = 1.0F;
    VkDeviceQueueCreateInfo queueInfo{VK_STRUCTURE_TYPE_DEVICE_QUEUE_CREATE_INFO};
    queueInfo.queueFamilyIndex = queueFamily_;
    queueInfo.queueCount = 1;
    queueInfo.pQueuePriorities = &priority;

    VkPhysicalDeviceFeatures has{};
    vkGetPhysicalDeviceFeatures(physical_, &has);
    RequiredFeatures required = requiredFeatures();
    required.core.features.samplerAnisotropy = has.samplerAnisotropy;
    RayQueryFeatures rays;
    std::vector<const char*> extensions;
    if (fillsWindows) {
        requireSwapchain(physical_);
        extensions.push_back(VK_KHR_SWAPCHAIN_EXTENSION_NAME);
    }
    VkDeviceCreateInfo info{VK_STRUCTURE_TYPE_DEVICE_CREATE_INFO};
    info.pNext = required.chain();
    const bool rayQuery = hasRayQuery(physical_);
    if (rayQuery) {
        required.v12.bufferDeviceAddress = VK_TRUE;
        rays.structures.accelerationStructure = VK_TRUE;
        rays.query.rayQuery = VK_TRUE;
        required.v13.pNext = rays.chain();
        extensions.insert(extensions.end(), rayQueryExtensions.begin(), rayQueryExtensions.end());
    }
    info.enabledExtensionCount = static_cast<uint32_t>(extensions.size());
    info.ppEnabledExtensionNames = extensions.data();
    info.queueCreateInfoCount = 1;
    info.pQueueCreateInfos = &queueInfo;
    requireThreads(physical_);
    VkDevice made = VK_NULL_HANDLE;
    vkCheck(vkCreateDevice(physical_, &info, nullptr, &made), "opening the device");
    device_ = made;
    volkLoadDeviceTable(&functions_, device_);
    functions_.vkGetDeviceQueue(device_, queueFamily_, 0, &queue_);
    opened_ = {.instance = instance_,
               .physical = physical_,
               .device = device_,
               .lookUp = vkGetInstanceProcAddr,
               .samplerAnisotropy = has.samplerAnisotropy != 0,
               .rayQuery = rayQuery};
}

void DeviceHandles::keepPipelines(const DeviceOptions& options) {
    opened_.pipelines = {.threads = std::max(std::thread::hardware_concurrency(), 1U), .onCompile = options.onCompile};
    if (!options.pipelineFolder.empty()) {
        VkPhysicalDeviceProperties properties{};
        vkGetPhysicalDeviceProperties(physical_, &properties);
        pipelines_.emplace(functions_, device_, properties, options.pipelineFolder);
        opened_.pipelines.driverCache = pipelines_->handle();
    }
}

Device::Device(const DeviceOptions& options) : DeviceHandles(options), Context(opened()) {
    for (const std::span<const Shader> list : options.shaders) {
        shaders().add(list);
    }
    VkSemaphoreTypeCreateInfo type{VK_STRUCTURE_TYPE_SEMAPHORE_TYPE_CREATE_INFO};
    type.semaphoreType = VK_SEMAPHORE_TYPE_TIMELINE;
    const VkSemaphoreCreateInfo semaphore{VK_STRUCTURE_TYPE_SEMAPHORE_CREATE_INFO, &type, 0};
    VkSemaphore timeline = VK_NULL_HANDLE;
    vkCheck(functions().vkCreateSemaphore(handle(), &semaphore, nullptr, &timeline), "creating the timeline");
    timeline_ = timeline;

    const VkCommandPoolCreateInfo pool{VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO, nullptr,
                                       VK_COMMAND_POOL_CREATE_TRANSIENT_BIT, queueFamily()};
    VkCommandPool made = VK_NULL_HANDLE;
    const VkResult result = functions().vkCreateCommandPool(handle(), &pool, nullptr, &made);
    if (result != VK_SUCCESS) {
        destroyOwn();
        vkCheck(result, "creating a command pool");
    }
    immediatePool_ = made;
}

Device::~Device() {
    destroyOwn();
}

void Device::destroyOwn() {
    functions().vkDeviceWaitIdle(handle());
    functions().vkDestroyCommandPool(handle(), immediatePool_, nullptr);
    functions().vkDestroySemaphore(handle(), timeline_, nullptr);
}

uint64_t Device::submit(VkCommandBuffer commands) {
    const uint64_t serial = submitted_ + 1;
    VkCommandBufferSubmitInfo command{VK_STRUCTURE_TYPE_COMMAND_BUFFER_SUBMIT_INFO};
    command.commandBuffer = commands;
    VkSemaphoreSubmitInfo signal{VK_STRUCTURE_TYPE_SEMAPHORE_SUBMIT_INFO};
    signal.semaphore = timeline_;
    signal.value = serial;
    signal.stageMask = VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT;
    VkSubmitInfo2 info{VK_STRUCTURE_TYPE_SUBMIT_INFO_2};
    info.commandBufferInfoCount = 1;
    info.pCommandBufferInfos = &command;
    info.signalSemaphoreInfoCount = 1;
    info.pSignalSemaphoreInfos = &signal;
    vkCheck(functions().vkQueueSubmit2(queue(), 1, &info, VK_NULL_HANDLE), "submitting work");
    submitted_ = serial;
    return serial;
}

void Device::wait(uint64_t serial) {
    VkSemaphoreWaitInfo info{VK_STRUCTURE_TYPE_SEMAPHORE_WAIT_INFO};
    info.semaphoreCount = 1;
    info.pSemaphores = &timeline_;
    info.pValues = &serial;
    vkCheck(functions().vkWaitSemaphores(handle(), &info, UINT64_MAX), "waiting for the device");
}

void Device::runNow(const std::function<void(VkCommandBuffer)>& record) {
    VkCommandBufferAllocateInfo allocate{VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO};
    allocate.commandPool = immediatePool_;
    allocate.level = VK_COMMAND_BUFFER_LEVEL_PRIMARY;
    allocate.commandBufferCount = 1;
    VkCommandBuffer commands = VK_NULL_HANDLE;
    vkCheck(functions().vkAllocateCommandBuffers(handle(), &allocate, &commands), "allocating commands");
    const uint64_t work = beginWork();
    const auto finish = [&] {
        functions().vkFreeCommandBuffers(handle(), immediatePool_, 1, &commands);
        finishWork(work);
    };
    try {
        recordAndRun(commands, record);
    } catch (...) {
        functions().vkDeviceWaitIdle(handle());  // the work may have been submitted
        finish();
        throw;
    }
    finish();
}

void Device::recordAndRun(VkCommandBuffer commands, const std::function<void(VkCommandBuffer)>& record) {
    VkCommandBufferBeginInfo begin{VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO};
    begin.flags = VK_COMMAND_BUFFER_USAGE_ONE_TIME_SUBMIT_BIT;
    vkCheck(functions().vkBeginCommandBuffer(commands, &begin), "beginning commands");
    record(commands);
    vkCheck(functions().vkEndCommandBuffer(commands), "ending commands");
    wait(submit(commands));
}

}  // namespace reflet::gpu
