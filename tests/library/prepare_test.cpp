// refletPrepare makes all pipelines that frames of the effects can need, whichever of them run.
#include "library/library_fixture.h"

namespace reflet::test::prepare_test {
namespace {

constexpr uint32_t all = REFLET_EFFECT_SUN_SHADOW | REFLET_EFFECT_CONTACT_SHADOWS | REFLET_EFFECT_DIFFUSE_GI |
                         REFLET_EFFECT_REFLECTIONS | REFLET_EFFECT_DENOISE | REFLET_EFFECT_COMPOSITE |
                         REFLET_EFFECT_TEMPORAL | REFLET_EFFECT_TONE_MAP | REFLET_EFFECT_AMBIENT_OCCLUSION |
                         REFLET_EFFECT_DEPTH_OF_FIELD | REFLET_EFFECT_MOTION_BLUR;

class Prepare : public Library {
protected:
    void prepare(uint32_t effects) {
        const RefletFrameInfo frame = room_.frame(VK_NULL_HANDLE, 0);
        RefletPrepareInfo info{};
        info.structSize = sizeof info;
        info.effects = effects;
        info.gbuffer = frame.gbuffer;
        info.hasEnvironmentImage = 1;
        info.shadowMapSide = 64;
        info.autoExposure = 1;
        const RefletIndirectLight light = lightOfFrames();
        info.light = cache_ != nullptr ? &light : nullptr;
        uint32_t left = 1;
        while (left > 0) {
            EXPECT_REFLET(refletPrepare(view_, settings_, &info, 1000, &left));
        }
    }

    [[nodiscard]] RefletIndirectLight lightOfFrames() const {
        RefletIndirectLight light = room_.light();
        light.radianceCache = cache_;
        return light;
    }

    // effects: those that run. A lobe that is not traced is denoised, if `denoises` has its bit.
    void record(VkCommandBuffer commands, uint32_t index, uint32_t effects, uint32_t denoises) {
        const auto runs = [&](RefletEffect effect) { return (effects & effect) != 0; };
        RefletFrameInfo frame = room_.frame(commands, index);
        frame.backgroundIsEnvironment = 1;
        std::copy_n(frame.worldToView, 16, frame.previousWorldToView);
        std::copy_n(frame.viewToClip, 16, frame.previousViewToClip);
        frame.previousWorldToView[12] += 0.01F * float(index % 2);  // the camera moves in every second frame
        EXPECT_REFLET(refletBeginFrame(view_, &frame));
        RefletSunShadow sun = room_.sun();
        sun.contactShadows = runs(REFLET_EFFECT_CONTACT_SHADOWS) ? 1 : 0;
        RefletImage image{};
        if (runs(REFLET_EFFECT_SUN_SHADOW)) {
            EXPECT_REFLET(refletSunShadow(view_, settings_, &sun, &image));
        }
        if (runs(REFLET_EFFECT_AMBIENT_OCCLUSION)) {
            EXPECT_REFLET(refletAmbientOcclusion(view_, settings_, &image));
        }
        RefletIndirectLight light = lightOfFrames();
        RefletEnvironment around = *light.environment;
        around.image = environment_;
        light.environment = &around;
        RefletLobe lobe = emptyLobe();
        if (runs(REFLET_EFFECT_DIFFUSE_GI)) {
            EXPECT_REFLET(refletDiffuseGi(view_, settings_, &light, &lobe));
        } else if ((denoises & 1U) != 0) {
            EXPECT_REFLET(refletDenoise(view_, settings_, REFLET_LOBE_DIFFUSE, &light.light, &lobe));
        }
        if (runs(REFLET_EFFECT_REFLECTIONS)) {
            EXPECT_REFLET(refletReflections(view_, settings_, &light, &lobe));
        } else if ((denoises & 2U) != 0) {
            EXPECT_REFLET(refletDenoise(view_, settings_, REFLET_LOBE_SPECULAR, &light.light, &lobe));
        }
        const bool composes = runs(REFLET_EFFECT_COMPOSITE);
        RefletComposite sum{};
        sum.structSize = sizeof sum;
        if (composes) {
            EXPECT_REFLET(refletComposite(view_, settings_, &light.light, &sum));
        }
        const RefletImage* own = composes ? nullptr : &light.light;
        if (runs(REFLET_EFFECT_TEMPORAL)) {
            EXPECT_REFLET(refletTemporal(view_, settings_, own, &image));
        }
        if (runs(REFLET_EFFECT_DEPTH_OF_FIELD)) {
            const RefletLens lens{sizeof lens, 0.2F, 3.0F, index % 3 == 0 ? 0U : 6U, 0.1F};
            EXPECT_REFLET(refletDepthOfField(view_, settings_, &lens, own, &image));
        }
        if (runs(REFLET_EFFECT_MOTION_BLUR)) {
            EXPECT_REFLET(refletMotionBlur(view_, settings_, own, &image));
        }
        if (runs(REFLET_EFFECT_TONE_MAP)) {
            EXPECT_REFLET(refletToneMap(view_, settings_, own, 1, &image));
        }
        EXPECT_REFLET(refletEndFrame(view_));
    }

    RefletContext context_ = host_.makeContext();
    RefletSettings settings_ = makeSettings("balanced");
    RefletView view_ = makeView(context_, 3);
    HostRoom room_{host_, {}};
    RefletRadianceCache cache_ = nullptr;
    RefletImage environment_ =
        host_.makeImage(VK_FORMAT_R32G32B32A32_SFLOAT, 256, 128, std::vector<vec4>(size_t(256) * 128, vec4(0.5F)));
};

// Over 5 s: a frame of each combination, a third of them the first of a view.
TEST_F(Prepare, FramesOfAnyOfTheEffectsMakeNoPipeline) {
    EXPECT_REFLET(refletSetSetting(settings_, "ao.method", "horizon"));
    EXPECT_REFLET(refletSetSetting(settings_, "motion_blur.enabled", "true"));
    prepare(all);
    const uint64_t made = LibraryHost::made().pipelines;
    EXPECT_GT(made, 30U);
    constexpr uint32_t varied[] = {REFLET_EFFECT_DIFFUSE_GI,        REFLET_EFFECT_REFLECTIONS,
                                   REFLET_EFFECT_COMPOSITE,         REFLET_EFFECT_TEMPORAL,
                                   REFLET_EFFECT_AMBIENT_OCCLUSION, REFLET_EFFECT_DEPTH_OF_FIELD};
    for (uint32_t i = 0; i < 64 * 3; ++i) {
        uint32_t effects = all;
        for (uint32_t bit = 0; bit < 6; ++bit) {
            effects &= (i >> bit & 1U) != 0 ? ~varied[bit] : ~0U;
        }
        effects &= i % 5 == 0 ? ~uint32_t(REFLET_EFFECT_CONTACT_SHADOWS) : ~0U;
        const uint32_t denoises = i / 64;
        if (denoises > 0 && (effects & REFLET_EFFECT_DIFFUSE_GI) != 0 && (effects & REFLET_EFFECT_REFLECTIONS) != 0) {
            continue;  // there is no lobe of the host's to denoise
        }
        if (i % 3 == 0) {
            EXPECT_REFLET(refletResetView(view_));
        }
        host_.host.frame([&](VkCommandBuffer c) { record(c, i, effects, denoises == 2 ? 3 : denoises); });
        ASSERT_EQ(LibraryHost::made().pipelines, made) << "effects " << std::hex << effects << " denoises " << denoises;
    }
    host_.host.waitForAll();
    refletDestroyView(view_);
    refletDestroySettings(settings_);
    refletDestroyContext(context_);
}

TEST_F(Prepare, FramesWithARadianceCacheMakeNoPipeline) {
    EXPECT_REFLET(refletCreateRadianceCache(context_, &cache_));
    const uint32_t effects = REFLET_EFFECT_DIFFUSE_GI | REFLET_EFFECT_COMPOSITE;
    prepare(effects);
    const uint64_t made = LibraryHost::made().pipelines;
    EXPECT_GT(made, 10U);
    for (uint32_t i = 0; i < 8; ++i) {
        if (i == 4) {
            EXPECT_REFLET(refletResetView(view_));
        }
        host_.host.frame([&](VkCommandBuffer c) { record(c, i, effects, 0); });
        EXPECT_EQ(LibraryHost::made().pipelines, made) << i;
    }
    host_.host.waitForAll();
    refletDestroyView(view_);
    refletDestroyRadianceCache(cache_);
    refletDestroySettings(settings_);
    refletDestroyContext(context_);
}

}  // namespace
}  // namespace reflet::test::prepare_test
