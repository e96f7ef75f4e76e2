// What a host may say of its images, matrices and settings, and what the library tells it.
#include "library/library_fixture.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

namespace reflet::test {
namespace {

class Conventions : public Library {
protected:
    Conventions() : context_(host_.makeContext()), settings_(makeSettings("fast")), view_(makeView(context_, 3)) {}
    ~Conventions() override {
        host_.host.waitForAll();
        refletDestroyView(view_);
        refletDestroySettings(settings_);
        refletDestroyContext(context_);
    }

    // The reflections of one frame.
    std::vector<vec4> reflections(const RefletFrameInfo& frame, const RefletIndirectLight& light) {
        RefletLobe lobe = emptyLobe();
        EXPECT_REFLET(refletResetView(view_));
        host_.host.frame([&](VkCommandBuffer commands) {
            RefletFrameInfo info = frame;
            info.commandBuffer = commands;
            EXPECT_REFLET(refletBeginFrame(view_, &info));
            EXPECT_REFLET(refletReflections(view_, settings_, &light, &lobe));
            EXPECT_REFLET(refletEndFrame(view_));
        });
        host_.host.waitForAll();
        return lobe.radiance.image == VK_NULL_HANDLE ? std::vector<vec4>() : halvesOf(host_, lobe.radiance);
    }
    std::string described() {
        size_t size = 0;
        EXPECT_REFLET(refletDescribe(view_, &size, nullptr));
        std::string text(size, '?');
        EXPECT_REFLET(refletDescribe(view_, &size, text.data()));
        EXPECT_EQ(text.back(), '\0');
        text.pop_back();
        return text;
    }

    RefletContext context_;
    RefletSettings settings_;
    RefletView view_;
    const HostRoom room_{host_, {}};
};

float largestDifference(const std::vector<vec4>& a, const std::vector<vec4>& b) {
    float most = a.empty() || a.size() != b.size() ? INFINITY : 0.0F;
    for (size_t i = 0; i < a.size() && std::isfinite(most); ++i) {
        most = std::max(most, glm::compMax(glm::abs(vec3(a[i]) - vec3(b[i]))));
    }
    return most;
}

// The other layer holds rubbish, and stays in the layout in which it is.
TEST_F(Conventions, OfALayerOfAnArray) {
    constexpr size_t count = size_t(HostRoom::width) * HostRoom::height;
    const RefletIndirectLight light = room_.light();
    std::vector<vec4> texels = host_.texelsOfInput(light.light);
    const std::vector<vec4> single = reflections(room_.frame(nullptr, 0), light);
    texels.insert(texels.begin(), count, vec4(1000.0F));
    RefletImage both = host_.makeImage(VK_FORMAT_R32G32B32A32_SFLOAT, HostRoom::width, HostRoom::height, texels.data(),
                                       texels.size() * sizeof(vec4), 2);
    host_.setLayout(both, 0, VK_IMAGE_LAYOUT_GENERAL, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL);
    host_.setLayout(both, 1, VK_IMAGE_LAYOUT_GENERAL, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL);
    host_.setLayout(both, 0, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL);
    RefletIndirectLight second = light;
    second.light = both;
    second.light.view = host_.layerView(both, 1);
    second.light.baseLayer = 1;
    second.light.layout = VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL;  // is left and restored
    EXPECT_LE(largestDifference(reflections(room_.frame(nullptr, 0), second), single), 0.0F);
    // Both are where they were: the validation layers complain if not.
    host_.setLayout(both, 0, VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL, VK_IMAGE_LAYOUT_GENERAL);
    host_.setLayout(both, 1, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, VK_IMAGE_LAYOUT_GENERAL);
}

// OpenGL's projection of the same camera draws the same depth.
TEST_F(Conventions, OfClipSpaceDepth) {
    const HostRoom standard(host_, {.unusual = true});
    RefletFrameInfo frame = standard.frame(nullptr, 0);
    const std::vector<vec4> wanted = reflections(frame, standard.light());
    for (int column = 0; column < 4; ++column) {  // z in -w..w
        frame.viewToClip[4 * column + 2] = 2.0F * frame.viewToClip[4 * column + 2] - frame.viewToClip[4 * column + 3];
    }
    frame.clipDepthFromMinusOne = 1;
    EXPECT_LE(largestDifference(reflections(frame, standard.light()), wanted), 0.01F);
}

// A world with +Z up, and its environment image, is one with +Y up.
TEST_F(Conventions, OfUpInTheWorld) {
    constexpr uint32_t width = 32;
    std::vector<vec4> sky;
    for (uint32_t i = 0; i < width * width / 2; ++i) {
        sky.emplace_back(float(i % width) / width, float(i / width) / 16.0F, 0.5F, 1.0F);  // NOLINT: rows
    }
    RefletEnvironment around = *room_.light().environment;
    around.image = host_.makeImage(VK_FORMAT_R32G32B32A32_SFLOAT, width, width / 2, sky);
    around.rotation = 0.7F;
    RefletIndirectLight light = room_.light();
    light.environment = &around;
    RefletFrameInfo frame = room_.frame(nullptr, 0);
    const std::vector<vec4> wanted = reflections(frame, light);
    // The world turned by a quarter around +X: +Y goes to +Z, +Z to -Y. Normals of the room are turned by hand.
    mat4 toView;
    std::memcpy(&toView, frame.worldToView, sizeof toView);
    const mat4 turn(vec4(1, 0, 0, 0), vec4(0, 0, 1, 0), vec4(0, -1, 0, 0), vec4(0, 0, 0, 1));
    const mat4 turned = toView * glm::inverse(turn);
    std::memcpy(frame.worldToView, &turned, sizeof turned);
    const HostRoom viewSpace(host_, {.unusual = true});
    RefletFrameInfo odd = viewSpace.frame(nullptr, 0);
    RefletIndirectLight oddLight = viewSpace.light();
    oddLight.environment = &around;
    const std::vector<vec4> inViewSpace = reflections(odd, oddLight);
    std::memcpy(odd.worldToView, &turned, sizeof turned);
    around.worldUp[2] = 2.0F;
    EXPECT_LE(largestDifference(reflections(odd, oddLight), inViewSpace), 0.02F);
    around.worldUp[2] = 0.0F;
    EXPECT_GT(largestDifference(reflections(odd, oddLight), inViewSpace), 0.1F) << "it is not the same by itself";
    EXPECT_LE(largestDifference(wanted, inViewSpace), 0.1F) << "nor does the room change with its conventions";
}

TEST_F(Conventions, AreDescribed) {
    const RefletIndirectLight light = room_.light();
    RefletFrameInfo frame = room_.frame(nullptr, 7);
    reflections(frame, light);
    const std::string text = described();
    for (const char* part :
         {"view: 64x40", "field of view 53.13 degrees", "near plane 0.1 m, far infinite", "view space is right-handed",
          "y down, depth 0 to 1", "about +Y of the world", "depth: R32_SFLOAT 64x40, reversed",
          "octahedral snorm, world space", "roughness R32G32B32A32_SFLOAT.r, perceptual",
          "effects so far: specular lobe", "contradictions: none found"}) {
        EXPECT_NE(text.find(part), std::string::npos) << part << "\n" << text;
    }
    EXPECT_LE(std::ranges::count(text, '\n'), 12);
    // The same frame index again, at rest with another camera, without former matrices.
    frame.restFrames = 3;
    reflections(frame, light);
    EXPECT_NE(described().find("frameIndex is that of the last frame"), std::string::npos) << described();
    char few[8];
    size_t size = sizeof few;
    EXPECT_REFLET(refletDescribe(view_, &size, few));
    EXPECT_EQ(std::string(few), text.substr(0, 7));
    EXPECT_GT(size, 500U);
    EXPECT_EQ(refletDescribe(view_, nullptr, few), REFLET_ERROR_INVALID_ARGUMENT);
}

TEST_F(Conventions, PassTimesAreMeasuredOnDemand) {
    const RefletViewInfo info{sizeof info, HostRoom::width, HostRoom::height, 3, 0, 0};
    RefletView view = nullptr;
    EXPECT_REFLET(refletCreateView(context_, &info, &view));
    renderFrames(room_, view, settings_, 1);
    uint32_t count = 0;
    EXPECT_EQ(refletPassTimes(view, &count, nullptr), REFLET_ERROR_INVALID_ARGUMENT);
    EXPECT_NE(std::string(refletLastError()).find("REFLET_VIEW_PASS_TIMES"), std::string::npos) << refletLastError();
    refletDestroyView(view);
    renderFrames(room_, view_, settings_, 1);
    EXPECT_REFLET(refletFinishView(view_));
    EXPECT_REFLET(refletPassTimes(view_, &count, nullptr));
    EXPECT_GT(count, 10U);
}

TEST_F(Conventions, NoiseOfViewsIsIndependent) {
    const std::vector<vec4> first = reflections(room_.frame(nullptr, 3), room_.light());
    EXPECT_LE(largestDifference(reflections(room_.frame(nullptr, 3), room_.light()), first), 0.0F);
    const RefletViewInfo info{sizeof info, HostRoom::width, HostRoom::height, 3, 0, 1};
    refletDestroyView(view_);
    EXPECT_REFLET(refletCreateView(context_, &info, &view_));
    EXPECT_GT(largestDifference(reflections(room_.frame(nullptr, 3), room_.light()), first), 0.01F);
}

TEST_F(Conventions, PipelinesAreKeptByTheHost) {
    renderFrames(room_, view_, settings_, 1);
    size_t size = 0;
    EXPECT_REFLET(refletPipelineCacheData(context_, &size, nullptr));
    ASSERT_GT(size, 16U);
    std::vector<std::byte> data(size);
    EXPECT_REFLET(refletPipelineCacheData(context_, &size, data.data()));
    size = 4;
    EXPECT_EQ(refletPipelineCacheData(context_, &size, data.data()), REFLET_ERROR_INVALID_ARGUMENT);
    RefletContextInfo info = host_.contextInfo();
    info.pipelineCacheData = data.data();
    info.pipelineCacheDataSize = data.size();
    RefletContext again = nullptr;
    EXPECT_REFLET(refletCreateContext(&info, &again));
    refletDestroyContext(again);
}

TEST(SettingNumbers, AreThoseOfTheTexts) {
    RefletSettings settings = nullptr;
    EXPECT_REFLET(refletCreateSettings("quality", &settings));
    for (uint32_t i = 0; i < refletSettingCount(); ++i) {
        RefletSettingInfo info{};
        info.structSize = sizeof info;
        EXPECT_REFLET(refletSettingInfo(i, &info));
        double value = 0.0;
        EXPECT_REFLET(refletGetSettingNumber(settings, info.name, &value));
        const std::string text = refletGetSetting(settings, info.name);
        if (info.type == REFLET_SETTING_CHOICE) {
            ASSERT_LT(value, info.choiceCount) << info.name;
            EXPECT_EQ(text, info.choices[static_cast<size_t>(value)]) << info.name;
            EXPECT_STREQ(info.defaultValue, info.choices[static_cast<size_t>(info.defaultNumber)]) << info.name;
        } else if (info.type == REFLET_SETTING_SWITCH) {
            EXPECT_EQ(text, value != 0.0 ? "true" : "false") << info.name;
        } else {
            EXPECT_NEAR(std::stod(text), value, 1e-5 * std::abs(value)) << info.name;
            EXPECT_GE(value, info.min) << info.name;
            EXPECT_LE(value, info.max) << info.name;
            EXPECT_EQ(refletSetSettingNumber(settings, info.name, 2.0 * std::abs(info.max) + 1.0),
                      REFLET_ERROR_INVALID_ARGUMENT)
                << info.name;
        }
        EXPECT_REFLET(refletSetSettingNumber(settings, info.name, info.defaultNumber));
        EXPECT_STREQ(refletGetSetting(settings, info.name), info.defaultValue) << info.name;
        EXPECT_EQ(refletSetSettingNumber(settings, info.name, NAN), REFLET_ERROR_INVALID_ARGUMENT) << info.name;
    }
    EXPECT_EQ(refletSetSettingNumber(settings, "diffuse.rays", 1.5), REFLET_ERROR_INVALID_ARGUMENT);
    EXPECT_EQ(refletSetSettingNumber(settings, "ao.method", 99.0), REFLET_ERROR_INVALID_ARGUMENT);
    EXPECT_EQ(refletGetSettingNumber(settings, "nothing", nullptr), REFLET_ERROR_INVALID_ARGUMENT);
    refletDestroySettings(settings);
}

}  // namespace
}  // namespace reflet::test
