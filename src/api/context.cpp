// Contexts and settings of the C API.
#include "api/calls.h"
#include "api/handles.h"

#include <array>
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
    gpu::OpenDevice open{.instance = info.instance,
                         .physical = info.physicalDevice,
                         .device = info.device,
                         .lookUp = info.getInstanceProcAddr,
                         .samplerAnisotropy = info.enabledFeatures->features.samplerAnisotropy != VK_FALSE};
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
    if (info.memory != nullptr) {
        const RefletMemoryCallbacks calls = *info.memory;
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
    if (version == 0) {
        failArgument("RefletContextInfo.version: is 0; set it to REFLET_VERSION");
    }
    if (major != REFLET_VERSION_MAJOR || version > REFLET_VERSION) {
        failWith(REFLET_ERROR_INCOMPATIBLE_VERSION,
                 "RefletContextInfo.version: the header is of version {}.{}.{}, the library of {}.{}.{}", major,
                 version >> 10U & 1023U, version & 1023U, REFLET_VERSION_MAJOR, REFLET_VERSION_MINOR,
                 REFLET_VERSION_PATCH);
    }
}

RefletResult logged(const RefletContextInfo* info, RefletResult result) {
    if (result != REFLET_SUCCESS && info != nullptr && info->structSize >= sizeof(RefletContextInfo) &&
        info->log != nullptr) {
        info->log(info->logUser, result, lastError().c_str());
    }
    return result;
}

// Of a setting, made once: the C API hands out pointers.
struct SettingTexts {
    std::string range;
    std::string standard;
};

const std::vector<SettingTexts>& settingTexts() {
    static const std::vector<SettingTexts> texts = [] {
        std::vector<SettingTexts> made;
        const Settings defaults{};
        for (const SettingEntry& entry : settingTable().entries()) {
            made.push_back({rangeText(entry.info), settingText(&defaults, entry.info)});
        }
        return made;
    }();
    return texts;
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
        const RefletContextInfo given = adopted(info, "RefletContextInfo");
        requireVersion(given.version);
        auto made = std::make_unique<RefletContext_T>();
        made->gpu = std::make_unique<gpu::Context>(openDevice(given));
        made->gpu->shaders().add(effectShaders());
        made->log = given.log;
        made->logUser = given.logUser;
        *context = made.release();
    });
    return logged(info, result);
}

void refletDestroyContext(RefletContext context) {
    delete context;
}

RefletResult refletContextMemory(RefletContext context, uint64_t* bytes) {
    return guarded([&] {
        if (context == nullptr || bytes == nullptr) {
            failArgument("{}: is NULL", context == nullptr ? "context" : "bytes");
        }
        const std::scoped_lock lock(context->mutex);
        *bytes = context->gpu->memory().reserved();
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
        auto made = std::make_unique<RefletSettings_T>();
        if (preset != nullptr && *preset != '\0') {
            applyPreset(made->values, preset);
        }
        *settings = made.release();
    });
}

void refletDestroySettings(RefletSettings settings) {
    delete settings;
}

RefletResult refletApplyPreset(RefletSettings settings, const char* preset) {
    return guarded([&] {
        if (settings == nullptr || preset == nullptr) {
            failArgument("{}: is NULL", settings == nullptr ? "settings" : "preset");
        }
        applyPreset(settings->values, preset);
    });
}

RefletResult refletSetSetting(RefletSettings settings, const char* name, const char* value) {
    return guarded([&] {
        if (settings == nullptr || name == nullptr || value == nullptr) {
            failArgument("{}: is NULL", settings == nullptr ? "settings" : name == nullptr ? "name" : "value");
        }
        settingTable().set(&settings->values, name, value);
    });
}

const char* refletGetSetting(RefletSettings settings, const char* name) {
    thread_local std::string text;
    const RefletResult result = guarded([&] {
        if (settings == nullptr || name == nullptr) {
            failArgument("{}: is NULL", settings == nullptr ? "settings" : "name");
        }
        text = settingText(&settings->values, settingTable().find(name).info);
    });
    // NOLINTNEXTLINE(clang-analyzer-cplusplus.InnerPointer): valid until the thread's next call, as the header says
    return result == REFLET_SUCCESS ? text.c_str() : nullptr;
}

uint32_t refletSettingCount(void) {
    return static_cast<uint32_t>(settingTable().entries().size());
}

RefletResult refletSettingInfo(uint32_t index, RefletSettingInfo* info) {
    return guarded([&] {
        const RefletSettingInfo given = adopted(info, "RefletSettingInfo");
        const auto& entries = settingTable().entries();
        if (index >= entries.size()) {
            failArgument("index: is {}, and there are {} settings", index, entries.size());
        }
        const SettingEntry& entry = entries[index];
        RefletSettingInfo told{};
        told.structSize = given.structSize;
        told.name = entry.name.c_str();
        told.help = entry.info.help.c_str();
        told.type = typeOf(entry.info.type);
        told.lowest = entry.info.lowest;
        told.highest = entry.info.highest;
        told.range = settingTexts()[index].range.c_str();
        told.standard = settingTexts()[index].standard.c_str();
        std::memcpy(info, &told, given.structSize);
    });
}
