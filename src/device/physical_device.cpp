// Lists Vulkan devices, checks them against the minimum requirements and selects one.
#include "device/physical_device.h"

#include "base/ascii.h"
#include "base/error.h"
#include "base/visible_text.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cstring>
#include <span>

namespace reflet::gpu {

namespace {

constexpr uint32_t minSampledImages = 128;

std::string versionText(uint32_t version) {
    return fmt::format("{}.{}.{}", VK_API_VERSION_MAJOR(version), VK_API_VERSION_MINOR(version),
                       VK_API_VERSION_PATCH(version));
}

const char* kindName(VkPhysicalDeviceType type) {
    switch (type) {
        case VK_PHYSICAL_DEVICE_TYPE_DISCRETE_GPU:
            return "discrete GPU";
        case VK_PHYSICAL_DEVICE_TYPE_INTEGRATED_GPU:
            return "integrated GPU";
        case VK_PHYSICAL_DEVICE_TYPE_VIRTUAL_GPU:
            return "virtual GPU";
        case VK_PHYSICAL_DEVICE_TYPE_CPU:
            return "CPU";
        default:
            return "other";
    }
}

struct NeededFormat {
    const char* name;
    VkFormat format;
    VkFormatFeatureFlags features;
};

// Format features that the images of the frame need; src/render declares the images.
constexpr VkFormatFeatureFlags sampled = VK_FORMAT_FEATURE_SAMPLED_IMAGE_BIT;
constexpr VkFormatFeatureFlags target = sampled | VK_FORMAT_FEATURE_COLOR_ATTACHMENT_BIT;
constexpr VkFormatFeatureFlags storage = sampled | VK_FORMAT_FEATURE_STORAGE_IMAGE_BIT;
constexpr std::array neededFormats{
    NeededFormat{"D32_SFLOAT", VK_FORMAT_D32_SFLOAT, sampled | VK_FORMAT_FEATURE_DEPTH_STENCIL_ATTACHMENT_BIT},
    NeededFormat{"R8G8B8A8_SRGB", VK_FORMAT_R8G8B8A8_SRGB, sampled},
    NeededFormat{"A2B10G10R10_UNORM", VK_FORMAT_A2B10G10R10_UNORM_PACK32, target},
    NeededFormat{"R8G8B8A8_UNORM", VK_FORMAT_R8G8B8A8_UNORM, target | storage},
    NeededFormat{"B10G11R11_UFLOAT", VK_FORMAT_B10G11R11_UFLOAT_PACK32, target},
    NeededFormat{"R16G16_SFLOAT", VK_FORMAT_R16G16_SFLOAT, target | storage},
    NeededFormat{"R16G16B16A16_SFLOAT", VK_FORMAT_R16G16B16A16_SFLOAT, target | storage},
    NeededFormat{"R32G32B32A32_SFLOAT", VK_FORMAT_R32G32B32A32_SFLOAT, storage},
    NeededFormat{"R32_UINT", VK_FORMAT_R32_UINT, target | storage},
    NeededFormat{"R32_SFLOAT", VK_FORMAT_R32_SFLOAT, storage},
    NeededFormat{"R32G32_UINT", VK_FORMAT_R32G32_UINT, storage},
    NeededFormat{"R8_UNORM", VK_FORMAT_R8_UNORM, storage},
};

std::vector<std::string> missingRequirements(VkPhysicalDevice device, const VkPhysicalDeviceProperties& properties) {
    if (properties.apiVersion < VK_API_VERSION_1_3) {
        return {fmt::format("Vulkan 1.3 (it has {})", versionText(properties.apiVersion))};
    }
    std::vector<std::string> missing;
    const auto need = [&](bool there, std::string what) {
        if (!there) {
            missing.push_back(std::move(what));
        }
    };
    RequiredFeatures has;
    has.chain();
    vkGetPhysicalDeviceFeatures2(device, &has.core);
    need(has.core.features.shaderStorageImageExtendedFormats != 0, "extended storage image formats");
    need(has.core.features.imageCubeArray != 0, "arrays of cube maps");
    need(has.core.features.shaderClipDistance != 0, "clip distances");
    need(has.v12.scalarBlockLayout != 0, "scalar block layout");
    need(has.v12.timelineSemaphore != 0, "timeline semaphores");
    need(has.v13.dynamicRendering != 0, "dynamic rendering");
    need(has.v13.synchronization2 != 0, "synchronization2");
    need(properties.limits.maxPerStageDescriptorSampledImages >= minSampledImages, "128 sampled images per stage");
    need(graphicsQueueFamily(device).has_value(), "a queue for graphics and compute with timestamps");
    for (const NeededFormat& format : neededFormats) {
        VkFormatProperties support{};
        vkGetPhysicalDeviceFormatProperties(device, format.format, &support);
        need((support.optimalTilingFeatures & format.features) == format.features,
             fmt::format("the format {}", format.name));
    }
    return missing;
}

// Whether the device has all of the extensions.
bool hasExtensions(VkPhysicalDevice device, std::span<const char* const> names) {
    uint32_t count = 0;
    constexpr const char* asking = "asking for the device's extensions";
    vkCheck(vkEnumerateDeviceExtensionProperties(device, nullptr, &count, nullptr), asking);
    std::vector<VkExtensionProperties> extensions(count);
    vkCheck(vkEnumerateDeviceExtensionProperties(device, nullptr, &count, extensions.data()), asking);
    return std::ranges::all_of(names, [&](const char* name) {
        return std::ranges::any_of(extensions, [&](const auto& e) { return std::strcmp(e.extensionName, name) == 0; });
    });
}

std::vector<std::string> extrasOf(VkPhysicalDevice device) {
    const char* pipeline = VK_KHR_RAY_TRACING_PIPELINE_EXTENSION_NAME;
    VkPhysicalDeviceVulkan12Features v12{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_2_FEATURES};
    VkPhysicalDeviceFeatures2 features{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_FEATURES_2, &v12};
    vkGetPhysicalDeviceFeatures2(device, &features);
    std::vector<std::string> extras;
    const auto add = [&](bool there, const char* what) {
        if (there) {
            extras.emplace_back(what);
        }
    };
    add(hasRayQuery(device), "ray query");
    add(hasExtensions(device, std::span(&pipeline, 1)), "ray tracing pipeline");
    add(v12.runtimeDescriptorArray != 0 && v12.shaderSampledImageArrayNonUniformIndexing != 0, "descriptor indexing");
    add(v12.shaderFloat16 != 0, "fp16");
    add(features.features.samplerAnisotropy != 0, "anisotropic filtering");
    return extras;
}

std::vector<VkPhysicalDevice> physicalDevices(VkInstance instance) {
    uint32_t count = 0;
    constexpr const char* asking = "asking for Vulkan devices";
    vkCheck(vkEnumeratePhysicalDevices(instance, &count, nullptr), asking);
    std::vector<VkPhysicalDevice> devices(count);
    vkCheck(vkEnumeratePhysicalDevices(instance, &count, devices.data()), asking);
    return devices;
}

// Lower is better: real GPUs before software.
int rank(VkPhysicalDevice device) {
    VkPhysicalDeviceProperties properties{};
    vkGetPhysicalDeviceProperties(device, &properties);
    switch (properties.deviceType) {
        case VK_PHYSICAL_DEVICE_TYPE_DISCRETE_GPU:
            return 0;
        case VK_PHYSICAL_DEVICE_TYPE_INTEGRATED_GPU:
            return 1;
        case VK_PHYSICAL_DEVICE_TYPE_VIRTUAL_GPU:
            return 2;
        case VK_PHYSICAL_DEVICE_TYPE_CPU:
            return 4;
        default:
            return 3;
    }
}

std::string listText(std::span<const DeviceDescription> all) {
    std::string text;
    for (size_t i = 0; i < all.size(); ++i) {
        text += fmt::format("{}{} '{}'", i == 0 ? "" : ", ", i, all[i].name);
    }
    return text;
}

std::optional<size_t> findSelected(std::span<const DeviceDescription> all, const std::string& select) {
    size_t index = 0;
    const char* end = select.data() + select.size();
    if (const auto [rest, error] = std::from_chars(select.data(), end, index); error == std::errc() && rest == end) {
        return index < all.size() ? std::optional(index) : std::nullopt;
    }
    const auto found = std::ranges::find_if(
        all, [&](const auto& d) { return inLowerCase(d.name).find(inLowerCase(select)) != std::string::npos; });
    return found == all.end() ? std::nullopt : std::optional<size_t>(found - all.begin());
}

VkBool32 noteFirst(VkDebugUtilsMessageSeverityFlagBitsEXT /*severity*/, VkDebugUtilsMessageTypeFlagsEXT /*types*/,
                   const VkDebugUtilsMessengerCallbackDataEXT* message, void* first) {
    auto& text = *static_cast<std::string*>(first);
    text = text.empty() ? message->pMessage : text;
    return VK_FALSE;
}

// The loader's own reason for an instance that it does not make: its result for a manifest that is no JSON is "out of
// host memory". Empty: it gives none.
std::string loaderReason(VkInstanceCreateInfo info, std::vector<const char*> extensions) {
    std::string reason;
    VkDebugUtilsMessengerCreateInfoEXT messenger{VK_STRUCTURE_TYPE_DEBUG_UTILS_MESSENGER_CREATE_INFO_EXT};
    messenger.pNext = info.pNext;
    messenger.messageSeverity = VK_DEBUG_UTILS_MESSAGE_SEVERITY_ERROR_BIT_EXT;
    messenger.messageType =
        VK_DEBUG_UTILS_MESSAGE_TYPE_GENERAL_BIT_EXT | VK_DEBUG_UTILS_MESSAGE_TYPE_VALIDATION_BIT_EXT;
    messenger.pfnUserCallback = noteFirst;
    messenger.pUserData = &reason;
    extensions.push_back(VK_EXT_DEBUG_UTILS_EXTENSION_NAME);
    info.pNext = &messenger;
    info.enabledExtensionCount = static_cast<uint32_t>(extensions.size());
    info.ppEnabledExtensionNames = extensions.data();
    VkInstance instance = VK_NULL_HANDLE;
    if (vkCreateInstance(&info, nullptr, &instance) == VK_SUCCESS) {
        volkLoadInstanceOnly(instance);
        vkDestroyInstance(instance, nullptr);
    }
    return reason;
}

}  // namespace

RequiredFeatures requiredFeatures() {
    RequiredFeatures required;
    required.core.features.shaderStorageImageExtendedFormats = VK_TRUE;
    required.core.features.imageCubeArray = VK_TRUE;
    required.core.features.shaderClipDistance = VK_TRUE;
    required.v12.scalarBlockLayout = VK_TRUE;
    required.v12.timelineSemaphore = VK_TRUE;
    required.v13.dynamicRendering = VK_TRUE;
    required.v13.synchronization2 = VK_TRUE;
    return required;
}

bool hasRayQuery(VkPhysicalDevice device) {
    if (!hasExtensions(device, rayQueryExtensions)) {
        return false;
    }
    RayQueryFeatures rays;
    VkPhysicalDeviceVulkan12Features v12{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_2_FEATURES, rays.chain()};
    VkPhysicalDeviceFeatures2 features{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_FEATURES_2, &v12};
    vkGetPhysicalDeviceFeatures2(device, &features);
    return rays.structures.accelerationStructure != 0 && rays.query.rayQuery != 0 && v12.bufferDeviceAddress != 0;
}

VkInstance makeInstance(const char* layer, std::span<const char* const> extensions) {
    if (volkInitialize() != VK_SUCCESS) {
        fail("no Vulkan loader (libvulkan.so.1): install it and a driver (Debian: libvulkan1 mesa-vulkan-drivers)");
    }
    VkApplicationInfo app{VK_STRUCTURE_TYPE_APPLICATION_INFO};
    app.pApplicationName = "reflet";
    app.apiVersion = VK_API_VERSION_1_3;
    const VkValidationFeatureEnableEXT synchronization = VK_VALIDATION_FEATURE_ENABLE_SYNCHRONIZATION_VALIDATION_EXT;
    VkValidationFeaturesEXT validation{VK_STRUCTURE_TYPE_VALIDATION_FEATURES_EXT};
    validation.enabledValidationFeatureCount = 1;
    validation.pEnabledValidationFeatures = &synchronization;
    std::vector<const char*> enabled(extensions.begin(), extensions.end());
    VkInstanceCreateInfo info{VK_STRUCTURE_TYPE_INSTANCE_CREATE_INFO};
    info.pApplicationInfo = &app;
    if (layer != nullptr) {
        info.pNext = &validation;
        info.enabledLayerCount = 1;
        info.ppEnabledLayerNames = &layer;
        enabled.push_back(VK_EXT_DEBUG_UTILS_EXTENSION_NAME);
    }
    info.enabledExtensionCount = static_cast<uint32_t>(enabled.size());
    info.ppEnabledExtensionNames = enabled.data();
    VkInstance instance = VK_NULL_HANDLE;
    const VkResult result = vkCreateInstance(&info, nullptr, &instance);
    if (result == VK_ERROR_LAYER_NOT_PRESENT) {
        fail("the layer {} is not installed (Debian: vulkan-validationlayers)", layer);
    }
    if (result == VK_ERROR_INCOMPATIBLE_DRIVER) {
        fail(
            "no Vulkan driver: install one (Debian: mesa-vulkan-drivers; it renders on the CPU where there is no GPU)");
    }
    if (const std::string reason = result < 0 ? loaderReason(info, enabled) : ""; !reason.empty()) {
        fail(
            "creating a Vulkan instance failed: {}; its manifests are those of the environment's VK_DRIVER_FILES, "
            "VK_ICD_FILENAMES and VK_LAYER_PATH, and of the folders vulkan in /usr/share and /etc",
            oneLine(reason, 300));
    }
    vkCheck(result, "creating a Vulkan instance");
    volkLoadInstanceOnly(instance);
    return instance;
}

std::optional<uint32_t> graphicsQueueFamily(VkPhysicalDevice device) {
    uint32_t count = 0;
    vkGetPhysicalDeviceQueueFamilyProperties(device, &count, nullptr);
    std::vector<VkQueueFamilyProperties> families(count);
    vkGetPhysicalDeviceQueueFamilyProperties(device, &count, families.data());
    constexpr VkQueueFlags needed = VK_QUEUE_GRAPHICS_BIT | VK_QUEUE_COMPUTE_BIT;
    for (uint32_t i = 0; i < count; ++i) {
        if ((families[i].queueFlags & needed) == needed && families[i].timestampValidBits != 0) {
            return i;
        }
    }
    return std::nullopt;
}

void requireSwapchain(VkPhysicalDevice device) {
    if (!hasExtensions(device, std::array{VK_KHR_SWAPCHAIN_EXTENSION_NAME})) {
        fail("the device '{}' cannot present to windows (no {}); select another with --device", describe(device).name,
             VK_KHR_SWAPCHAIN_EXTENSION_NAME);
    }
}

DeviceDescription describe(VkPhysicalDevice device) {
    VkPhysicalDeviceDriverProperties driver{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_DRIVER_PROPERTIES};
    VkPhysicalDeviceProperties2 properties{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PROPERTIES_2, &driver};
    vkGetPhysicalDeviceProperties2(device, &properties);
    const VkPhysicalDeviceProperties& p = properties.properties;
    return {.name = p.deviceName,
            .driver = fmt::format("{} {}", driver.driverName, driver.driverInfo),
            .kind = kindName(p.deviceType),
            .api = versionText(p.apiVersion),
            .missing = missingRequirements(device, p),
            .extras = p.apiVersion >= VK_API_VERSION_1_3 ? extrasOf(device) : std::vector<std::string>{}};
}

std::vector<DeviceDescription> listDevices() {
    VkInstance instance = makeInstance(nullptr);
    std::vector<DeviceDescription> list;
    try {
        for (const VkPhysicalDevice device : physicalDevices(instance)) {
            list.push_back(describe(device));
        }
    } catch (...) {
        vkDestroyInstance(instance, nullptr);
        throw;
    }
    vkDestroyInstance(instance, nullptr);
    return list;
}

VkPhysicalDevice choosePhysicalDevice(VkInstance instance, const std::string& select) {
    const std::vector<VkPhysicalDevice> devices = physicalDevices(instance);
    std::vector<DeviceDescription> all;
    std::ranges::transform(devices, std::back_inserter(all), describe);
    if (all.empty()) {
        fail("no Vulkan device: install a driver (Debian: mesa-vulkan-drivers; it renders on the CPU without a GPU)");
    }
    if (!select.empty()) {
        const auto chosen = findSelected(all, select);
        if (!chosen) {
            fail("no Vulkan device '{}'; available: {}", select, listText(all));
        }
        if (!all[*chosen].missing.empty()) {
            fail("the device '{}' lacks {}", all[*chosen].name, fmt::join(all[*chosen].missing, ", "));
        }
        return devices[*chosen];
    }
    std::optional<size_t> best;
    for (size_t i = 0; i < all.size(); ++i) {
        if (all[i].missing.empty() && (!best || rank(devices[i]) < rank(devices[*best]))) {
            best = i;
        }
    }
    if (!best) {
        fail("no usable Vulkan device: '{}' lacks {}", all.front().name, fmt::join(all.front().missing, ", "));
    }
    return devices[*best];
}

}  // namespace reflet::gpu
