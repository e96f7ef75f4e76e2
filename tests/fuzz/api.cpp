// The C API: bytes become calls, on a driver that executes nothing. Valid frames are what they become by themselves; a
// byte in ten spoils a field, passes NULL or a handle that was destroyed, calls out of order, or makes the driver fail.
#include "api_machine.h"
#include "fuzz.h"

namespace reflet::fuzz {

namespace {

constexpr std::array<const char*, apiCalls> names{"refletCreateContext",
                                                  "refletDestroyContext",
                                                  "refletContextMemory",
                                                  "refletPipelineCacheData",
                                                  "refletCreateSettings",
                                                  "refletDestroySettings",
                                                  "refletApplyPreset",
                                                  "refletSetSetting",
                                                  "refletGetSetting",
                                                  "refletSetSettingNumber",
                                                  "refletGetSettingNumber",
                                                  "refletSettingInfo",
                                                  "refletCreateView",
                                                  "refletDestroyView",
                                                  "refletResizeView",
                                                  "refletSetOutputSize",
                                                  "refletResetView",
                                                  "refletFinishView",
                                                  "refletViewMemory",
                                                  "refletUseCommandBuffer",
                                                  "refletBeginFrame",
                                                  "refletEndFrame",
                                                  "refletSunShadow",
                                                  "refletLampShadows",
                                                  "refletContactShadows",
                                                  "refletAmbientOcclusion",
                                                  "refletDiffuseGi",
                                                  "refletReflections",
                                                  "refletDenoise",
                                                  "refletComposite",
                                                  "refletTemporal",
                                                  "refletDepthOfField",
                                                  "refletMotionBlur",
                                                  "refletToneMap",
                                                  "refletToneMapTo",
                                                  "refletMissedRays",
                                                  "refletAnswerRays",
                                                  "refletPrepare",
                                                  "refletDescribe",
                                                  "refletPassTimes",
                                                  "refletFindImage",
                                                  "refletCreateRadianceCache",
                                                  "refletDestroyRadianceCache",
                                                  "refletResetRadianceCache"};

}  // namespace

ApiCounts& apiCounts() {
    static ApiCounts counts;
    return counts;
}

const char* apiCallName(size_t call) {
    return names.at(call);
}

void printApiCounts() {
    const ApiCounts& counts = apiCounts();
    std::fprintf(stderr, "%llu sequences\n%-26s %12s %12s\n", static_cast<unsigned long long>(counts.sequences), "",
                 "accepted", "refused");
    for (size_t i = 0; i < apiCalls; ++i) {
        std::fprintf(stderr, "%-26s %12llu %12llu\n", names.at(i),
                     static_cast<unsigned long long>(counts.accepted.at(i)),
                     static_cast<unsigned long long>(counts.refused.at(i)));
    }
}

RefletResult ApiMachine::note(ApiCall call, RefletResult result) {
    ApiCounts& counts = apiCounts();
    ++(result == REFLET_SUCCESS ? counts.accepted : counts.refused).at(static_cast<size_t>(call));
    if (result == REFLET_SUCCESS) {
        return result;
    }
    const std::string_view text = refletLastError();
    if (text.empty() || text.size() > 8100 || text.find('\n') != std::string_view::npos) {
        finding("an error text that is not one line of bounded length");
    }
    if (result == REFLET_ERROR_INTERNAL || result < REFLET_ERROR_INTERNAL || result > 0) {
        finding(refletLastError());
    }
    return result;
}

RefletContext ApiMachine::contextOf(const ContextSlot& slot) {
    const uint8_t which = bytes_.byte();
    if (which >= 252) {
        return nullptr;
    }
    if (which >= 250 && views_[0].alive) {
        return reinterpret_cast<RefletContext>(views_[0].view);
    }
    for (const ContextSlot& other : contexts_) {  // a handle that was destroyed may be given out again
        if (!slot.alive && other.alive && other.context == slot.context) {
            return nullptr;
        }
    }
    return slot.context;
}

RefletView ApiMachine::viewOf(const ViewSlot& slot) {
    const uint8_t which = bytes_.byte();
    if (which >= 254) {
        return which == 254 ? nullptr : reinterpret_cast<RefletView>(contexts_[0].context);
    }
    for (const ViewSlot& other : views_) {
        if (!slot.alive && other.alive && other.view == slot.view) {
            return nullptr;
        }
    }
    return slot.view;
}

ApiMachine::ViewSlot& ApiMachine::anyView() {
    const uint8_t which = bytes_.byte();
    return views_.at(which < 160 ? 0 : which % views_.size());
}

RefletSettings ApiMachine::anySettings() {
    const uint8_t which = bytes_.byte();
    const SettingsSlot& slot = settings_.at(which % settings_.size());
    return settingsOf(slot.alive || which > 230 ? slot : settings_[0]);
}

RefletSettings ApiMachine::settingsOf(const SettingsSlot& slot) {
    const uint8_t which = bytes_.byte();
    if (which >= 254) {
        return which == 254 ? nullptr : reinterpret_cast<RefletSettings>(views_[0].view);
    }
    for (const SettingsSlot& other : settings_) {
        if (!slot.alive && other.alive && other.settings == slot.settings) {
            return nullptr;
        }
    }
    return slot.settings;
}

RefletRadianceCache ApiMachine::cacheOf(const CacheSlot& slot) {
    const uint8_t which = bytes_.byte();
    if (which >= 254) {
        return which == 254 ? nullptr : reinterpret_cast<RefletRadianceCache>(settings_[0].settings);
    }
    for (const CacheSlot& other : caches_) {
        if (!slot.alive && other.alive && other.cache == slot.cache) {
            return nullptr;
        }
    }
    return slot.cache;
}

void ApiMachine::chooseDevice() {
    const uint8_t kind = bytes_.byte();
    wild_ = (kind & 3U) == 3;
    stub::Device device;
    device.cpu = (kind & 4U) != 0;
    device.debugUtils = (kind & 8U) != 0;
    device.writesWithoutFormat = (kind & 16U) == 0;
    device.anisotropy = (kind & 32U) != 0;
    if (kind >= 0xF0) {
        device.storesImages = false;
        device.memory = uint64_t(1) << 30U;
        device.maxImageSide = 4096;
        device.maxStorageBuffer = 1U << 27U;
    }
    stub::setDevice(device);
}

void ApiMachine::run() {
    constexpr uint32_t mostSteps = 24;
    chooseDevice();
    createContext(contexts_[0]);
    createSettings(settings_[0]);
    createView(views_[0]);
    for (uint32_t i = 0; i < mostSteps && !bytes_.done(); ++i) {
        step();
    }
    endAll();
    ++apiCounts().sequences;
    if (const std::string left = stub::leaks(); !left.empty()) {
        finding(("leaked: " + left).c_str());
    }
}

void ApiMachine::step() {
    const uint8_t which = bytes_.byte();
    if (which < 110) {
        wholeFrame(views_[which % 16 == 15 ? 1 : 0]);
    } else if (which < 140) {
        effect(anyView(), bytes_.byte());
    } else if (which < 150) {
        begin(anyView());
    } else if (which < 160) {
        end(anyView());
    } else if (which < 168) {
        stub::failCall(1 + bytes_.byte(),
                       bytes_.chance(128) ? VK_ERROR_OUT_OF_DEVICE_MEMORY : VK_ERROR_OUT_OF_HOST_MEMORY);
    } else if (which < 170) {
        stub::lose(bytes_.chance(128));
    } else {
        manage();
    }
}

void ApiMachine::manage() {
    ViewSlot& view = anyView();
    ContextSlot& context = contexts_[bytes_.below(contexts_.size())];
    SettingsSlot& settings = settings_[bytes_.below(settings_.size())];
    switch (bytes_.below(18)) {
        case 0:
            return createContext(context);
        case 1:
            return destroyContext(context);
        case 2:
            return askContext(context);
        case 3:
            return createSettings(settings);
        case 4:
            return destroySettings(settings);
        case 5:
        case 6:
        case 7:
            return changeSettings(settings);
        case 8:
            return askSettings(settings);
        case 9:
        case 10:
            return createView(view);
        case 11:
            return destroyView(view);
        case 12:
        case 13:
            return changeView(view);
        case 14:
            return askView(view);
        case 15:
        case 16:
            return changeCache(caches_[bytes_.below(caches_.size())]);
        default:
            return bytes_.chance(128) ? prepare(view) : askView(view);
    }
}

// The order of destruction comes from the bytes, too.
void ApiMachine::endAll() {
    stub::failCall(0, VK_SUCCESS);
    if (bytes_.chance(64)) {
        destroyContext(contexts_[0]);
    }
    for (ViewSlot& view : views_) {
        if (view.alive) {
            finishFrames(view, 0);
            refletDestroyView(view.view);
        }
    }
    for (const CacheSlot& cache : caches_) {
        if (cache.alive) {
            refletDestroyRadianceCache(cache.cache);
        }
    }
    for (const ContextSlot& context : contexts_) {
        if (context.alive) {
            refletDestroyContext(context.context);
        }
    }
    for (const SettingsSlot& settings : settings_) {
        if (settings.alive) {
            refletDestroySettings(settings.settings);
        }
    }
    stub::lose(false);
}

}  // namespace reflet::fuzz

#ifdef REFLET_LIBFUZZER
namespace {
struct PrintsCounts {
    ~PrintsCounts() { reflet::fuzz::printApiCounts(); }
} printsCounts;
}  // namespace
#endif

FUZZ_TARGET(api) {
    ApiMachine(bytes, size).run();
    return 0;
}
