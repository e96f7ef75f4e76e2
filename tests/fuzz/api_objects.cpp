// Contexts, settings and views of the target of the C API.
#include "api_machine.h"
#include "fuzz.h"

namespace reflet::fuzz {

namespace {

PFN_vkVoidFunction deviceFunction(const char* name) {
    const RefletContextInfo info = stub::contextInfo();
    const auto lookUp =
        reinterpret_cast<PFN_vkGetDeviceProcAddr>(info.getInstanceProcAddr(info.instance, "vkGetDeviceProcAddr"));
    return lookUp(info.device, name);
}

VkResult allocate(void* /*user*/, const VkMemoryAllocateInfo* info, VkDeviceMemory* memory) {
    static const auto call = reinterpret_cast<PFN_vkAllocateMemory>(deviceFunction("vkAllocateMemory"));
    return call(VK_NULL_HANDLE, info, nullptr, memory);
}

void release(void* /*user*/, VkDeviceMemory memory) {
    static const auto call = reinterpret_cast<PFN_vkFreeMemory>(deviceFunction("vkFreeMemory"));
    call(VK_NULL_HANDLE, memory, nullptr);
}

void hear(void* /*user*/, RefletResult /*result*/, const char* text) {
    if (text == nullptr || *text == '\0') {
        finding("nothing in the log");
    }
}

constexpr std::array<const char*, 6> presets{"fast", "balanced", "quality", "", "fst", "\xFF\x80\x1B[2J"};

}  // namespace

void ApiMachine::createContext(ContextSlot& slot) {
    if (slot.alive) {
        return;
    }
    RefletContextInfo info = stub::contextInfo();
    const uint8_t kind = bytes_.byte();
    RefletMemoryCallbacks memory{sizeof memory, nullptr, allocate, release};
    constexpr std::array<uint32_t, 3> families{0, 1, 0};
    constexpr std::array<uint8_t, 16> cache{1, 2, 3};
    info.log = hear;
    if ((kind & 1U) != 0) {
        spoilSome(memory);
        info.memory = &memory;
    }
    if ((kind & 2U) != 0) {
        info.queueFamilies = families.data();
        info.queueFamilyCount = families.size();
    }
    if ((kind & 4U) != 0) {
        info.pipelineCacheData = cache.data();
        info.pipelineCacheDataSize = cache.size();
    }
    if (kind >= 0xF0) {
        info.pipelineCache = stub::hostHandle<VkPipelineCache>(9);
    }
    if (kind >= 0xC0) {
        spoilSome(info);
    }
    const RefletResult result = note(ApiCall::createContext, refletCreateContext(orNull(&info), &slot.context));
    slot.alive = slot.alive || result == REFLET_SUCCESS;
    if (slot.alive != (slot.context != nullptr)) {
        finding("a context without success, or the contrary");
    }
}

void ApiMachine::destroyContext(ContextSlot& slot) {
    RefletContext handle = contextOf(slot);
    refletDestroyContext(handle);
    note(ApiCall::destroyContext, REFLET_SUCCESS);
    slot.alive = slot.alive && handle != slot.context;
}

void ApiMachine::askContext(const ContextSlot& slot) {
    RefletContext handle = contextOf(slot);
    uint64_t bytes = 0;
    note(ApiCall::contextMemory, refletContextMemory(handle, orNull(&bytes)));
    std::array<uint8_t, 64> data{};
    size_t size = bytes_.chance(40) ? bytes_.below(data.size()) : data.size();
    note(ApiCall::pipelineCacheData, refletPipelineCacheData(handle, orNull(&size), orNull(data.data())));
}

void ApiMachine::createSettings(SettingsSlot& slot) {
    if (slot.alive) {
        return;
    }
    const char* const preset = presets[bytes_.chance(64) ? bytes_.below(presets.size()) : bytes_.below(3)];
    slot.alive = note(ApiCall::createSettings, refletCreateSettings(preset, &slot.settings)) == REFLET_SUCCESS;
    if (slot.alive && !bytes_.chance(40)) {  // effects that the presets leave off
        (void)refletSetSetting(slot.settings, "ao.method", "horizon");
        (void)refletSetSetting(slot.settings, "contact.distance", "0.5");
        (void)refletSetSetting(slot.settings, "motion_blur.enabled", "true");
    }
}

void ApiMachine::destroySettings(SettingsSlot& slot) {
    RefletSettings handle = settingsOf(slot);
    refletDestroySettings(handle);
    note(ApiCall::destroySettings, REFLET_SUCCESS);
    slot.alive = slot.alive && handle != slot.settings;
}

void ApiMachine::changeSettings(const SettingsSlot& slot) {
    RefletSettings handle = settingsOf(slot);
    RefletSettingInfo info{};
    info.structSize = sizeof info;
    (void)refletSettingInfo(bytes_.byte() % refletSettingCount(), &info);
    switch (bytes_.below(6)) {
        case 0:
            note(ApiCall::applyPreset, refletApplyPreset(handle, orNull(presets[bytes_.below(presets.size())])));
            break;
        case 1: {
            const std::string name = bytes_.chance(60) ? bytes_.text(30) : info.name;
            const std::string value = bytes_.text(40);
            note(ApiCall::setSetting, refletSetSetting(handle, orNull(name.c_str()), orNull(value.c_str())));
            break;
        }
        case 2: {
            constexpr std::array<const char*, 4> values{"1", "true", "0.5", "2"};
            const char* const value = info.choiceCount > 0 ? info.choices[bytes_.below(info.choiceCount)]
                                                           : values[bytes_.below(values.size())];
            note(ApiCall::setSetting, refletSetSetting(handle, info.name, value));
            break;
        }
        default: {
            const uint8_t how = bytes_.byte();
            const double within = info.min + (info.max - info.min) * bytes_.byte() / 255.0;
            const double value = how < 30                           ? double(bytes_.real())
                                 : how < 140                        ? double(bytes_.below(4))
                                 : info.type == REFLET_SETTING_REAL ? within
                                                                    : double(int64_t(within));
            note(ApiCall::setSettingNumber, refletSetSettingNumber(handle, orNull(info.name), value));
        }
    }
}

void ApiMachine::askSettings(const SettingsSlot& slot) {
    RefletSettings handle = settingsOf(slot);
    RefletSettingInfo info{};
    spoilOut(info);
    const uint32_t index = bytes_.chance(100) ? bytes_.word() : bytes_.byte() % refletSettingCount();
    const bool known = note(ApiCall::settingInfo, refletSettingInfo(index, orNull(&info))) == REFLET_SUCCESS;
    const std::string name = known && info.name != nullptr ? info.name : bytes_.text(20);
    double number = 0.0;
    note(ApiCall::getSettingNumber, refletGetSettingNumber(handle, name.c_str(), orNull(&number)));
    const bool told = refletGetSetting(handle, name.c_str()) != nullptr;
    note(ApiCall::getSetting, told ? REFLET_SUCCESS : REFLET_ERROR_INVALID_ARGUMENT);
}

void ApiMachine::changeCache(CacheSlot& slot) {
    if (!slot.alive && bytes_.chance(40)) {
        note(ApiCall::resetCache, refletResetRadianceCache(cacheOf(slot)));  // NULL, or destroyed
        return;
    }
    if (!slot.alive) {
        RefletContext context = contextOf(contexts_[bytes_.chance(40) ? 1 : 0]);
        RefletRadianceCache made = nullptr;
        slot.alive = note(ApiCall::createCache, refletCreateRadianceCache(context, orNull(&made))) == REFLET_SUCCESS;
        slot.cache = slot.alive ? made : slot.cache;
        return;
    }
    RefletRadianceCache handle = cacheOf(slot);
    if (bytes_.chance(128)) {
        note(ApiCall::resetCache, refletResetRadianceCache(handle));
        return;
    }
    if (std::ranges::any_of(views_, &ViewSlot::inFrame)) {
        return;  // which may use it
    }
    for (ViewSlot& view : views_) {  // the device must not use it any more
        finishFrames(view, 0);
    }
    refletDestroyRadianceCache(handle);
    note(ApiCall::destroyCache, REFLET_SUCCESS);
    slot.alive = slot.alive && handle != slot.cache;
}

void ApiMachine::createView(ViewSlot& slot) {
    if (slot.alive) {
        return;
    }
    constexpr std::array<uint16_t, 16> sides{64, 40, 1, 2, 3, 16, 33, 65, 90, 127, 160, 257, 640, 1920, 4097, 16384};
    RefletViewInfo info{};
    info.structSize = sizeof info;
    const uint8_t kind = bytes_.byte();
    info.width = sides[kind % 16];
    info.height = sides[(kind / 16 + 1) % 16];
    const uint8_t more = bytes_.byte();
    info.framesInFlight = 1 + more % REFLET_MAX_FRAMES_IN_FLIGHT;
    info.flags = (more & 4U) != 0 ? REFLET_VIEW_PASS_TIMES : 0;
    info.viewIndex = more / 8;
    spoilSome(info);
    RefletContext context = contextOf(contexts_[bytes_.chance(40) ? 1 : 0]);
    RefletView made = nullptr;
    if (note(ApiCall::createView, refletCreateView(context, orNull(&info), &made)) != REFLET_SUCCESS) {
        return;
    }
    slot = {};
    slot.view = made;
    slot.alive = true;
    slot.width = info.width;
    slot.height = info.height;
    slot.framesInFlight = info.framesInFlight;
}

void ApiMachine::destroyView(ViewSlot& slot) {
    RefletView handle = viewOf(slot);
    if (slot.alive && handle == slot.view) {
        finishFrames(slot, 0);
        slot.alive = slot.inFrame = false;
    }
    refletDestroyView(handle);
    note(ApiCall::destroyView, REFLET_SUCCESS);
}

void ApiMachine::changeView(ViewSlot& slot) {
    RefletView handle = viewOf(slot);
    const auto side = [&](uint32_t now) {
        return bytes_.chance(60) ? bytes_.word() : now * (64 + bytes_.byte()) / 128;
    };
    const uint32_t width = side(slot.width);
    const uint32_t height = side(slot.height);
    switch (bytes_.below(5)) {
        case 0:
        case 1:
            if (note(ApiCall::resizeView, refletResizeView(handle, width, height)) == REFLET_SUCCESS) {
                slot.width = width;
                slot.height = height;
            }
            break;
        case 2: {
            const bool none = bytes_.chance(60);
            const uint32_t outputWidth = none ? 0 : std::max(width, slot.width);
            const uint32_t outputHeight = none ? 0 : std::max(height, slot.height);
            if (note(ApiCall::setOutputSize, refletSetOutputSize(handle, outputWidth, outputHeight)) ==
                REFLET_SUCCESS) {
                slot.outputWidth = outputWidth;
                slot.outputHeight = outputHeight;
            }
            break;
        }
        case 3:
            note(ApiCall::resetView, refletResetView(handle));
            break;
        default:
            if (!slot.inFrame) {
                finishFrames(slot, 0);
            }
            note(ApiCall::finishView, refletFinishView(handle));
    }
}

void ApiMachine::askView(const ViewSlot& slot) {
    constexpr std::array<const char*, 8> images{"depth",   "light",   "diffuse",        "specular_confidence",
                                                "nothing", "pyramid", "sun_visibility", "exposure"};
    RefletView handle = viewOf(slot);
    uint64_t bytes = 0;
    note(ApiCall::viewMemory, refletViewMemory(handle, orNull(&bytes)));
    std::array<char, 3000> text{};
    size_t size = bytes_.chance(60) ? bytes_.byte() : text.size();
    note(ApiCall::describe, refletDescribe(handle, orNull(&size), orNull(text.data())));
    std::array<RefletPassTime, 20> times{};
    auto count = static_cast<uint32_t>(bytes_.chance(60) ? bytes_.below(20) : times.size());
    note(ApiCall::passTimes, refletPassTimes(handle, orNull(&count), orNull(times.data())));
    RefletImage image{};
    note(ApiCall::findImage, refletFindImage(handle, orNull(images[bytes_.below(images.size())]), orNull(&image)));
}

void ApiMachine::prepare(const ViewSlot& slot) {
    RefletView handle = viewOf(slot);
    const auto host = hostOf(slot);
    RefletPrepareInfo& info = host->prepare;
    if (bytes_.chance(128)) {
        info.effects &= bytes_.bits();
    }
    if (bytes_.chance(64)) {
        info.light = nullptr;
        info.toneMap = nullptr;
    }
    spoilSome(info);
    spoilSome(host->gbuffer);
    spoilLight(*host);
    spoilSome(host->toneMap);
    uint32_t remaining = 0;
    note(ApiCall::prepare, refletPrepare(handle, anySettings(), orNull(&info), bytes_.below(4), orNull(&remaining)));
}

}  // namespace reflet::fuzz
