// Every argument of the C API wrong in turn: the right error, whose text names the field; nothing recorded, nothing
// leaked.
#include "library/arguments_fixture.h"

#include <algorithm>
#include <cmath>

namespace reflet::test {
namespace {

TEST_F(Arguments, OfAContext) {
    const auto expect = [&](const std::string& field, const std::function<void(RefletContextInfo&)>& spoil,
                            RefletResult wanted = REFLET_ERROR_INVALID_ARGUMENT) {
        RefletContextInfo info = host_.contextInfo();
        spoil(info);
        RefletContext context = reinterpret_cast<RefletContext>(1);
        expectError(refletCreateContext(&info, &context), field, wanted);
        EXPECT_EQ(context, nullptr);
    };
    expect("structSize", [](auto& i) { i.structSize = 0; });
    expect(
        "structSize", [](auto& i) { i.structSize = sizeof i + 8; }, REFLET_ERROR_INCOMPATIBLE_VERSION);
    expect("version", [](auto& i) { i.version = 0; });
    expect(
        "version", [](auto& i) { i.version = REFLET_VERSION + 1; }, REFLET_ERROR_INCOMPATIBLE_VERSION);
    expect(
        "version", [](auto& i) { i.version = REFLET_MAKE_VERSION(9, 0, 0); }, REFLET_ERROR_INCOMPATIBLE_VERSION);
    expect("instance", [](auto& i) { i.instance = nullptr; });
    expect("physicalDevice", [](auto& i) { i.physicalDevice = nullptr; });
    expect("device", [](auto& i) { i.device = nullptr; });
    expect("getInstanceProcAddr", [](auto& i) { i.getInstanceProcAddr = nullptr; });
    expect("enabledFeatures", [](auto& i) { i.enabledFeatures = nullptr; });
    expect("enabledExtensions", [](auto& i) { i.enabledExtensionCount = 1; });
    static RefletMemoryCallbacks none{};
    expect("memory.structSize", [](auto& i) { i.memory = &none; });
    static RefletMemoryCallbacks half{sizeof half, nullptr, nullptr, nullptr};
    expect("memory: allocate", [](auto& i) { i.memory = &half; });
    expect("pipelineCacheData", [](auto& i) { i.pipelineCacheDataSize = 8; });
    expect(
        "version", [](auto& i) { i.version = REFLET_MAKE_VERSION(0, 1, 0); }, REFLET_ERROR_INCOMPATIBLE_VERSION);
    static VkPhysicalDeviceFeatures2 features{};
    for (const char* field :
         {"shaderStorageImageExtendedFormats", "imageCubeArray", "scalarBlockLayout", "synchronization2"}) {
        VkPhysicalDeviceVulkan13Features v13{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_3_FEATURES};
        VkPhysicalDeviceVulkan12Features v12{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_2_FEATURES, &v13};
        features = {VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_FEATURES_2, &v12};
        const auto on = [&](const char* name) { return std::string(name) != field ? VK_TRUE : VK_FALSE; };
        v13.synchronization2 = on("synchronization2");
        v12.scalarBlockLayout = on("scalarBlockLayout");
        features.features.shaderStorageImageExtendedFormats = on("shaderStorageImageExtendedFormats");
        features.features.imageCubeArray = on("imageCubeArray");
        expect(
            field, [](auto& i) { i.enabledFeatures = &features; }, REFLET_ERROR_MISSING_FEATURE);
    }
    RefletContextInfo info = host_.contextInfo();
    expectError(refletCreateContext(&info, nullptr), "context");
    RefletContext context = nullptr;
    expectError(refletCreateContext(nullptr, &context), "RefletContextInfo");
    // A device without a function that is needed.
    static PFN_vkGetInstanceProcAddr real = nullptr;
    real = info.getInstanceProcAddr;
    static PFN_vkGetDeviceProcAddr realDevice = nullptr;
    info.getInstanceProcAddr = [](VkInstance instance, const char* name) -> PFN_vkVoidFunction {
        const PFN_vkVoidFunction found = real(instance, name);
        if (std::string_view(name) != "vkGetDeviceProcAddr") {
            return found;
        }
        realDevice = reinterpret_cast<PFN_vkGetDeviceProcAddr>(found);
        const PFN_vkGetDeviceProcAddr without = [](VkDevice device, const char* wanted) -> PFN_vkVoidFunction {
            return std::string_view(wanted).starts_with("vkCmdDispatchIndirect") ? nullptr : realDevice(device, wanted);
        };
        return reinterpret_cast<PFN_vkVoidFunction>(without);
    };
    expectError(refletCreateContext(&info, &context), "vkCmdDispatchIndirect", REFLET_ERROR_MISSING_FEATURE);
}

TEST_F(Arguments, OfAView) {
    const auto expect = [&](const std::string& field, const RefletViewInfo& info) {
        RefletView view = reinterpret_cast<RefletView>(1);
        expectError(refletCreateView(context_, &info, &view), field);
        EXPECT_EQ(view, nullptr);
    };
    expect("structSize", {0, 8, 8, 1, 0, 0});
    expect("flags", {sizeof(RefletViewInfo), 8, 8, 1, 2, 0});
    expect("viewIndex", {sizeof(RefletViewInfo), 8, 8, 1, 0, REFLET_MAX_VIEW_INDEX});
    expect("width", {sizeof(RefletViewInfo), 0, 8, 1, 0, 0});
    expect("height", {sizeof(RefletViewInfo), 8, 20000, 1, 0, 0});
    expect("framesInFlight", {sizeof(RefletViewInfo), 8, 8, 0, 0, 0});
    expect("framesInFlight", {sizeof(RefletViewInfo), 8, 8, 5, 0, 0});
    const RefletViewInfo info{sizeof info, 8, 8, 1, 0, 0};
    RefletView view = nullptr;
    expectError(refletCreateView(nullptr, &info, &view), "context");
    expectError(refletCreateView(context_, &info, nullptr), "view");
    expectError(refletResizeView(view_, 0, 4), "width");
    expectError(refletResizeView(nullptr, 4, 4), "view");
    expectError(refletSetOutputSize(view_, 0, 4), "width");
    expectError(refletSetOutputSize(view_, 4, 20000), "height");
    expectError(refletSetOutputSize(nullptr, 4, 4), "view");
    expectError(refletViewMemory(view_, nullptr), "bytes");
    expectError(refletFindImage(view_, "depth", nullptr), "image");
    RefletImage image{};
    expectError(refletFindImage(view_, "depth", &image), "no frame");
    expectError(refletEndFrame(view_), "no frame has begun");
    refletDestroyView(nullptr);
    refletDestroyContext(nullptr);
    refletDestroySettings(nullptr);
}

TEST_F(Arguments, OfAFrame) {
    expectFrameError("structSize", [](auto& i) { i.structSize = 1; });
    expectFrameError(
        "structSize", [](auto& i) { i.structSize += 8; }, REFLET_ERROR_INCOMPATIBLE_VERSION);
    expectFrameError("commandBuffer", [](auto& i) { i.commandBuffer = nullptr; });
    expectFrameError("worldToView", [](auto& i) { i.worldToView[3] = NAN; });
    expectFrameError("worldToView", [](auto& i) { i.worldToView[0] = 3.0F; });
    expectFrameError("viewToClip", [](auto& i) { i.viewToClip[0] = 0.0F; });
    expectFrameError("viewToClip", [](auto& i) { i.viewToClip[5] = INFINITY; });
    expectFrameError("gbuffer", [](auto& i) { i.gbuffer = nullptr; });
    expectFrameError("worldToView", [](auto& i) { i.worldToView[3] = 0.5F; });
    expectFrameError("worldToView", [](auto& i) { i.worldToView[12] = 1e38F; });
    expectFrameError("previousViewToClip", [](auto& i) { i.previousWorldToView[0] = 1.0F; });
    expectFrameError("previousWorldToView", [](auto& i) { std::ranges::copy(i.viewToClip, i.previousViewToClip); });
    expectFrameError("viewToClip", [](auto& i) { i.viewToClip[14] = 1e-44F; });
    expectFrameError("viewToClip", [](auto& i) { i.viewToClip[0] = 1e38F; });
    expectFrameError("it is transposed", [](auto& i) { std::swap(i.viewToClip[11], i.viewToClip[14]); });
    expectFrameError("has the jitter in it", [](auto& i) {
        i.jitter[0] = 0.25F;
        i.jitter[1] = -0.25F;
        i.viewToClip[8] = 2.0F * 0.25F / HostRoom::width;
        i.viewToClip[9] = -2.0F * 0.25F / HostRoom::height;
    });
    expectFrameError("clipYUp", [](auto& i) { i.clipYUp = 5; });
    expectFrameError("clipDepthFromMinusOne", [](auto& i) { i.clipDepthFromMinusOne = 2; });
    expectFrameError("elapsed", [](auto& i) { i.elapsed = NAN; });
    expectFrameError("jitter", [](auto& i) { i.jitter[1] = 3.0F; });
    expectFrameError("lightChange", [](auto& i) { i.lightChange = 1.5F; });
    expectFrameError("previousJitter", [](auto& i) { i.previousJitter[0] = NAN; });
    using G = RefletGBuffer;
    const std::pair<const char*, RefletImage G::*> images[] = {{"gbuffer.depth", &G::depth},
                                                               {"gbuffer.normal", &G::normal},
                                                               {"gbuffer.roughness", &G::roughness},
                                                               {"gbuffer.metallic", &G::metallic},
                                                               {"gbuffer.baseColor", &G::baseColor},
                                                               {"gbuffer.motion", &G::motion},
                                                               {"gbuffer.geometricNormal", &G::geometricNormal},
                                                               {"gbuffer.f0", &G::f0},
                                                               {"gbuffer.backDepth", &G::backDepth},
                                                               {"gbuffer.excluded", &G::excluded},
                                                               {"gbuffer.unlit", &G::unlit},
                                                               {"gbuffer.reactive", &G::reactive}};
    for (const auto& [name, member] : images) {
        const std::string field = name;
        const auto spoil = [&, at = member](const std::function<void(RefletImage&)>& change) {
            return [=](G& g) {
                if ((g.*at).image == VK_NULL_HANDLE) {
                    g.*at = at == &G::backDepth ? g.depth : g.normal;
                }
                change(g.*at);
            };
        };
        expectGBufferError(field + ".view", spoil([](RefletImage& i) { i.view = VK_NULL_HANDLE; }));
        expectGBufferError(field + ".format", spoil([](RefletImage& i) { i.format = VK_FORMAT_R32_UINT; }));
        expectGBufferError(field + ".width", spoil([](RefletImage& i) { i.width += 1; }));
        expectGBufferError(field + ".width", spoil([](RefletImage& i) { i.height = 0; }));
        expectGBufferError(field + ".layout", spoil([](RefletImage& i) { i.layout = VK_IMAGE_LAYOUT_UNDEFINED; }));
        expectGBufferError(field + ".layout", spoil([](RefletImage& i) { i.layout = VkImageLayout(77); }));
        expectGBufferError(field + ".baseLevel", spoil([](RefletImage& i) { i.baseLevel = 99; }));
        expectGBufferError(field + ".reserved", spoil([](RefletImage& i) { i.reserved[2] = 1; }));
    }
    expectGBufferError("gbuffer.depth", [](auto& g) { g.depth.image = VK_NULL_HANDLE; });
    expectGBufferError("gbuffer.normal", [](auto& g) { g.normal.image = VK_NULL_HANDLE; });
    expectGBufferError("depthKind", [](auto& g) { g.depthKind = RefletDepthKind(7); });
    expectGBufferError("normalKind", [](auto& g) { g.normalKind = RefletNormalKind(4); });
    expectGBufferError("roughnessKind", [](auto& g) { g.roughnessKind = RefletRoughnessKind(9); });
    expectGBufferError("baseColorKind", [](auto& g) { g.baseColorKind = RefletColorKind(2); });
    expectGBufferError("motionKind", [](auto& g) { g.motionKind = RefletMotionKind(3); });
    expectGBufferError("roughnessChannel", [](auto& g) { g.roughnessChannel = 4; });
    expectGBufferError("metallicChannel", [](auto& g) { g.metallicChannel = 99; });
    expectGBufferError("excludedChannel", [](auto& g) { g.excludedChannel = 4; });
    expectGBufferError("unlitChannel", [](auto& g) { g.unlitChannel = 4; });
    expectGBufferError("reactiveChannel", [](auto& g) { g.reactiveChannel = 4; });
    expectGBufferError("structSize", [](auto& g) { g.structSize = 8; });
    expectGBufferError("depth.format: is R8G8B8A8_UNORM", [](auto& g) { g.depth.format = VK_FORMAT_R8G8B8A8_UNORM; });
    expectGBufferError("normal.format: is D32_SFLOAT", [](auto& g) { g.normal.format = VK_FORMAT_D32_SFLOAT; });
    expectGBufferError("normal.format: is R8_UNORM", [](auto& g) { g.normal.format = VK_FORMAT_R8_UNORM; });
    expectGBufferError("metallic.format: is R32_SFLOAT", [](auto& g) {
        g.metallic.format = VK_FORMAT_R32_SFLOAT;
        g.metallicChannel = 3;
    });
    expectGBufferError("motionScale", [](auto& g) { g.motionScale[1] = INFINITY; });
    expectGBufferError("motionScale", [](auto& g) { g.motionScale[0] = 1.0F; });
    expectGBufferError("normalsInViewSpace", [](auto& g) { g.normalsInViewSpace = 5; });
    expectGBufferError("motionIncludesJitter", [](auto& g) { g.motionIncludesJitter = 2; });
    expectGBufferError("depthKind: is REFLET_DEPTH_STANDARD", [](auto& g) { g.depthKind = REFLET_DEPTH_STANDARD; });
    EXPECT_EQ(LibraryHost::made().images, 0U) << "nothing was recorded";
}

// Once for each view, though each frame has it.
TEST_F(Arguments, AContradictionIsLogged) {
    RefletContextInfo info = host_.contextInfo();
    std::vector<std::string> logged;
    info.logUser = &logged;
    info.log = [](void* user, RefletResult result, const char* text) {
        EXPECT_EQ(result, REFLET_SUCCESS);
        static_cast<std::vector<std::string>*>(user)->emplace_back(text);
    };
    RefletContext context = nullptr;
    EXPECT_REFLET(refletCreateContext(&info, &context));
    const RefletViewInfo size{sizeof size, HostRoom::width, HostRoom::height, 1, 0, 0};
    RefletView view = nullptr;
    EXPECT_REFLET(refletCreateView(context, &size, &view));
    for (uint32_t i = 0; i < 3; ++i) {
        host_.host.frame([&](VkCommandBuffer commands) {
            const RefletFrameInfo frame = room_.frame(commands, 7);  // the same number
            EXPECT_REFLET(refletBeginFrame(view, &frame));
            EXPECT_REFLET(refletEndFrame(view));
        });
        host_.host.waitForAll();
    }
    ASSERT_EQ(logged.size(), 1U);
    EXPECT_NE(logged[0].find("frameIndex is that of the last frame"), std::string::npos) << logged[0];
    refletDestroyView(view);
    refletDestroyContext(context);
}

TEST_F(Arguments, SettingsOfTheHostsOwnWorkAreNotListed) {
    std::vector<std::string> names;
    for (uint32_t i = 0; i < refletSettingCount(); ++i) {
        RefletSettingInfo info{};
        info.structSize = sizeof info;
        EXPECT_REFLET(refletSettingInfo(i, &info));
        names.emplace_back(info.name);
    }
    EXPECT_NE(std::ranges::find(names, "temporal.frames"), names.end());
    for (const char* name : {"temporal.enabled", "temporal.scale", "shadow.resolution", "shadow.extent"}) {
        EXPECT_EQ(std::ranges::find(names, name), names.end()) << name;
        EXPECT_NE(refletGetSetting(settings_, name), nullptr) << "a preset may have it";
    }
}

TEST_F(Arguments, AnErrorIsLogged) {
    RefletContextInfo info = host_.contextInfo();
    std::string logged;
    info.logUser = &logged;
    info.log = [](void* user, RefletResult, const char* text) { *static_cast<std::string*>(user) = text; };
    RefletContext context = nullptr;
    EXPECT_REFLET(refletCreateContext(&info, &context));
    const RefletViewInfo size{sizeof size, 8, 8, 1, 0, 0};
    RefletView view = nullptr;
    EXPECT_REFLET(refletCreateView(context, &size, &view));
    EXPECT_EQ(refletEndFrame(view), REFLET_ERROR_INVALID_ARGUMENT);
    EXPECT_EQ(logged, refletLastError());
    refletDestroyView(view);
    refletDestroyContext(context);
}

}  // namespace
}  // namespace reflet::test
