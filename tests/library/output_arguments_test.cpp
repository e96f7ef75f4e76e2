// Every argument of tone maps, offsets, queues and command buffers wrong in turn.
#include "library/arguments_fixture.h"

#include <cmath>

namespace reflet::test::output_arguments_test {
namespace {

class OutputArguments : public Arguments {
protected:
    void expectToneMapError(const std::string& part, const std::function<void(RefletToneMapInfo&)>& spoil,
                            RefletResult wanted = REFLET_ERROR_INVALID_ARGUMENT) {
        RefletToneMapInfo info{};
        info.structSize = sizeof info;
        info.color = &color_;
        spoil(info);
        expectError(refletToneMapTo(view_, settings_, &info, &display_), part, wanted);
    }
    void expectOutputError(const std::string& part, const std::function<void(RefletImage&)>& spoil,
                           RefletResult wanted = REFLET_ERROR_INVALID_ARGUMENT) {
        RefletImage output = color_;
        output.format = VK_FORMAT_R8G8B8A8_UNORM;
        spoil(output);
        expectToneMapError(
            part, [&](RefletToneMapInfo& info) { info.output = &output; }, wanted);
    }
    void inAFrame(const std::function<void()>& record) {
        host_.host.frame([&](VkCommandBuffer commands) {
            const RefletFrameInfo info = room_.frame(commands, 0);
            EXPECT_REFLET(refletBeginFrame(view_, &info));
            record();
            EXPECT_REFLET(refletEndFrame(view_));
        });
    }

    RefletImage color_ = room_.light().light;
    RefletDisplay display_{sizeof display_, {}, {}};
};

TEST_F(OutputArguments, OfToneMaps) {
    inAFrame([&] {
        expectError(refletToneMapTo(view_, settings_, nullptr, &display_), "RefletToneMapInfo: is NULL");
        expectToneMapError("structSize", [](auto& t) { t.structSize = 8; });
        expectToneMapError("autoExposure: is 2", [](auto& t) { t.autoExposure = 2; });
        expectToneMapError("transfer: is 3", [](auto& t) { t.transfer = RefletTransfer(3); });
        for (const float wrong : {-1.0F, 0.5F, 20000.0F, float(NAN), float(INFINITY)}) {
            expectToneMapError("paperWhite: is", [&](auto& t) { t.paperWhite = wrong; });
            expectToneMapError("peakLuminance: is", [&](auto& t) { t.peakLuminance = wrong; });
        }
        expectToneMapError("peakLuminance: is 100", [](auto& t) { t.peakLuminance = 100.0F; });  // below paper white
        expectToneMapError("RefletToneMapInfo.format: is R8G8B8A8_SRGB; shaders cannot write it",
                           [](auto& t) { t.format = VK_FORMAT_R8G8B8A8_SRGB; });
        expectToneMapError("format: is D32_SFLOAT", [](auto& t) { t.format = VK_FORMAT_D32_SFLOAT; });
        expectToneMapError("scRGB has values above 1", [](auto& t) {
            t.transfer = REFLET_TRANSFER_SCRGB;
            t.format = VK_FORMAT_R8G8B8A8_UNORM;
        });
        RefletImage exposure = color_;
        const auto expectExposureError = [&](const char* part, const auto& spoil) {
            RefletImage spoiled = exposure;
            spoil(spoiled);
            expectToneMapError(part, [&](RefletToneMapInfo& t) { t.exposure = &spoiled; });
        };
        expectExposureError("exposure.width, height: are 64x40", [](auto&) {});
        exposure.width = exposure.height = 1;
        expectExposureError("exposure.image", [](auto& e) { e.image = VK_NULL_HANDLE; });
        expectExposureError("exposure.format: is R8_UNORM", [](auto& e) { e.format = VK_FORMAT_R8_UNORM; });
        expectExposureError("exposure.offset", [](auto& e) { e.offset[0] = 1; });
        expectToneMapError("choose one", [&](RefletToneMapInfo& t) {
            t.exposure = &exposure;
            t.autoExposure = 1;
        });
        RefletToneMapInfo right{};
        right.structSize = sizeof right;
        right.color = &color_;
        expectError(refletToneMapTo(view_, settings_, &right, nullptr), "RefletDisplay: is NULL");
        display_.structSize = 8;
        expectError(refletToneMapTo(view_, settings_, &right, &display_), "RefletDisplay.structSize");
        display_.structSize = sizeof display_;
        EXPECT_REFLET(refletToneMapTo(view_, settings_, &right, &display_));
    });
}

TEST_F(OutputArguments, OfTheHostsOutput) {
    inAFrame([&] {
        expectOutputError("output.image", [](auto& o) { o.image = VK_NULL_HANDLE; });
        expectOutputError("output.view", [](auto& o) { o.view = VK_NULL_HANDLE; });
        expectOutputError("output.format: is R32G32B32A32_SFLOAT",
                          [](auto& o) { o.format = VK_FORMAT_R32G32B32A32_SFLOAT; });
        expectOutputError("output.format: is B8G8R8A8_SRGB", [](auto& o) { o.format = VK_FORMAT_B8G8R8A8_SRGB; });
        expectOutputError("output.width, height: are 63x40", [](auto& o) { o.width = 63; });
        expectOutputError("output.offset: is (1, 0)", [](auto& o) { o.offset[0] = 1; });
        expectOutputError("output.layout", [](auto& o) { o.layout = VK_IMAGE_LAYOUT_PREINITIALIZED; });
        expectOutputError("output.reserved", [](auto& o) { o.reserved[3] = 1; });
        expectOutputError("output: is the image of color", [](auto&) {});
    });
    // A host that has not enabled it.
    VkPhysicalDeviceFeatures2 fewer = *host_.contextInfo().enabledFeatures;
    fewer.features.shaderStorageImageWriteWithoutFormat = VK_FALSE;
    RefletContextInfo info = host_.contextInfo();
    info.enabledFeatures = &fewer;
    RefletContext context = nullptr;
    EXPECT_REFLET(refletCreateContext(&info, &context));
    const RefletViewInfo viewInfo{sizeof viewInfo, HostRoom::width, HostRoom::height, 1, 0, 0};
    std::swap(context_, context);
    RefletView view = nullptr;
    EXPECT_REFLET(refletCreateView(context_, &viewInfo, &view));
    std::swap(view_, view);
    inAFrame([&] {
        expectOutputError(
            "output.format: is B8G8R8A8_UNORM, which needs shaderStorageImageWriteWithoutFormat",
            [](auto& o) { o.format = VK_FORMAT_B8G8R8A8_UNORM; }, REFLET_ERROR_MISSING_FEATURE);
    });
    host_.host.waitForAll();
    std::swap(view_, view);
    std::swap(context_, context);
    refletDestroyView(view);
    refletDestroyContext(context);
}

TEST_F(OutputArguments, OfOffsets) {
    expectGBufferError("gbuffer.normal.offset: is (1, 0); from there a rectangle of 64x40 does not fit into 64x40",
                       [](auto& g) { g.normal.offset[0] = 1; });
    expectGBufferError("gbuffer.depth.offset: is (0, 4294967295)", [](auto& g) { g.depth.offset[1] = UINT32_MAX; });
    expectGBufferError("gbuffer.roughness.offset", [](auto& g) {
        g.roughness.offset[0] = 4;
        g.roughness.width = 67;
    });
    expectFrameError("gbuffer.depth.offset", [&](RefletFrameInfo& info) {
        static RefletGBuffer moved = *info.gbuffer;
        moved.depth.offset[0] = 17;
        info.renderSize[0] = 48;
        info.renderSize[1] = 30;
        info.gbuffer = &moved;
    });
    inAFrame([&] {
        RefletSunShadow sun = room_.sun();
        sun.map.offset[1] = 1;
        RefletImage image{};
        expectError(refletSunShadow(view_, settings_, &sun, &image), "map.offset: is (0, 1); must be 0");
        RefletIndirectLight light = room_.light();
        light.light.offset[0] = 3;
        RefletLobe lobe = emptyLobe();
        expectError(refletDiffuseGi(view_, settings_, &light, &lobe), "light.offset: is (3, 0)");
        expectError(refletUseCommandBuffer(view_, VK_NULL_HANDLE), "commandBuffer");
    });
    expectError(refletUseCommandBuffer(nullptr, VK_NULL_HANDLE), "view");
}

TEST_F(OutputArguments, OfQueueFamilies) {
    RefletContextInfo info = host_.contextInfo();
    RefletContext context = nullptr;
    info.queueFamilyCount = 2;
    expectError(refletCreateContext(&info, &context), "queueFamilies: is NULL");
    const uint32_t families[] = {0, VK_QUEUE_FAMILY_IGNORED};
    info.queueFamilies = families;
    expectError(refletCreateContext(&info, &context), "queueFamilies[1]: is 0xffffffff");
    info.structSize = offsetof(RefletContextInfo, queueFamilies);  // of a host that does not know them
    EXPECT_REFLET(refletCreateContext(&info, &context));
    refletDestroyContext(context);
}

}  // namespace
}  // namespace reflet::test::output_arguments_test
