// RefletRadianceCache: what one view has seen is another view's start, in whatever exposure; and its handles.
#include "library/library_fixture.h"
#include "library/missed_rays_host.h"

#include <cmath>
#include <string>

namespace reflet::test::radiance_cache_test {
namespace {

constexpr uint32_t framesBefore = 12;

class RadianceCache : public Library {
protected:
    RadianceCache() : context_(host_.makeContext()), settings_(makeSettings("balanced")) {
        EXPECT_REFLET(refletCreateRadianceCache(context_, &cache_));
    }
    ~RadianceCache() override {
        host_.host.waitForAll();
        refletDestroyRadianceCache(cache_);
        refletDestroySettings(settings_);
        refletDestroyContext(context_);
    }

    struct Frames {
        RefletRadianceCache cache = nullptr;
        uint32_t count = 1;
        uint32_t first = 0;
        float preExposure = 1.0F;
        bool answered = false;  // rays that miss the screen
    };

    RefletImage lightTimes(float factor) {
        std::vector<vec4> texels = host_.texelsOfInput(room_.light().light);
        for (vec4& texel : texels) {
            texel = vec4(factor * vec3(texel), texel.a);
        }
        return host_.makeImage(VK_FORMAT_R32G32B32A32_SFLOAT, HostRoom::width, HostRoom::height, texels);
    }

    // Denoised diffuse light of a new view's last frame, without pre-exposure.
    std::vector<vec4> render(const Frames& how) {
        RefletView view = makeView(context_, 3);
        const RefletImage lit = how.preExposure != 1.0F ? lightTimes(how.preExposure) : room_.light().light;
        RefletLobe lobe = emptyLobe();
        for (uint32_t i = 0; i < how.count; ++i) {
            host_.host.frame([&](VkCommandBuffer commands) {
                RefletFrameInfo frame = room_.frame(commands, how.first + i);
                frame.preExposure = how.preExposure;
                RefletIndirectLight light = room_.light();
                light.light = lit;
                light.radianceCache = how.cache;
                EXPECT_REFLET(refletBeginFrame(view, &frame));
                record(view, commands, light, how.answered, lobe);
                EXPECT_REFLET(refletEndFrame(view));
            });
        }
        host_.host.waitForAll();
        std::vector<vec4> texels = halvesOf(host_, lobe.radiance);
        for (vec4& texel : texels) {
            texel /= how.preExposure;
        }
        refletDestroyView(view);
        return texels;
    }

    void record(RefletView view, VkCommandBuffer commands, const RefletIndirectLight& light, bool answered,
                RefletLobe& lobe) {
        if (!answered) {
            EXPECT_REFLET(refletDiffuseGi(view, settings_, &light, &lobe));
            return;
        }
        RefletMissedRays missed{};
        missed.structSize = sizeof missed;
        EXPECT_REFLET(refletMissedRays(view, settings_, REFLET_LOBE_DIFFUSE, &light, &missed));
        const RefletRayAnswers answers = answerer_.answer(commands, missed, HiddenPlanes{});
        EXPECT_REFLET(refletAnswerRays(view, settings_, REFLET_LOBE_DIFFUSE, &answers, &lobe));
    }

    static double difference(const std::vector<vec4>& a, const std::vector<vec4>& b) {
        double sum = 0.0;
        double of = 0.0;
        for (size_t i = 0; i < a.size(); ++i) {
            sum += std::abs(double(a[i].x) - double(b[i].x));
            of += b[i].x;
        }
        return sum / of;
    }

    HostRoom room_{host_, {.still = true}};
    RayHost answerer_{host_};
    RefletContext context_ = nullptr;
    RefletSettings settings_ = nullptr;
    RefletRadianceCache cache_ = nullptr;
};

// The first frame of a view that has no history, with what another view has seen of the same room. The host's answers
// to rays are part of it.
TEST_F(RadianceCache, WhatOneViewHasSeenIsTheStartOfAnother) {
    for (const bool answered : {false, true}) {
        EXPECT_REFLET(refletResetRadianceCache(cache_));
        const std::vector<vec4> settled = render({.count = 64, .answered = answered});
        const double alone = difference(render({.first = framesBefore, .answered = answered}), settled);
        render({.cache = cache_, .count = framesBefore, .answered = answered});
        const double shared =
            difference(render({.cache = cache_, .first = framesBefore, .answered = answered}), settled);
        EXPECT_GT(alone, 0.02) << answered;
        EXPECT_LT(shared, 0.7 * alone) << answered;
    }
}

TEST_F(RadianceCache, ViewsMayHaveOtherExposures) {
    render({.cache = cache_, .count = framesBefore});
    const std::vector<vec4> same = render({.cache = cache_, .first = framesBefore});
    EXPECT_REFLET(refletResetRadianceCache(cache_));
    render({.cache = cache_, .count = framesBefore, .preExposure = 16.0F});
    EXPECT_LT(difference(render({.cache = cache_, .first = framesBefore, .preExposure = 0.5F}), same), 0.01);
}

TEST_F(RadianceCache, ForgetsWhenItIsReset) {
    const std::vector<vec4> alone = render({.first = framesBefore});
    render({.cache = cache_, .count = framesBefore});
    EXPECT_REFLET(refletResetRadianceCache(cache_));
    EXPECT_EQ(render({.cache = cache_, .first = framesBefore}), alone);
}

TEST_F(RadianceCache, TellsWhatIsWrongWithAHandle) {
    const auto refused = [&](RefletRadianceCache cache, const char* text) {
        RefletView view = makeView(context_, 3);
        host_.host.frame([&](VkCommandBuffer commands) {
            const RefletFrameInfo frame = room_.frame(commands, 0);
            RefletIndirectLight light = room_.light();
            light.radianceCache = cache;
            RefletLobe lobe = emptyLobe();
            EXPECT_REFLET(refletBeginFrame(view, &frame));
            EXPECT_EQ(refletDiffuseGi(view, settings_, &light, &lobe), REFLET_ERROR_INVALID_ARGUMENT);
            EXPECT_NE(std::string(refletLastError()).find(text), std::string::npos) << refletLastError();
            light.radianceCache = nullptr;
            EXPECT_REFLET(refletDiffuseGi(view, settings_, &light, &lobe));
            EXPECT_REFLET(refletEndFrame(view));
        });
        host_.host.waitForAll();
        refletDestroyView(view);
    };
    RefletContext other = host_.makeContext();
    RefletRadianceCache foreign = nullptr;
    EXPECT_REFLET(refletCreateRadianceCache(other, &foreign));
    refused(foreign, "RefletIndirectLight.radianceCache: is of another context");
    refletDestroyContext(other);  // goes with its cache
    refletDestroyRadianceCache(foreign);
    refletDestroyRadianceCache(foreign);
    refused(foreign, "RefletIndirectLight.radianceCache: was not made by this library, or has been destroyed");
    EXPECT_EQ(refletResetRadianceCache(foreign), REFLET_ERROR_INVALID_ARGUMENT);
    EXPECT_EQ(refletCreateRadianceCache(other, &foreign), REFLET_ERROR_INVALID_ARGUMENT);
    EXPECT_EQ(refletCreateRadianceCache(context_, nullptr), REFLET_ERROR_INVALID_ARGUMENT);
}

// Rays wait for answers while their cache is destroyed: what they need of it stays.
TEST_F(RadianceCache, LastsUntilRaysAreAnswered) {
    RefletView view = makeView(context_, 3);
    host_.host.frame([&](VkCommandBuffer commands) {
        RefletRadianceCache brief = nullptr;
        EXPECT_REFLET(refletCreateRadianceCache(context_, &brief));
        const RefletFrameInfo frame = room_.frame(commands, 0);
        RefletIndirectLight light = room_.light();
        light.radianceCache = brief;
        RefletMissedRays missed{};
        missed.structSize = sizeof missed;
        RefletLobe lobe = emptyLobe();
        EXPECT_REFLET(refletBeginFrame(view, &frame));
        EXPECT_REFLET(refletMissedRays(view, settings_, REFLET_LOBE_DIFFUSE, &light, &missed));
        refletDestroyRadianceCache(brief);
        const RefletRayAnswers answers = RayHost::fill(commands, missed, 0.5F);
        EXPECT_REFLET(refletAnswerRays(view, settings_, REFLET_LOBE_DIFFUSE, &answers, &lobe));
        EXPECT_REFLET(refletEndFrame(view));
    });
    host_.host.waitForAll();
    refletDestroyView(view);
}

}  // namespace
}  // namespace reflet::test::radiance_cache_test
