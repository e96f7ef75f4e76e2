// Contexts and settings of the C API.
#include "api/calls.h"
#include "api/handles.h"
#include "api/live.h"
#include "api/queues.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <string_view>

std::span<const reflet::gpu::Shader> effectShaders();

namespace reflet::api {

namespace {

// Features that a host enabled, from whichever struct of the chain says so.
struct Enabled {
    bool scalarBlockLayout = false;
    bool synchronization2 = false;
};

Enabled enabledIn(const VkPhysicalDeviceFeatures2& features) {
    Enabled on;
    for (const auto* next = static_cast<const VkBaseInStructure*>(features.pNext); next != nullptr;
         next = next->pNext) {
        switch (next->sType) {
            case VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_2_FEATURES:
                on.scalarBlockLayout |=
                    reinterpret_cast<const VkPhysicalDeviceVulkan12Features*>(next)->scalarBlockLayout != VK_FALSE;
                break;
            case VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_SCALAR_BLOCK_LAYOUT_FEATURES:
                on.scalarBlockLayout |=
                    reinterpret_cast<const VkPhysicalDeviceScalarBlockLayoutFeatures*>(next)->scalarBlockLayout !=
                    VK_FALSE;
                break;
            case VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_3_FEATURES:
                on.synchronization2 |=
                    reinterpret_cast<const VkPhysicalDeviceVulkan13Features*>(next)->synchronization2 != VK_FALSE;
                break;
            case VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_SYNCHRONIZATION_2_FEATURES:
                on.synchronization2 |=
                    reinterpret_cast<const VkPhysicalDeviceSynchronization2Features*>(next)->synchronization2 !=
                    VK_FALSE;
                break;
            default:
                break;
        }
    }
    return on;
}

void requireFeatures(const VkPhysicalDeviceFeatures2& features) {
    if (features.sType != VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_FEATURES_2) {
        failArgument("enabledFeatures->sType: must be VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_FEATURES_2, is {}",
                     static_cast<int>(features.sType));
    }
    const Enabled on = enabledIn(features);
    const std::pair<const char*, bool> needed[] = {
        {"shaderStorageImageExtendedFormats", features.features.shaderStorageImageExtendedFormats != VK_FALSE},
        {"imageCubeArray", features.features.imageCubeArray != VK_FALSE},
        {"scalarBlockLayout", on.scalarBlockLayout},
        {"synchronization2", on.synchronization2}};
    for (const auto& [name, enabled] : needed) {
        if (!enabled) {
            failWith(REFLET_ERROR_MISSING_FEATURE,
                     "enabledFeatures: {} is not enabled; enable it in vkCreateDevice, and pass the same structs here",
                     name);
        }
    }
}

gpu::OpenDevice openDevice(const RefletContextInfo& info) {
    const std::pair<const char*, bool> handles[] = {{"instance", info.instance != VK_NULL_HANDLE},
                                                    {"physicalDevice", info.physicalDevice != VK_NULL_HANDLE},
                                                    {"device", info.device != VK_NULL_HANDLE},
                                                    {"getInstanceProcAddr", info.getInstanceProcAddr != nullptr},
                                                    {"enabledFeatures", info.enabledFeatures != nullptr}};
    for (const auto& [name, given] : handles) {
        if (!given) {
            failArgument("RefletContextInfo.{}: is NULL", name);
        }
    }
    requireFeatures(*info.enabledFeatures);
    gpu::OpenDevice open{
        .instance = info.instance,
        .physical = info.physicalDevice,
        .device = info.device,
        .lookUp = info.getInstanceProcAddr,
        .samplerAnisotropy = info.enabledFeatures->features.samplerAnisotropy != VK_FALSE,
        .queueFamilies = queueFamiliesOf(info),
        .writesWithoutFormat = info.enabledFeatures->features.shaderStorageImageWriteWithoutFormat != VK_FALSE};
    if (info.enabledExtensionCount > 0 && info.enabledExtensions == nullptr) {
        failArgument("RefletContextInfo.enabledExtensions: is NULL, and enabledExtensionCount is {}",
                     info.enabledExtensionCount);
    }
    for (uint32_t i = 0; i < info.enabledExtensionCount; ++i) {
        if (info.enabledExtensions[i] == nullptr) {
            failArgument("RefletContextInfo.enabledExtensions[{}]: is NULL", i);
        }
        open.debugUtils |= std::string_view(info.enabledExtensions[i]) == VK_EXT_DEBUG_UTILS_EXTENSION_NAME;
    }
    open.pipelines.driverCache = info.pipelineCache;
    open.pipelines.keepsData = info.pipelineCache == VK_NULL_HANDLE;
    if (info.pipelineCacheDataSize > 0) {
        if (info.pipelineCacheData == nullptr || !open.pipelines.keepsData) {
            failArgument("RefletContextInfo.pipelineCacheData: {}", info.pipelineCacheData == nullptr
                                                                        ? "is NULL, and pipelineCacheDataSize is not 0"
                                                                        : "is given, and pipelineCache as well");
        }
        open.pipelines.data = {static_cast<const std::byte*>(info.pipelineCacheData), info.pipelineCacheDataSize};
    }
    if (info.allocator != nullptr) {
        open.allocator = *info.allocator;
    }
    if (info.memory != nullptr) {
        const RefletMemoryCallbacks calls = adopted(info.memory, "RefletContextInfo.memory");
        if (calls.allocate == nullptr || calls.free == nullptr) {
            failArgument("RefletContextInfo.memory: allocate or free is NULL; give both, or no callbacks");
        }
        open.allocateMemory = [calls](const VkMemoryAllocateInfo& what, VkDeviceMemory* memory) {
            return calls.allocate(calls.user, &what, memory);
        };
        open.freeMemory = [calls](VkDeviceMemory memory) { calls.free(calls.user, memory); };
    }
    return open;
}

void requireVersion(uint32_t version) {
    const uint32_t major = version >> 20U;
    const uint32_t minor = version >> 10U & 1023U;
    if (version == 0) {
        failArgument("RefletContextInfo.version: is 0; set it to REFLET_VERSION");
    }
    // 0.1 had another binary interface.
    if (major != REFLET_VERSION_MAJOR || version > REFLET_VERSION || minor < 2) {
        failWith(REFLET_ERROR_INCOMPATIBLE_VERSION,
                 "RefletContextInfo.version: the header is of version {}.{}.{}, the library of {}.{}.{}", major, minor,
                 version & 1023U, REFLET_VERSION_MAJOR, REFLET_VERSION_MINOR, REFLET_VERSION_PATCH);
    }
}

RefletResult logged(const RefletContextInfo* info, RefletResult result) {
    if (result != REFLET_SUCCESS && info != nullptr && info->structSize >= offsetof(RefletContextInfo, queueFamilies) &&
        info->log != nullptr) {
        info->log(info->logUser, result, lastError().c_str());
    }
    return result;
}

// Of a setting, made once: the C API hands out pointers.
struct SettingTexts {
    std::string range;
    std::string standard;
    std::vector<const char*> choices;
};

const std::vector<SettingTexts>& settingTexts() {
    static const std::vector<SettingTexts> texts = [] {
        std::vector<SettingTexts> made;
        const Settings defaults{};
        for (const SettingEntry& entry : listedSettings()) {
            std::vector<const char*> choices;
            std::ranges::transform(entry.info.options, std::back_inserter(choices),
                                   [](const SettingOption& option) { return option.name.c_str(); });
            made.push_back({rangeText(entry.info), settingText(&defaults, entry.info), std::move(choices)});
        }
        return made;
    }();
    return texts;
}

// A setting's value as the C API's number: choices count in their list.
double numberOf(const SettingInfo& info, double stored) {
    const auto found = std::ranges::find(info.options, static_cast<uint32_t>(stored), &SettingOption::value);
    return info.type == SettingType::choice ? static_cast<double>(found - info.options.begin()) : stored;
}

// The contrary: as text, which SettingTable::set checks.
std::string textOfNumber(const SettingInfo& info, const std::string& name, double value) {
    if (info.type == SettingType::real) {
        return fmt::format("{}", static_cast<float>(value));
    }
    const double highest = info.type == SettingType::integer  ? info.highest
                           : info.type == SettingType::toggle ? 1.0
                                                              : static_cast<double>(info.options.size()) - 1.0;
    const double lowest = info.type == SettingType::integer ? info.lowest : 0.0;
    if (!(value >= lowest && value <= highest) || value != std::floor(value)) {
        failArgument("{}: is {}; must be a whole number from {} to {}", name, value, lowest, highest);
    }
    if (info.type == SettingType::choice) {
        return info.options[static_cast<size_t>(value)].name;
    }
    return info.type == SettingType::toggle ? (value != 0.0 ? "true" : "false") : fmt::format("{:.0f}", value);
}

RefletSettingType typeOf(SettingType type) {
    switch (type) {
        case SettingType::integer:
            return REFLET_SETTING_INTEGER;
        case SettingType::toggle:
            return REFLET_SETTING_SWITCH;
        case SettingType::choice:
            return REFLET_SETTING_CHOICE;
        default:
            return REFLET_SETTING_REAL;
    }
}

}  // namespace

}  // namespace reflet::api

using namespace reflet;
using namespace reflet::api;

RefletResult refletCreateContext(const RefletContextInfo* info, RefletContext* context) {
    if (context != nullptr) {
        *context = nullptr;
    }
    const RefletResult result = guarded([&] {
        if (context == nullptr) {
            failArgument("context: is NULL");
        }
        const RefletContextInfo given = adopted(info, "RefletContextInfo", offsetof(RefletContextInfo, queueFamilies));
        requireVersion(given.version);
        auto made = std::make_shared<RefletContext_T>();
        made->gpu = std::make_unique<gpu::Context>(openDevice(given));
        made->gpu->shaders().add(effectShaders());
        made->log = given.log;
        made->logUser = given.logUser;
        Live<RefletContext_T>::add(made);
        *context = made.get();
    });
    return logged(info, result);
}

void refletDestroyContext(RefletContext context) {
    const std::shared_ptr<RefletContext_T> taken = Live<RefletContext_T>::take(context);
    if (!taken) {  // NULL, or destroyed before
        return;
    }
    uint32_t owned = 0;
    {
        const std::scoped_lock lock(taken->mutex);
        owned = taken->owned;
        taken->destroyed = true;
    }
    if (owned == 0) {
        waitForCalls(taken);
        return;
    }
    const RefletResult result = guarded(
        [&] { failArgument("context: has {} views or radiance caches, which are to be destroyed before it", owned); });
    if (taken->log != nullptr) {
        taken->log(taken->logUser, result, lastError().c_str());
    }
}

RefletResult refletContextMemory(RefletContext context, uint64_t* bytes) {
    return guarded([&] {
        const std::shared_ptr<RefletContext_T> object = held(context, "context");
        if (bytes == nullptr) {
            failArgument("bytes: is NULL");
        }
        *bytes = context->gpu->memory().reserved();
    });
}

RefletResult refletPipelineCacheData(RefletContext context, size_t* size, void* data) {
    return guarded([&] {
        const std::shared_ptr<RefletContext_T> object = held(context, "context");
        if (size == nullptr) {
            failArgument("size: is NULL");
        }
        if (!context->gpu->pipelines().keepsData()) {
            failArgument("context: was given a pipelineCache; ask that for its data");
        }
        const std::vector<std::byte> bytes = context->gpu->pipelines().data();
        if (data != nullptr) {
            if (*size < bytes.size()) {
                failArgument("size: is {}, and there are {} bytes", *size, bytes.size());
            }
            std::ranges::copy(bytes, static_cast<std::byte*>(data));
        }
        *size = bytes.size();
    });
}

RefletResult refletCreateSettings(const char* preset, RefletSettings* settings) {
    if (settings != nullptr) {
        *settings = nullptr;
    }
    return guarded([&] {
        if (settings == nullptr) {
            failArgument("settings: is NULL");
        }
        auto made = std::make_shared<RefletSettings_T>();
        if (preset != nullptr && *preset != '\0') {
            applyPreset(made->values, preset);
        }
        Live<RefletSettings_T>::add(made);
        *settings = made.get();
    });
}

void refletDestroySettings(RefletSettings settings) {
    (void)Live<RefletSettings_T>::take(settings);  // goes with the last call that has it
}

RefletResult refletApplyPreset(RefletSettings settings, const char* preset) {
    return guarded([&] {
        const std::shared_ptr<RefletSettings_T> object = held(settings, "settings");
        if (preset == nullptr) {
            failArgument("preset: is NULL");
        }
        applyPreset(settings->values, preset);
    });
}

RefletResult refletSetSetting(RefletSettings settings, const char* name, const char* value) {
    return guarded([&] {
        const std::shared_ptr<RefletSettings_T> object = held(settings, "settings");
        if (name == nullptr || value == nullptr) {
            failArgument("{}: is NULL", name == nullptr ? "name" : "value");
        }
        settingTable().set(&settings->values, name, value);
    });
}

const char* refletGetSetting(RefletSettings settings, const char* name) {
    thread_local std::string text;
    const RefletResult result = guarded([&] {
        const std::shared_ptr<RefletSettings_T> object = held(settings, "settings");
        if (name == nullptr) {
            failArgument("name: is NULL");
        }
        text = settingText(&settings->values, settingTable().find(name).info);
    });
    // NOLINTNEXTLINE(clang-analyzer-cplusplus.InnerPointer): valid until the thread's next call, as the header says
    return result == REFLET_SUCCESS ? text.c_str() : nullptr;
}

RefletResult refletSetSettingNumber(RefletSettings settings, const char* name, double value) {
    return guarded([&] {
        const std::shared_ptr<RefletSettings_T> object = held(settings, "settings");
        if (name == nullptr) {
            failArgument("name: is NULL");
        }
        settingTable().set(&settings->values, name, textOfNumber(settingTable().find(name).info, name, value));
    });
}

RefletResult refletGetSettingNumber(RefletSettings settings, const char* name, double* value) {
    return guarded([&] {
        const std::shared_ptr<RefletSettings_T> object = held(settings, "settings");
        if (name == nullptr || value == nullptr) {
            failArgument("{}: is NULL", name == nullptr ? "name" : "value");
        }
        const SettingInfo& info = settingTable().find(name).info;
        *value = numberOf(info, loadSetting(&settings->values, info));
    });
}

uint32_t refletSettingCount(void) {
    return static_cast<uint32_t>(listedSettings().size());
}

RefletResult refletSettingInfo(uint32_t index, RefletSettingInfo* info) {
    return guarded([&] {
        const RefletSettingInfo given = adopted(info, "RefletSettingInfo");
        const auto& entries = listedSettings();
        if (index >= entries.size()) {
            failArgument("index: is {}, and there are {} settings", index, entries.size());
        }
        const SettingEntry& entry = entries[index];
        RefletSettingInfo told{};
        told.structSize = given.structSize;
        told.name = entry.name.c_str();
        told.help = entry.info.help.c_str();
        told.type = typeOf(entry.info.type);
        const SettingTexts& texts = settingTexts()[index];
        told.min = entry.info.lowest;
        told.max = entry.info.highest;
        told.range = texts.range.c_str();
        told.defaultValue = texts.standard.c_str();
        told.defaultNumber = numberOf(entry.info, entry.info.standard);
        told.choiceCount = static_cast<uint32_t>(texts.choices.size());
        told.choices = texts.choices.data();
        std::memcpy(info, &told, given.structSize);
    });
}
