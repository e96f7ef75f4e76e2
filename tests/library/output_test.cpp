// Where pictures come from and go to: offsets in larger images, tone maps for any display, a host's exposure and
// output, command buffers of several queues' worth.
#include "library/library_fixture.h"

#include <volk.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <string>

namespace reflet::test::output_test {
namespace {

constexpr uint32_t width = HostRoom::width;
constexpr uint32_t height = HostRoom::height;

// Of luminances, SMPTE ST 2084.
double pq(double nits) {
    const double y = std::pow(std::clamp(nits / 10000.0, 0.0, 1.0), 0.1593017578125);
    return std::pow((0.8359375 + 18.8515625 * y) / (1.0 + 18.6875 * y), 78.84375);
}

// Command buffers beside those of the host's frames, in the order of their submission.
class MoreBuffers {
public:
    explicit MoreBuffers(VkDevice device) : device_(device) {
        const VkCommandPoolCreateInfo info{VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO, nullptr, 0, 0};
        vkCreateCommandPool(device, &info, nullptr, &pool_);
    }
    ~MoreBuffers() { vkDestroyCommandPool(device_, pool_, nullptr); }
    MoreBuffers(const MoreBuffers&) = delete;
    MoreBuffers& operator=(const MoreBuffers&) = delete;

    VkCommandBuffer begin() {
        VkCommandBufferAllocateInfo info{VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO};
        info.commandPool = pool_;
        info.commandBufferCount = 1;
        VkCommandBuffer commands = VK_NULL_HANDLE;
        vkAllocateCommandBuffers(device_, &info, &commands);
        const VkCommandBufferBeginInfo begin{VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO};
        vkBeginCommandBuffer(commands, &begin);
        return commands;
    }
    void submit(const std::array<VkCommandBuffer, 2>& buffers) {
        VkQueue queue = VK_NULL_HANDLE;
        vkGetDeviceQueue(device_, 0, 0, &queue);
        for (VkCommandBuffer commands : buffers) {
            vkEndCommandBuffer(commands);
            VkSubmitInfo submit{VK_STRUCTURE_TYPE_SUBMIT_INFO};
            submit.commandBufferCount = 1;
            submit.pCommandBuffers = &commands;
            vkQueueSubmit(queue, 1, &submit, VK_NULL_HANDLE);
        }
    }

private:
    VkDevice device_;
    VkCommandPool pool_ = VK_NULL_HANDLE;
};

class Output : public Library {
protected:
    Output() : context_(host_.makeContext()), view_(makeView(context_, 3)), settings_(makeSettings("balanced")) {}
    ~Output() override {
        host_.host.waitForAll();
        refletDestroySettings(settings_);
        refletDestroyView(view_);
        refletDestroyContext(context_);
    }

    // Columns of these greys.
    RefletImage greys(const std::vector<float>& values) {
        std::vector<vec4> texels;
        for (uint32_t i = 0; i < width * height; ++i) {
            texels.emplace_back(vec3(values[i % width % values.size()]), 1.0F);
        }
        return host_.makeImage(VK_FORMAT_R32G32B32A32_SFLOAT, width, height, texels);
    }
    RefletImage exposureOf(float factor) {
        return host_.makeImage(VK_FORMAT_R32_SFLOAT, 1, 1, std::vector<float>{factor});
    }
    RefletDisplay toneMap(const RefletToneMapInfo& info, float preExposure = 1.0F) {
        RefletDisplay display{sizeof display, {}, {}};
        host_.host.frame([&](VkCommandBuffer commands) {
            RefletFrameInfo frame = room_.frame(commands, index_++);
            frame.preExposure = preExposure;
            EXPECT_REFLET(refletBeginFrame(view_, &frame));
            EXPECT_REFLET(refletToneMapTo(view_, settings_, &info, &display));
            EXPECT_REFLET(refletEndFrame(view_));
        });
        host_.host.waitForAll();
        return display;
    }
    static RefletToneMapInfo toneMapOf(const RefletImage& color) {
        RefletToneMapInfo info{};
        info.structSize = sizeof info;
        info.color = &color;
        return info;
    }
    void setCurve(const char* curve) { EXPECT_REFLET(refletSetSetting(settings_, "tonemap.curve", curve)); }

    RefletContext context_;
    RefletView view_;
    RefletSettings settings_;
    const HostRoom room_{host_, {}};
    MoreBuffers buffers_{host_.host.device().device};
    uint32_t index_ = 0;
};

glm::uvec3 unpacked10(uint32_t texel) {
    return {texel & 1023U, texel >> 10U & 1023U, texel >> 20U & 1023U};
}

TEST_F(Output, PqIsTheStandardsOfKnownLuminances) {
    setCurve("srgb");  // clips, and changes nothing else
    const std::vector<float> nits{0.0F, 1.0F, 100.0F, 203.0F, 400.0F, 1000.0F, 4000.0F, 20000.0F};
    std::vector<float> radiance;
    for (const float n : nits) {
        radiance.push_back(n / 100.0F);
    }
    const RefletImage color = greys(radiance);
    RefletToneMapInfo info = toneMapOf(color);
    info.transfer = REFLET_TRANSFER_PQ;
    info.paperWhite = 100.0F;
    info.peakLuminance = 4000.0F;
    const RefletDisplay display = toneMap(info);
    EXPECT_EQ(display.image.format, VK_FORMAT_A2B10G10R10_UNORM_PACK32);
    EXPECT_EQ(display.exposure.image, VkImage(VK_NULL_HANDLE));
    const std::vector<uint32_t> texels = texelsOf<uint32_t>(host_, display.image);
    for (size_t i = 0; i < nits.size(); ++i) {
        const double wanted = 1023.0 * pq(std::min(nits[i], 4000.0F));
        for (int channel = 0; channel < 3; ++channel) {
            EXPECT_NEAR(double(unpacked10(texels[i])[channel]), wanted, 1.0) << nits[i] << " nits";
        }
        EXPECT_EQ(texels[i] >> 30U, 3U) << "alpha";
    }
    EXPECT_NEAR(pq(100.0), 0.5081, 1e-4) << "of the standard's tables";
    EXPECT_NEAR(pq(1000.0), 0.7518, 1e-4);
}

TEST_F(Output, PqHasThePrimariesOfRec2020) {
    setCurve("srgb");
    const RefletImage red = host_.makeImage(VK_FORMAT_R32G32B32A32_SFLOAT, width, height,
                                            std::vector<vec4>(size_t(width) * height, vec4(1, 0, 0, 1)));
    RefletToneMapInfo info = toneMapOf(red);
    info.transfer = REFLET_TRANSFER_PQ;
    info.format = VK_FORMAT_R16G16B16A16_SFLOAT;
    const std::vector<vec4> texels = halvesOf(host_, toneMap(info).image);
    const std::array<double, 3> shares{0.6274039, 0.0690973, 0.0163914};  // ITU-R BT.2087
    for (int channel = 0; channel < 3; ++channel) {
        EXPECT_NEAR(texels[7][channel], pq(203.0 * shares[channel]), 1e-3);
    }
}

TEST_F(Output, ScrgbIsLinearInNits) {
    setCurve("neutral");
    const RefletImage color = greys({0.1F, 0.5F, 1.0F, 3.0F, 40.0F, 60000.0F});
    RefletToneMapInfo info = toneMapOf(color);
    info.transfer = REFLET_TRANSFER_SCRGB;
    info.paperWhite = 160.0F;
    info.peakLuminance = 800.0F;
    const std::vector<vec4> texels = halvesOf(host_, toneMap(info).image);
    EXPECT_NEAR(texels[0].y, 2.0F * (0.1F - 0.04F), 1e-3F) << "the neutral curve subtracts 0.04";
    EXPECT_NEAR(texels[1].y, 2.0F * (0.5F - 0.04F), 2e-3F);
    EXPECT_GT(texels[3].y, 4.0F) << "brighter than white";
    EXPECT_LT(texels[4].y, 10.0F);
    EXPECT_NEAR(texels[5].y, 10.0F, 0.02F) << "the peak";
    setCurve("agx");
    EXPECT_NEAR(halvesOf(host_, toneMap(info).image)[5].y, 2.0F, 0.01F) << "ends at white";
}

// Each format the same picture.
TEST_F(Output, FormatsShowTheSame) {
    const RefletImage color = greys({0.02F, 0.1F, 0.3F, 0.9F, 4.0F});
    RefletToneMapInfo info = toneMapOf(color);
    const std::vector<glm::u8vec4> plain = texelsOf<glm::u8vec4>(host_, toneMap(info).image);
    RefletImage old{};
    host_.host.frame([&](VkCommandBuffer commands) {
        const RefletFrameInfo frame = room_.frame(commands, index_++);
        EXPECT_REFLET(refletBeginFrame(view_, &frame));
        EXPECT_REFLET(refletToneMap(view_, settings_, &color, 0, &old));
        EXPECT_REFLET(refletEndFrame(view_));
    });
    host_.host.waitForAll();
    EXPECT_EQ(texelsOf<glm::u8vec4>(host_, old), plain) << "refletToneMap";
    info.format = VK_FORMAT_A2B10G10R10_UNORM_PACK32;
    const std::vector<uint32_t> ten = texelsOf<uint32_t>(host_, toneMap(info).image);
    info.format = VK_FORMAT_R16G16B16A16_SFLOAT;
    const std::vector<vec4> half = halvesOf(host_, toneMap(info).image);
    for (size_t i = 0; i < 5; ++i) {
        EXPECT_NEAR(float(plain[i].x) / 255.0F, float(unpacked10(ten[i]).x) / 1023.0F, 0.003F);
        EXPECT_NEAR(float(plain[i].x) / 255.0F, half[i].x, 0.003F);
        EXPECT_EQ(half[i].w, 1.0F);
    }
}

// Formats that shaders do not name, where the device has storage images of them.
TEST_F(Output, FormatsWithOtherOrdersShowTheSame) {
    const RefletImage color = host_.makeImage(VK_FORMAT_R32G32B32A32_SFLOAT, width, height,
                                              std::vector<vec4>(size_t(width) * height, vec4(0.1F, 0.3F, 0.6F, 1.0F)));
    RefletToneMapInfo info = toneMapOf(color);
    const glm::u8vec4 plain = texelsOf<glm::u8vec4>(host_, toneMap(info).image).at(0);
    for (const VkFormat format : {VK_FORMAT_B8G8R8A8_UNORM, VK_FORMAT_A2R10G10B10_UNORM_PACK32}) {
        VkFormatProperties known{};
        vkGetPhysicalDeviceFormatProperties(host_.host.device().physical, format, &known);
        if ((known.optimalTilingFeatures & VK_FORMAT_FEATURE_STORAGE_IMAGE_BIT) == 0) {
            std::printf("no storage images of VkFormat %d\n", int(format));
            continue;
        }
        info.format = format;
        const uint32_t texel = texelsOf<uint32_t>(host_, toneMap(info).image).at(0);
        const bool bytes = format == VK_FORMAT_B8G8R8A8_UNORM;
        const uint32_t most = bytes ? 255 : 1023;
        const glm::uvec3 blueFirst(texel & most, texel >> (bytes ? 8U : 10U) & most,
                                   texel >> (bytes ? 16U : 20U) & most);
        for (int channel = 0; channel < 3; ++channel) {
            EXPECT_NEAR(float(blueFirst[2 - channel]) / float(most), float(plain[channel]) / 255.0F, 0.003F) << format;
        }
    }
}

TEST_F(Output, DescriptionTellsDisplayAndPreExposure) {
    const RefletImage color = greys({0.1F});
    RefletToneMapInfo info = toneMapOf(color);
    info.transfer = REFLET_TRANSFER_PQ;
    info.format = VK_FORMAT_R8G8B8A8_UNORM;
    toneMap(info, 8.0F);
    std::array<char, 8192> text{};
    size_t size = text.size();
    EXPECT_REFLET(refletDescribe(view_, &size, text.data()));
    for (const char* part : {"pre-exposure: 8, 8 before", "display: PQ, R8G8B8A8_UNORM, white 203 nits, peak 1000 nits",
                             "PQ in 8 bits shows bands"}) {
        EXPECT_NE(std::string(text.data()).find(part), std::string::npos) << part << '\n' << text.data();
    }
}

TEST_F(Output, PreparedToneMapsMakeNoPipelines) {
    RefletImage output =
        host_.makeImage(VK_FORMAT_R16G16B16A16_SFLOAT, width, height, std::vector<uint64_t>(size_t(width) * height));
    const RefletImage color = greys({0.1F});
    RefletToneMapInfo info = toneMapOf(color);
    info.autoExposure = 1;
    info.transfer = REFLET_TRANSFER_SCRGB;
    const RefletFrameInfo frame = room_.frame(nullptr, 0);
    RefletPrepareInfo prepare{};
    prepare.structSize = sizeof prepare;
    prepare.effects = REFLET_EFFECT_TONE_MAP;
    prepare.gbuffer = frame.gbuffer;
    prepare.toneMap = &info;
    uint32_t remaining = 1;
    EXPECT_REFLET(refletPrepare(view_, settings_, &prepare, 1000, &remaining));
    info.output = &output;
    info.format = VK_FORMAT_R8G8B8A8_UNORM;  // not read
    EXPECT_REFLET(refletPrepare(view_, settings_, &prepare, 1000, &remaining));
    EXPECT_EQ(remaining, 0U);
    info.output = nullptr;
    info.format = VK_FORMAT_UNDEFINED;
    const uint64_t made = LibraryHost::made().pipelines;
    toneMap(info);
    EXPECT_EQ(LibraryHost::made().pipelines, made);
    info.transfer = REFLET_TRANSFER_PQ;
    toneMap(info);
    EXPECT_EQ(LibraryHost::made().pipelines, made + 1) << "another one, which was not prepared";
    prepare.toneMap = &info;
    info.paperWhite = -1.0F;
    EXPECT_EQ(refletPrepare(view_, settings_, &prepare, 1000, &remaining), REFLET_ERROR_INVALID_ARGUMENT);
}

TEST_F(Output, ExposureComesFromAnImageAndLeavesInOne) {
    setCurve("srgb");
    const RefletImage color = greys({0.01F, 0.04F});
    RefletToneMapInfo info = toneMapOf(color);
    const RefletImage four = exposureOf(4.0F);
    info.exposure = &four;
    info.transfer = REFLET_TRANSFER_SCRGB;
    info.paperWhite = 80.0F;
    const auto first = [&](float preExposure = 1.0F) { return halvesOf(host_, toneMap(info, preExposure).image)[1].x; };
    EXPECT_NEAR(first(), 0.16F, 1e-3F);
    EXPECT_NEAR(first(8.0F), 0.02F, 1e-4F) << "of radiance without pre-exposure";
    EXPECT_REFLET(refletSetSetting(settings_, "tonemap.exposure", "1"));
    EXPECT_NEAR(first(), 0.32F, 1e-3F) << "a correction of it";
    EXPECT_REFLET(refletSetSetting(settings_, "tonemap.exposure", "0"));
    for (const float wrong : {0.0F, -2.0F, float(INFINITY), float(NAN)}) {
        const RefletImage image = exposureOf(wrong);
        info.exposure = &image;
        EXPECT_NEAR(first(), 0.04F, 1e-3F) << wrong << " counts as 1";
    }
    // The library's own exposure, given back to it, shows the same.
    info.exposure = nullptr;
    info.autoExposure = 1;
    const RefletDisplay own = toneMap(info);
    const float shown = halvesOf(host_, own.image)[1].x;
    const float factor = texelsOf<float>(host_, own.exposure).at(0);
    EXPECT_EQ(own.exposure.format, VK_FORMAT_R32_SFLOAT);
    EXPECT_NEAR(shown, 0.04F * factor, 0.002F * shown);
    info.autoExposure = 0;
    const RefletImage again = exposureOf(factor);
    info.exposure = &again;
    EXPECT_NEAR(first(), shown, 0.002F * shown);
}

TEST_F(Output, GoesIntoTheHostsImage) {
    const RefletImage color = greys({0.02F, 0.1F, 0.3F, 0.9F, 4.0F});
    RefletToneMapInfo info = toneMapOf(color);
    const std::vector<glm::u8vec4> wanted = texelsOf<glm::u8vec4>(host_, toneMap(info).image);
    const uvec2 size(width + 9, height + 5);
    const std::vector<glm::u8vec4> grey(size_t(size.x) * size.y, glm::u8vec4(7));
    for (const VkImageLayout layout :
         {VK_IMAGE_LAYOUT_GENERAL, VK_IMAGE_LAYOUT_UNDEFINED, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL}) {
        RefletImage output = host_.makeImage(VK_FORMAT_R8G8B8A8_UNORM, size.x, size.y, grey.data(),
                                             grey.size() * sizeof grey[0], 1, VK_IMAGE_USAGE_STORAGE_BIT);
        if (layout == VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL) {
            host_.setLayout(output, 0, VK_IMAGE_LAYOUT_GENERAL, layout);
        }
        output.layout = layout;
        output.offset[0] = 6;
        output.offset[1] = 3;
        info.output = &output;
        const RefletDisplay display = toneMap(info);
        EXPECT_EQ(display.image.image, output.image);
        EXPECT_EQ(display.image.layout, layout == VK_IMAGE_LAYOUT_UNDEFINED ? VK_IMAGE_LAYOUT_GENERAL : layout);
        const std::vector<glm::u8vec4> texels = texelsOf<glm::u8vec4>(host_, display.image);
        for (uint32_t i = 0; i < width * height; ++i) {
            const glm::u8vec4 shown = texels[size_t(i / width + 3) * size.x + i % width + 6];
            ASSERT_EQ(shown, wanted[i]) << i;
        }
        if (layout != VK_IMAGE_LAYOUT_UNDEFINED) {
            EXPECT_EQ(texels[0], glm::u8vec4(7)) << "around the rectangle";
        }
    }
}

// The same numbers, whatever lies around the picture in the host's images.
TEST_F(Output, OffsetsFindThePictureInLargerImages) {
    for (const uvec2 drawn : {uvec2(0), uvec2(48, 30)}) {
        const auto render = [&](uvec2 border) {
            const HostRoom room(host_, {.drawn = drawn, .border = border});
            EXPECT_REFLET(refletResetView(view_));
            RoomResults results;
            for (uint32_t i = 0; i < 2; ++i) {
                host_.host.frame([&](VkCommandBuffer commands) {
                    const RefletFrameInfo frame = room.frame(commands, i);
                    results = recordRoom(room, frame, view_, settings_);
                });
            }
            host_.host.waitForAll();
            return std::array{halvesOf(host_, results.sum.lit), halvesOf(host_, results.antialiased)};
        };
        const auto tight = render({0, 0});
        EXPECT_EQ(render({6, 11}), tight) << drawn.x;
        EXPECT_GT(tight[0].at(width / 2).y, 0.0F);
    }
}

// Command buffers of one queue, submitted in the order of the calls.
TEST_F(Output, CallsMayHaveCommandBuffersOfTheirOwn) {
    const auto render = [&](bool several) {
        EXPECT_REFLET(refletResetView(view_));
        RoomResults results;
        results.sum.structSize = sizeof results.sum;
        for (uint32_t i = 0; i < 3; ++i) {
            host_.host.frame([&](VkCommandBuffer last) {
                const std::array before{several ? buffers_.begin() : last, several ? buffers_.begin() : last};
                const RefletFrameInfo frame = room_.frame(before[0], i);
                const RefletIndirectLight light = room_.light();
                const RefletSunShadow sun = room_.sun();
                EXPECT_REFLET(refletBeginFrame(view_, &frame));
                EXPECT_REFLET(refletUseCommandBuffer(view_, before[1]));
                EXPECT_REFLET(refletSunShadow(view_, settings_, &sun, &results.visibility));
                EXPECT_REFLET(refletDiffuseGi(view_, settings_, &light, &results.diffuse));
                EXPECT_REFLET(refletUseCommandBuffer(view_, last));
                EXPECT_REFLET(refletComposite(view_, settings_, nullptr, &results.sum));
                EXPECT_REFLET(refletTemporal(view_, settings_, nullptr, &results.antialiased));
                EXPECT_REFLET(refletEndFrame(view_));
                if (several) {
                    buffers_.submit(before);
                }
            });
        }
        host_.host.waitForAll();
        return std::array{halvesOf(host_, results.sum.lit), halvesOf(host_, results.antialiased)};
    };
    const auto one = render(false);
    EXPECT_EQ(render(true), one);
    EXPECT_NE(refletUseCommandBuffer(view_, buffers_.begin()), REFLET_SUCCESS);
    EXPECT_NE(std::string(refletLastError()).find("no frame has begun"), std::string::npos) << refletLastError();
}

}  // namespace
}  // namespace reflet::test::output_test
