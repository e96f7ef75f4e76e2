// What the target of the C API calls, and what it knows of the handles: a host that keeps the rules that a library
// cannot check (frames in flight, memory behind pointers), and breaks all others.
#pragma once

#include "api_bytes.h"
#include "api_fields.h"
#include "stub/host.h"

#include <memory>
#include <vector>

namespace reflet::fuzz {

enum class ApiCall : uint8_t {
    createContext,
    destroyContext,
    contextMemory,
    pipelineCacheData,
    createSettings,
    destroySettings,
    applyPreset,
    setSetting,
    getSetting,
    setSettingNumber,
    getSettingNumber,
    settingInfo,
    createView,
    destroyView,
    resizeView,
    setOutputSize,
    resetView,
    finishView,
    viewMemory,
    useCommandBuffer,
    beginFrame,
    endFrame,
    sunShadow,
    lampShadows,
    contactShadows,
    ambientOcclusion,
    diffuseGi,
    reflections,
    denoise,
    composite,
    temporal,
    depthOfField,
    motionBlur,
    toneMap,
    toneMapTo,
    missedRays,
    answerRays,
    prepare,
    describe,
    passTimes,
    findImage,
    createCache,
    destroyCache,
    resetCache,
};
constexpr size_t apiCalls = 44;

/// Of all sequences so far.
struct ApiCounts {
    uint64_t sequences = 0;
    std::array<uint64_t, apiCalls> accepted{};
    std::array<uint64_t, apiCalls> refused{};
};
ApiCounts& apiCounts();
const char* apiCallName(size_t call);
/// A table on standard error.
void printApiCounts();

class ApiMachine {
public:
    ApiMachine(const uint8_t* bytes, size_t size) : bytes_(bytes, size) {}
    /// Ends with no object left.
    void run();

private:
    struct ContextSlot {
        RefletContext context = nullptr;
        bool alive = false;
    };
    struct ViewSlot {
        RefletView view = nullptr;
        bool alive = false;
        bool inFrame = false;
        bool pending = false;  ///< rays wait for answers
        RefletLobeKind pendingKind = REFLET_LOBE_DIFFUSE;
        uint32_t width = 64;
        uint32_t height = 40;
        uint32_t outputWidth = 0;
        uint32_t outputHeight = 0;
        uint32_t framesInFlight = 1;
        uint32_t frames = 0;
        float angle = 0.0F;
        std::vector<std::vector<VkCommandBuffer>> commands;  ///< of each unfinished frame
        uint32_t drawn[2] = {0, 0};                          ///< RefletFrameInfo::renderSize
    };
    struct SettingsSlot {
        RefletSettings settings = nullptr;
        bool alive = false;
    };

    struct CacheSlot {
        RefletRadianceCache cache = nullptr;
        bool alive = false;
    };

    void chooseDevice();
    void step();
    void manage();
    void wholeFrame(ViewSlot& slot);
    void endAll();

    RefletResult note(ApiCall call, RefletResult result);
    template <class T>
    void spoilSome(T& of);
    template <class T>
    void spoilOut(T& of);
    template <class T>
    T* orNull(T* pointer) {
        return bytes_.chance(wild_ ? 4 : 1) ? nullptr : pointer;
    }

    RefletContext contextOf(const ContextSlot& slot);
    RefletView viewOf(const ViewSlot& slot);
    RefletSettings settingsOf(const SettingsSlot& slot);
    RefletSettings anySettings();
    /// Mostly the first.
    ViewSlot& anyView();

    void createContext(ContextSlot& slot);
    void destroyContext(ContextSlot& slot);
    void askContext(const ContextSlot& slot);
    void createSettings(SettingsSlot& slot);
    void destroySettings(SettingsSlot& slot);
    void changeSettings(const SettingsSlot& slot);
    void askSettings(const SettingsSlot& slot);
    RefletRadianceCache cacheOf(const CacheSlot& slot);
    void changeCache(CacheSlot& slot);
    void createView(ViewSlot& slot);
    void destroyView(ViewSlot& slot);
    void changeView(ViewSlot& slot);
    void askView(const ViewSlot& slot);
    void prepare(const ViewSlot& slot);

    /// The images of a host that draws for this view.
    std::unique_ptr<stub::HostFrame> hostOf(const ViewSlot& slot);
    static void finishFrames(ViewSlot& slot, size_t left);
    void begin(ViewSlot& slot);
    void end(ViewSlot& slot);
    void effect(ViewSlot& slot, uint32_t which);
    void shadow(ViewSlot& slot, ApiCall call, stub::HostFrame& host);
    void lobe(ViewSlot& slot, ApiCall call, stub::HostFrame& host);
    void picture(ViewSlot& slot, ApiCall call, stub::HostFrame& host);
    void toneMap(ViewSlot& slot, ApiCall call, stub::HostFrame& host);
    void spoilLight(stub::HostFrame& host);

    ApiBytes bytes_;
    bool wild_ = false;  ///< most structs are spoiled
    std::array<ContextSlot, 2> contexts_{};
    std::array<ViewSlot, 4> views_{};
    std::array<SettingsSlot, 2> settings_{};
    std::array<CacheSlot, 2> caches_{};
};

template <class T>
void ApiMachine::spoilSome(T& of) {
    const uint8_t which = bytes_.byte();
    const uint8_t calm = wild_ ? 150 : 245;
    for (uint32_t left = which < calm ? 0 : which < 253 ? 1 : 3; left > 0; --left) {
        spoil(of, bytes_);
    }
}

template <class T>
void ApiMachine::spoilOut(T& of) {
    of.structSize = sizeof of;
    if (bytes_.chance(wild_ ? 12 : 1)) {
        of.structSize = bytes_.word();
    }
}

}  // namespace reflet::fuzz
