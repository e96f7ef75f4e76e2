// The objects behind the handles of the C API.
#pragma once

#include "api/settings.h"
#include "gpu/context.h"
#include "gpu/recorder.h"
#include "lighting/direct.h"
#include "lighting/environment.h"
#include "lighting/host_images.h"
#include "lighting/host_sources.h"
#include "lighting/indirect.h"
#include "lighting/picture.h"

#include "reflet/reflet.h"

#include <array>
#include <cstdint>
#include <deque>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

struct RefletContext_T {
    std::mutex mutex;  ///< of `owned` and `destroyed`
    std::unique_ptr<reflet::gpu::Context> gpu;
    uint32_t owned = 0;      ///< number of views and radiance caches that hold it
    bool destroyed = false;  ///< by the host
    void (*log)(void* user, RefletResult result, const char* text) = nullptr;
    void* logUser = nullptr;
};

struct RefletSettings_T {
    reflet::api::Settings values;
};

struct RefletRadianceCache_T {
    std::shared_ptr<RefletContext_T> keeps;  ///< the owner, unless this is a stand-in
    std::mutex mutex;                        ///< of all below, while a lobe is recorded
    reflet::RadianceCache table;
    reflet::CacheBuffers current;             ///< of the frame that was begun last
    std::optional<uint32_t> frame;            ///< RefletFrameInfo::frameIndex of that one; none: there was none
    const RefletView_T* settledBy = nullptr;  ///< the view that began it; only compared, never dereferenced
};

namespace reflet::api {

/// The environment's image and the maps made from it.
struct EnvironmentImages {
    gpu::KeptImage texels{"environment"};
    CubeMap cube;
    uint64_t revision = 0;
    VkImageView from = VK_NULL_HANDLE;
    uint64_t generation = UINT64_MAX;  ///< of the recorder when they were made
    uint64_t list = 0;                 ///< whose passes make them
};

/// The maps of the host's probes.
struct ProbeImages {
    HostProbeStore maps;
    std::vector<std::byte> key;  ///< the inputs that they were made from; empty: none
    uint64_t list = 0;           ///< whose passes make them
};

/// The environment that a lobe was given last.
struct KnownEnvironment {
    VkImageView from = VK_NULL_HANDLE;
    uint64_t revision = 0;
    vec3 factor{0.0F};
    vec2 turn{0.0F};

    bool operator==(const KnownEnvironment&) const = default;
};

/// Persistent state of a view: histories and other resources that outlive a frame.
struct ViewStore {
    gpu::KeptBuffer blueNoise{"blue_noise"};
    gpu::KeptImage ggxTable{"ggx_table"};
    EnvironmentImages environment;
    ProbeImages probes;
    gpu::HistoryImage sunVisibility{"shadow_clean.history"};
    DenoiseStore ambientOcclusion;
    LobeStore diffuse;
    LobeStore specular;
    gpu::HistoryImage lit{"lit"};
    TemporalStore temporal;
    lighting::DofHistory lens;
    gpu::HistoryImage exposure{"exposure"};
    LightBoundStore lightPeaks;                ///< of the light that lobes and the composite are given, and their sum
    std::array<LightBoundStore, 2> lobePeaks;  ///< of lobes that the host has traced
    LightBoundStore colorPeaks;                ///< of what refletTemporal is given
    std::array<std::optional<KnownEnvironment>, 2> environments;  ///< of the lobes
    uint64_t lastGeneration = UINT64_MAX;                         ///< of the recorder in the last frame
    uint32_t environmentRests = UINT32_MAX / 2;                   ///< frames that began since one of them changed

    LobeStore& of(uint32_t lobe) { return lobe == lobeDiffuse ? diffuse : specular; }
};

/// State and results of the current frame so far.
struct Frame : lighting::Surfaces {
    lighting::ViewContext context;    ///< its environment is that of the last lobe
    std::optional<LightBound> bound;  ///< of `light` and `composed`
    gpu::Image light;                 ///< given to the lobes
    gpu::History lit;                 ///< swapped by the first effect that reads or writes it
    gpu::Image composed;
    gpu::Image antialiased;
    gpu::Image sharp;  ///< input of the first of depth of field and motion blur
    gpu::Image defocused;
    gpu::Image circleOfConfusion;
    gpu::Image blurred;  ///< of the last refletMotionBlur
    gpu::Image velocityTiles;
    gpu::Image sunVisibility;
    gpu::Image lampVisibility;                                   ///< of the last refletLampShadows
    uint32_t lamps = 0;                                          ///< of it
    std::array<gpu::Image, REFLET_MAX_CONTACT_LIGHTS> contacts;  ///< of refletContactShadows, in order
    uint32_t contactCount = 0;
    gpu::Image display;
    gpu::Image exposure;                   ///< as a factor; none if nobody asked for it
    float preExposure = 1.0F;              ///< RefletFrameInfo::preExposure
    std::optional<DisplayTarget> shownOn;  ///< of the last tone map
    std::optional<LobeLight> diffuse;
    std::optional<LobeLight> specular;
    std::optional<lighting::PendingLobe> pending;         ///< whose rays wait for the host's answers
    lighting::HostLight pendingLight;                     ///< of the host's for these rays, without mirrors
    std::shared_ptr<RefletRadianceCache_T> pendingCache;  ///< that their light is for; may be none
    uint32_t probes = 0;                                  ///< given to the last lobe
    uint32_t planarViews = 0;                             ///< given to the last lobe
    bool hasFallback = false;  ///< RefletIndirectLight::specularFallback or irradiance was given
    float elapsed = 0.0F;
    reflet::lighting::Change change;
    uvec2 size{0};                  ///< RefletFrameInfo::renderSize, or the view's
    bool inLarger = false;          ///< its images may be larger
    bool showsEnvironment = false;  ///< RefletFrameInfo::backgroundIsEnvironment
    vec2 jitter{0.0F};
};

/// A frame's parameters as the host gave them, for refletDescribe. Its pointers may dangle: do not dereference them.
struct Described {
    RefletFrameInfo info{};
    RefletGBuffer gbuffer{};
    uvec2 outputSize{0};
    float lastPreExposure = 1.0F;
    uint64_t frames = 0;  ///< before it
    uint32_t lastIndex = 0;
    std::array<float, 2> lastJitter{};
};

}  // namespace reflet::api

struct RefletView_T {
    RefletView_T(RefletContext_T& context, uint32_t framesInFlight, bool timed)
        : owner(context),
          memory(std::make_shared<VkDeviceSize>(0)),
          recorder(*context.gpu, framesInFlight, timed),
          timesPasses(timed) {}

    std::shared_ptr<RefletContext_T> keeps;  ///< the owner, unless this is a view of a call's own
    RefletContext_T& owner;
    std::mutex mutex;
    bool destroyed = false;                ///< by the host
    std::shared_ptr<VkDeviceSize> memory;  ///< bytes in use
    reflet::gpu::Recorder recorder;
    bool timesPasses;                    ///< REFLET_VIEW_PASS_TIMES
    uint32_t seed = 0;                   ///< RefletViewInfo::viewIndex
    reflet::uvec2 size{0};               ///< the largest of its frames
    reflet::uvec2 renderSize{0};         ///< of the current or last frame
    uint32_t steadyFrames = UINT32_MAX;  ///< frames before that one since the size changed; UINT32_MAX: it never did
    reflet::uvec2 outputSize{0};         ///< of refletTemporal's pictures; 0: as size
    VkCommandBuffer commands = VK_NULL_HANDLE;  ///< of the current frame
    std::unique_ptr<reflet::api::ViewStore> store;
    std::optional<reflet::api::Frame> frame;  ///< between begin and end
    std::optional<reflet::api::Frame> last;   ///< that has ended, for refletFindImage
    std::deque<reflet::gpu::ImageState>
        hostImages;  ///< of the current frame; a deque, as pointers to elements are kept
    std::optional<reflet::api::Described> described;
    std::vector<std::string> contradictions;  ///< reported to the host already
    std::string note;                         ///< for the host's log when the call ends
    float preExposure = 1.0F;                 ///< of the current or last frame
    bool composedLast = false;                ///< whether the last frame wrote ViewStore::lit
};
