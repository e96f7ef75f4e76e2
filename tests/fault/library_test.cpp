// Each function of the C API with a Vulkan call in it that fails: the right result, a text that says what failed,
// nothing leaked, and everything works when it is tried again. REFLET_FAULT_ALL: with many calls (tests/fault/all.sh).
#include "fault/effort.h"
#include "fault/layer.h"
#include "fault/sweep.h"
#include "library/library_host.h"

#include <algorithm>
#include <array>
#include <memory>
#include <span>
#include <sstream>

namespace reflet::fault {
namespace {

using test::HostRoom;
using test::LibraryHost;

constexpr uint32_t allEffects =
    (2 * REFLET_EFFECT_DEPTH_OF_FIELD - 1) | REFLET_EFFECT_LAMP_SHADOWS | REFLET_EFFECT_MOTION_BLUR;

/// Calls functions of the library, with the fault in effect, and notes the first failure.
class Caller {
public:
    explicit Caller(Faults& faults) : faults_(faults) {}

    template <class F>
    bool operator()(const char* function, const F& call) {
        faults_.setActive(true);
        const RefletResult result = call();
        faults_.setActive(false);
        ++called_[function];
        if (result != REFLET_SUCCESS) {
            ++failed_[function];
            if (failure == REFLET_SUCCESS) {
                failure = result;
                text = std::string(function) + ": " + refletLastError();
            } else if (result != REFLET_ERROR_INVALID_ARGUMENT && !(result == REFLET_ERROR_VULKAN && stays)) {
                others += std::string(function) + ": " + refletLastError() + "; ";  // more than that a part is missing
            }
        }
        return result == REFLET_SUCCESS;
    }

    bool stays = false;  ///< later calls may fail as the first one did
    RefletResult failure = REFLET_SUCCESS;
    std::string text;
    std::string others;

    static std::map<std::string, int>& called() { return called_; }
    static std::map<std::string, int>& failed() { return failed_; }

private:
    Faults& faults_;
    static inline std::map<std::string, int> called_;
    static inline std::map<std::string, int> failed_;
};

struct Scenario {
    bool ownContext = false;  ///< pipelines are made anew; with few effects, because that takes long
    std::vector<std::byte> display;
};

class FaultyLibrary : public testing::Test {
protected:
    FaultyLibrary() {
        const WithLayer layer;
        host_ = std::make_unique<LibraryHost>();
        faults_ = faultsOfLayer();
        room_ = std::make_unique<HostRoom>(*host_, test::RoomConventions{});
        makeSources();
        const std::vector<uint32_t> black(size_t(HostRoom::width) * HostRoom::height);
        output_ = host_->makeImage(VK_FORMAT_R8G8B8A8_UNORM, HostRoom::width, HostRoom::height, black.data(),
                                   black.size() * sizeof black[0], 1, VK_IMAGE_USAGE_STORAGE_BIT);
    }

    // A probe, a planar view and images of the host's, and a lamp.
    void makeSources() {
        probe_.structSize = sizeof probe_;
        std::ranges::fill(probe_.boxHalfExtents, 4.0F);
        probe_.radiance =
            host_->makeCube(VK_FORMAT_R32G32B32A32_SFLOAT, 16, std::vector<vec4>(size_t(6) * 16 * 16, vec4(1.0F)));
        probe_.distance = probe_.irradiance = probe_.radiance;
        probe_.parallax = REFLET_PARALLAX_DEPTH;
        const RefletFrameInfo frame = room_->frame(VK_NULL_HANDLE, 0);
        planar_.structSize = sizeof planar_;
        planar_.color = room_->light().light;
        planar_.depth = frame.gbuffer->depth;
        std::ranges::copy(frame.worldToView, planar_.worldToView);
        std::ranges::copy(frame.viewToClip, planar_.viewToClip);
        planar_.plane[1] = 1.0F;
        lamp_.structSize = sizeof lamp_;
        lamp_.map = room_->sun().map;
        for (const int i : {0, 5, 11}) {
            lamp_.worldToClip[0][i] = 1.0F;
        }
        lamp_.worldToClip[0][14] = 0.1F;
    }

    RefletIndirectLight lightOfAllKinds() const {
        RefletIndirectLight light = room_->light();
        light.specularFallback = light.irradiance = light.light;
        light.probes = &probe_;
        light.probeCount = 1;
        light.planarViews = &planar_;
        light.planarViewCount = 1;
        return light;
    }

    void SetUp() override {
        ASSERT_NE(faults_, nullptr) << "the layer is not loaded";
        faults_->setActive(false);
        atFirst_ = faults_->alive();
        shared_ = host_->makeContext();
    }
    void TearDown() override {
        if (shared_ != nullptr) {
            refletDestroyContext(shared_);
            EXPECT_EQ(faults_->alive(), atFirst_);
        }
    }

    RefletContext createContext(Caller& call) {
        RefletContextInfo info = host_->contextInfo();
        const char* extension = VK_EXT_DEBUG_UTILS_EXTENSION_NAME;
        info.enabledExtensions = &extension;
        info.enabledExtensionCount = 1;
        RefletContext context = nullptr;
        call("refletCreateContext", [&] { return refletCreateContext(&info, &context); });
        if (context == nullptr) {
            EXPECT_REFLET(refletCreateContext(&info, &context));
        }
        return context;
    }

    RefletView createView(Caller& call, RefletContext context) {
        const RefletViewInfo info{
            sizeof info, HostRoom::width, HostRoom::height, test::Host::framesInFlight, REFLET_VIEW_PASS_TIMES, 0};
        RefletView view = nullptr;
        call("refletCreateView", [&] { return refletCreateView(context, &info, &view); });
        if (view == nullptr) {
            EXPECT_REFLET(refletCreateView(context, &info, &view));
        }
        return view;
    }

    void prepare(Caller& call, RefletView view, RefletSettings settings) {
        const RefletFrameInfo frame = room_->frame(VK_NULL_HANDLE, 0);
        RefletPrepareInfo info{};
        info.structSize = sizeof info;
        info.effects = allEffects;
        info.gbuffer = frame.gbuffer;
        info.autoExposure = 1;
        const RefletIndirectLight light = lightOfAllKinds();
        info.light = &light;
        info.lampMapSide = 64;
        uint32_t left = 0;
        call("refletPrepare", [&] { return refletPrepare(view, settings, &info, 1000, &left); });
    }

    /// Returns the display image; none if something failed.
    RefletImage frame(Caller& call, RefletView view, RefletSettings settings, uint32_t index, bool few) {
        RefletImage display{};
        host_->host.frame([&](VkCommandBuffer commands) {
            const RefletFrameInfo info = room_->frame(commands, index);
            if (!call("refletBeginFrame", [&] { return refletBeginFrame(view, &info); })) {
                return;
            }
            call("refletUseCommandBuffer", [&] { return refletUseCommandBuffer(view, commands); });
            effects(call, view, settings, {few, index % 2 == 1}, display);
            call("refletEndFrame", [&] { return refletEndFrame(view); });
        });
        return display;
    }

    // few: no more than the picture needs. denoises: the reflections are the host's.
    struct Effects {
        bool few;
        bool denoises;
    };
    void effects(Caller& call, RefletView view, RefletSettings settings, const Effects& some, RefletImage& display) {
        RefletImage image{};
        RefletLobe lobe = test::emptyLobe();
        RefletComposite sum{};
        sum.structSize = sizeof sum;
        const RefletIndirectLight light = lightOfAllKinds();
        const RefletSunShadow sun = room_->sun();
        const RefletLens lens{sizeof lens, 0.2F, 3.0F, 6, 0.1F};
        if (!some.few) {
            call("refletSunShadow", [&] { return refletSunShadow(view, settings, &sun, &image); });
            call("refletLampShadows", [&] { return refletLampShadows(view, settings, &lamp_, 1, &image); });
            call("refletAmbientOcclusion", [&] { return refletAmbientOcclusion(view, settings, &image); });
            call("refletDiffuseGi", [&] { return refletDiffuseGi(view, settings, &light, &lobe); });
            if (some.denoises) {
                call("refletDenoise",
                     [&] { return refletDenoise(view, settings, REFLET_LOBE_SPECULAR, &light.light, &lobe); });
            } else {
                call("refletReflections", [&] { return refletReflections(view, settings, &light, &lobe); });
            }
        }
        call("refletComposite", [&] { return refletComposite(view, settings, &light.light, &sum); });
        if (!some.few) {
            call("refletTemporal", [&] { return refletTemporal(view, settings, nullptr, &image); });
            call("refletDepthOfField", [&] { return refletDepthOfField(view, settings, &lens, nullptr, &image); });
            call("refletMotionBlur", [&] { return refletMotionBlur(view, settings, nullptr, &image); });
            RefletToneMapInfo to{};
            to.structSize = sizeof to;
            to.autoExposure = 1;
            to.output = &output_;
            RefletDisplay shown{sizeof shown, {}, {}};
            call("refletToneMapTo", [&] { return refletToneMapTo(view, settings, &to, &shown); });
            to.output = nullptr;
            to.transfer = REFLET_TRANSFER_PQ;
            call("refletToneMapTo", [&] { return refletToneMapTo(view, settings, &to, &shown); });
        }
        call("refletToneMap", [&] { return refletToneMap(view, settings, nullptr, 1, &display); });
    }

    void lookAt(Caller& call, RefletContext context, RefletView view) {
        uint64_t bytes = 0;
        uint32_t count = 0;
        RefletImage depth{};
        call("refletPassTimes", [&] { return refletPassTimes(view, &count, nullptr); });
        call("refletFindImage", [&] { return refletFindImage(view, "depth", &depth); });
        call("refletViewMemory", [&] { return refletViewMemory(view, &bytes); });
        call("refletContextMemory", [&] { return refletContextMemory(context, &bytes); });
    }

    /// A view's life. Returns the display image of a frame that comes after the failure and must succeed.
    std::vector<std::byte> live(Caller& call, const Scenario& scenario) {
        const bool few = scenario.ownContext;
        RefletContext context = few ? createContext(call) : shared_;
        RefletSettings settings = nullptr;
        call("refletCreateSettings", [&] { return refletCreateSettings("balanced", &settings); });
        EXPECT_REFLET(refletSetSetting(settings, "ao.method", "horizon"));
        RefletView view = createView(call, context);
        if (!few) {
            prepare(call, view, settings);
        }
        for (uint32_t i = 0; i < 2; ++i) {
            frame(call, view, settings, i, few);
        }
        call("refletResizeView", [&] { return refletResizeView(view, HostRoom::width, HostRoom::height); });
        call("refletResetView", [&] { return refletResetView(view); });
        lookAt(call, context, view);
        host_->host.waitForAll();
        call("refletFinishView", [&] { return refletFinishView(view); });
        for (size_t i = 0; i < functionCount; ++i) {
            calls_.at(i) = faults_->calls(static_cast<Function>(i));
        }
        std::vector<std::byte> shown;
        if (!call.stays) {
            Caller again(*faults_);
            const RefletImage display = frame(again, view, settings, 0, few);
            EXPECT_EQ(again.failure, REFLET_SUCCESS) << "again: " << again.text;
            host_->host.waitForAll();
            if (display.image != VK_NULL_HANDLE) {
                shown = host_->read(display, 4);
            }
        }
        refletDestroyView(view);
        refletDestroySettings(settings);
        if (few) {
            refletDestroyContext(context);
        }
        return shown;
    }

    void check(const Scenario& scenario, const Fault& fault) {
        const std::string before = aliveOfViews();
        faults_->arm(fault);
        Caller call(*faults_);
        call.stays = fault.result == VK_ERROR_DEVICE_LOST;
        const std::vector<std::byte> shown = live(call, scenario);
        const std::string what = textOf(fault) + ": " + call.text;
        EXPECT_GT(faults_->hits(), 0U) << what;
        EXPECT_EQ(aliveOfViews(), before) << what;
        EXPECT_EQ(faults_->misuses(), "") << what;
        EXPECT_EQ(call.others, "") << what;
        if (!call.stays) {
            EXPECT_TRUE(shown == scenario.display) << what << ": another picture afterwards";
        }
        if (call.failure != REFLET_SUCCESS) {
            const RefletResult wanted =
                fault.result == VK_ERROR_DEVICE_LOST ? REFLET_ERROR_VULKAN : REFLET_ERROR_OUT_OF_MEMORY;
            EXPECT_EQ(call.failure, wanted) << what;
            EXPECT_NE(call.text.find(wordsOf(fault.result)), std::string::npos) << what;
        } else {  // only these have another way
            EXPECT_TRUE(fault.function == f_vkAllocateDescriptorSets ||
                        fault.function == f_vkSetDebugUtilsObjectNameEXT)
                << what;
        }
    }

    void sweepOver(Scenario scenario, std::span<const Function> wanted) {
        faults_->arm(std::nullopt);
        Caller call(*faults_);
        scenario.display = live(call, scenario);
        ASSERT_EQ(call.failure, REFLET_SUCCESS) << call.text;
        if (!scenario.ownContext) {  // pipelines exist by now
            faults_->arm(std::nullopt);
            scenario.display = live(call, scenario);
        }
        std::map<std::string, uint64_t> calls;
        for (const Function function : wanted) {
            if (calls_.at(function) > 0) {
                calls[functions.at(function).name] = calls_.at(function);
            }
        }
        ASSERT_FALSE(calls.empty());
        const std::vector<Fault> faults = plan(calls);
        for (const Fault& fault : faults) {
            check(scenario, fault);
        }
        EXPECT_TRUE(host_->host.messages().empty()) << host_->host.messages().front();
        if (testsAll()) {
            std::printf("%zu faults; failures and calls:\n", faults.size());
            for (const auto& [function, count] : Caller::called()) {
                std::printf("  %-30s %6d of %d\n", function.c_str(), Caller::failed()[function], count);
            }
        }
    }

    /// What is alive without the pipelines and samplers of contexts: a frame without a part has other pipelines.
    [[nodiscard]] std::string aliveOfViews() const {
        std::istringstream all(faults_->alive());
        std::string kept;
        for (std::string one; std::getline(all, one, ',');) {
            const bool ofContext = one.find("Pipeline") != std::string::npos ||
                                   one.find("SetLayout") != std::string::npos ||
                                   one.find("Sampler") != std::string::npos;
            kept += ofContext ? "" : one + ",";
        }
        return kept;
    }

    std::unique_ptr<LibraryHost> host_;
    std::unique_ptr<HostRoom> room_;
    RefletProbe probe_{};
    RefletPlanarView planar_{};
    RefletLampShadow lamp_{};
    RefletImage output_{};
    Faults* faults_ = nullptr;
    RefletContext shared_ = nullptr;
    std::string atFirst_;                          ///< alive before there was a context
    std::array<uint64_t, functionCount> calls_{};  ///< of each function until the frame after the failure
};

TEST_F(FaultyLibrary, FailuresOfImagesBuffersAndDescriptorsAreReported) {
    sweepOver({}, std::array{f_vkAllocateMemory, f_vkMapMemory, f_vkCreateBuffer, f_vkBindBufferMemory, f_vkCreateImage,
                             f_vkBindImageMemory, f_vkCreateImageView, f_vkCreateDescriptorPool,
                             f_vkAllocateDescriptorSets, f_vkCreateQueryPool, f_vkGetQueryPoolResults});
}

TEST_F(FaultyLibrary, FailuresOfPipelinesAreReported) {
    sweepOver({.ownContext = true},
              std::array{f_vkCreateDescriptorSetLayout, f_vkCreatePipelineLayout, f_vkCreateShaderModule,
                         f_vkCreateComputePipelines, f_vkCreateSampler, f_vkSetDebugUtilsObjectNameEXT});
}

}  // namespace
}  // namespace reflet::fault
