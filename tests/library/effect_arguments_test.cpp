// Every argument of the effects of the C API wrong in turn, as in arguments_test.cpp.
#include "library/arguments_fixture.h"

#include <array>
#include <cmath>
#include <cstring>

namespace reflet::test {
namespace {

// What is recorded is between the beginning and the end of a frame.
class EffectArguments : public Arguments {
protected:
    void inAFrame(const std::function<void()>& record) {
        host_.host.frame([&](VkCommandBuffer commands) {
            const RefletFrameInfo info = room_.frame(commands, 0);
            EXPECT_REFLET(refletBeginFrame(view_, &info));
            record();
            EXPECT_REFLET(refletEndFrame(view_));
        });
    }
    void expectLightError(const std::string& field, const std::function<void(RefletIndirectLight&)>& spoil) {
        RefletIndirectLight given = room_.light();
        spoil(given);
        expectError(refletDiffuseGi(view_, settings_, &given, &lobe_), field);
        expectError(refletReflections(view_, settings_, &given, &lobe_), field);
    }
    void expectEnvironmentError(const std::string& field, const std::function<void(RefletEnvironment&)>& spoil) {
        RefletEnvironment spoiled = *light_.environment;
        spoil(spoiled);
        expectLightError(field, [&](RefletIndirectLight& l) { l.environment = &spoiled; });
    }
    void expectProbeError(const std::string& field, const std::function<void(RefletProbe&)>& spoil) {
        RefletProbe spoiled{};
        spoiled.structSize = sizeof spoiled;
        spoiled.boxHalfExtents[0] = spoiled.boxHalfExtents[1] = spoiled.boxHalfExtents[2] = 1.0F;
        spoiled.radiance = cube_;
        spoil(spoiled);
        expectLightError("probes[0]." + field, [&](RefletIndirectLight& l) {
            l.probes = &spoiled;
            l.probeCount = 1;
        });
    }
    void expectPlanarError(const std::string& field, const std::function<void(RefletPlanarView&)>& spoil) {
        RefletPlanarView spoiled{};
        spoiled.structSize = sizeof spoiled;
        spoiled.color = light_.light;
        spoiled.depth = room_.frame(VK_NULL_HANDLE, 0).gbuffer->depth;
        const RefletFrameInfo camera = room_.frame(VK_NULL_HANDLE, 0);
        std::memcpy(spoiled.worldToView, camera.worldToView, sizeof spoiled.worldToView);
        std::memcpy(spoiled.viewToClip, camera.viewToClip, sizeof spoiled.viewToClip);
        spoiled.plane[1] = 1.0F;
        spoil(spoiled);
        expectLightError("planarViews[0]." + field, [&](RefletIndirectLight& l) {
            l.planarViews = &spoiled;
            l.planarViewCount = 1;
        });
    }
    void expectSunError(const std::string& field, const std::function<void(RefletSunShadow&)>& spoil) {
        RefletSunShadow given = room_.sun();
        spoil(given);
        expectError(refletSunShadow(view_, settings_, &given, &image_), field);
    }
    void expectLensError(const std::string& field, const std::function<void(RefletLens&)>& spoil) {
        RefletLens given{sizeof given, 0.1F, 2.0F, 6, 0.0F};
        spoil(given);
        expectError(refletDepthOfField(view_, settings_, &given, &light_.light, &image_), field);
    }

    RefletLobe lobe_ = emptyLobe();
    RefletImage image_{};
    RefletComposite sum_{sizeof sum_, {}, {}, {}};
    RefletIndirectLight light_ = room_.light();
    RefletImage cube_ = host_.makeCube(VK_FORMAT_R32G32B32A32_SFLOAT, 16, std::vector<vec4>(size_t(6) * 16 * 16));
};

TEST_F(EffectArguments, OfProbesAndPlanarViews) {
    inAFrame([&] {
        expectLightError("probeCount", [](auto& l) { l.probeCount = REFLET_MAX_PROBES + 1; });
        expectLightError("probes", [](auto& l) { l.probeCount = 1; });
        expectLightError("planarViewCount", [](auto& l) { l.planarViewCount = REFLET_MAX_PLANAR_VIEWS + 1; });
        expectLightError("planarViews", [](auto& l) { l.planarViewCount = 1; });
        expectLightError("planarViewsAfterScreen", [](auto& l) { l.planarViewsAfterScreen = 2; });
        expectLightError("irradianceKind", [](auto& l) { l.irradianceKind = RefletIrradianceKind(2); });
        expectLightError("specularFallback.width", [&](auto& l) { l.specularFallback = cube_; });
        expectLightError("irradiance.format", [](auto& l) {
            l.irradiance = l.light;
            l.irradiance.format = VK_FORMAT_R32_SFLOAT;
        });
        expectProbeError("structSize", [](auto& p) { p.structSize = 8; });
        expectProbeError("position", [](auto& p) { p.position[1] = NAN; });
        expectProbeError("boxCenter", [](auto& p) { p.boxCenter[1] = INFINITY; });
        expectProbeError("boxHalfExtents", [](auto& p) { p.boxHalfExtents[2] = 0.0F; });
        expectProbeError("blend", [](auto& p) { p.blend = -1.0F; });
        expectProbeError("factor", [](auto& p) { p.factor = -1.0F; });
        expectProbeError("factor", [](auto& p) { p.factor = NAN; });
        expectProbeError("parallax", [](auto& p) { p.parallax = RefletParallax(3); });
        expectProbeError("distance.image", [](auto& p) { p.parallax = REFLET_PARALLAX_DEPTH; });
        expectProbeError("parallaxHalfExtents", [](auto& p) { p.parallaxHalfExtents[0] = -1.0F; });
        expectProbeError("radiance.image", [](auto& p) { p.radiance.image = VK_NULL_HANDLE; });
        expectProbeError("radiance.width", [](auto& p) { p.radiance.width = 8; });
        expectProbeError("radianceLevels", [](auto& p) { p.radianceLevels = 6; });
        expectProbeError("alphaIsCoverage", [](auto& p) { p.alphaIsCoverage = 2; });
        expectProbeError("irradianceKind", [](auto& p) { p.irradianceKind = RefletIrradianceKind(2); });
        std::array<float, 27> coefficients{};
        expectProbeError("sphericalHarmonics", [&](auto& p) {
            p.irradiance = cube_;
            p.sphericalHarmonics = coefficients.data();
        });
        coefficients[5] = NAN;
        expectProbeError("sphericalHarmonics", [&](auto& p) { p.sphericalHarmonics = coefficients.data(); });
        expectPlanarError("structSize", [](auto& p) { p.structSize = 0; });
        expectPlanarError("color.image", [](auto& p) { p.color.image = VK_NULL_HANDLE; });
        expectPlanarError("depth.format", [](auto& p) { p.depth.format = VK_FORMAT_R8_UNORM; });
        expectPlanarError("depth.width", [](auto& p) { p.depth.width = 3; });
        expectPlanarError("depthKind", [](auto& p) { p.depthKind = RefletDepthKind(7); });
        expectPlanarError("clipYUp", [](auto& p) { p.clipYUp = 3; });
        expectPlanarError("worldToView", [](auto& p) { p.worldToView[0] = 3.0F; });
        expectPlanarError("viewToClip", [](auto& p) { p.viewToClip[0] = NAN; });
        expectPlanarError("plane", [](auto& p) { p.plane[1] = 2.0F; });
        expectPlanarError("tolerance", [](auto& p) { p.tolerance = -1.0F; });
    });
}

TEST_F(EffectArguments, OfIndirectLight) {
    expectError(refletDiffuseGi(view_, settings_, &light_, &lobe_), "no frame has begun");
    inAFrame([&] {
        expectLightError("structSize", [](auto& l) { l.structSize = 3; });
        expectLightError("structSize", [](auto& l) { l.structSize = sizeof l - 4; });  // half of its last pointer
        expectLightError("light.image", [](auto& l) { l.light.image = VK_NULL_HANDLE; });
        expectLightError("light.format", [](auto& l) { l.light.format = VK_FORMAT_R8G8B8A8_UINT; });
        expectEnvironmentError("structSize", [](auto& e) { e.structSize = 4; });
        expectEnvironmentError("factor", [](auto& e) { e.factor[1] = -1.0F; });
        expectEnvironmentError("factor", [](auto& e) { e.factor[2] = INFINITY; });
        expectEnvironmentError("rotation", [](auto& e) { e.rotation = NAN; });
        expectEnvironmentError("worldUp", [](auto& e) { e.worldUp[2] = NAN; });
        expectEnvironmentError("Environment.image", [&](auto& e) {
            e.image = light_.light;
            e.image.view = VK_NULL_HANDLE;
        });
        expectError(refletDiffuseGi(view_, settings_, nullptr, &lobe_), "RefletIndirectLight");
        expectError(refletDiffuseGi(view_, settings_, &light_, nullptr), "lobe");
        expectError(refletReflections(view_, nullptr, &light_, &lobe_), "settings");
    });
}

TEST_F(EffectArguments, OfLampShadows) {
    RefletLampShadow right{};
    right.structSize = sizeof right;
    right.map = host_.makeImage(VK_FORMAT_R32_SFLOAT, 16, 16, std::vector<float>(256));
    const float toClip[16] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 0, 1, 0, 0, 0.1F, 0};  // along +z
    std::memcpy(right.worldToClip[0], toClip, sizeof toClip);
    const auto expectLampError = [&](const std::string& field, const std::function<void(RefletLampShadow&)>& spoil) {
        RefletLampShadow given[2] = {right, right};
        spoil(given[1]);
        expectError(refletLampShadows(view_, settings_, given, 2, &image_), "lamps[1]." + field);
    };
    inAFrame([&] {
        expectLampError("position", [](auto& l) { l.position[0] = NAN; });
        expectLampError("worldToClip[0]", [](auto& l) { l.position[0] = 1.0F; });
        expectLampError("worldToClip[0]", [](auto& l) { l.worldToClip[0][3] = INFINITY; });
        expectLampError("worldToClip[0]", [](auto& l) { l.worldToClip[0][0] = 2.0F; });
        expectLampError("worldToClip[0]", [](auto& l) { l.worldToClip[0][11] = 0.0F; });
        expectLampError("worldToClip[1]", [](auto& l) {
            l.kind = REFLET_LAMP_MAP_SIX_TILES;
            l.tiles[0][2] = 4;
        });
        expectLampError("radius", [](auto& l) { l.radius = -1.0F; });
        expectLampError("range", [](auto& l) { l.range = INFINITY; });
        expectLampError("direction", [](auto& l) { l.direction[2] = NAN; });
        expectLampError("coneAngle", [](auto& l) { l.direction[2] = 1.0F; });
        expectLampError("kind", [](auto& l) { l.kind = RefletLampMapKind(3); });
        expectLampError("map.image", [](auto& l) { l.map.image = VK_NULL_HANDLE; });
        expectLampError("map.format", [](auto& l) { l.map.format = VK_FORMAT_R8G8B8A8_UNORM; });
        expectLampError("map.width", [](auto& l) {
            l.kind = REFLET_LAMP_MAP_CUBE;
            l.map.width = 8;
        });
        expectLampError("nearPlane", [](auto& l) { l.kind = REFLET_LAMP_MAP_CUBE; });
        expectLampError("farPlane", [](auto& l) {
            l.kind = REFLET_LAMP_MAP_CUBE;
            l.nearPlane = 2.0F;
            l.farPlane = 1.0F;
        });
        expectLampError("depth", [](auto& l) { l.depth = RefletLampDepth(3); });
        expectLampError("distanceScale", [](auto& l) {
            l.depth = REFLET_LAMP_DEPTH_DISTANCE;
            l.distanceScale = -1.0F;
        });
        expectLampError("clipYUp", [](auto& l) { l.clipYUp = 2; });
        expectLampError("tiles[0]", [](auto& l) { l.tiles[0][2] = 17; });
        expectLampError("tiles[0]", [](auto& l) { l.kind = REFLET_LAMP_MAP_SIX_TILES; });
        expectError(refletLampShadows(view_, settings_, &right, 0, &image_), "count");
        expectError(refletLampShadows(view_, settings_, &right, REFLET_MAX_LAMP_SHADOWS + 1, &image_), "count");
        expectError(refletLampShadows(view_, settings_, nullptr, 1, &image_), "lamps[0]");
        expectError(refletLampShadows(view_, settings_, &right, 1, nullptr), "visibility");
        EXPECT_REFLET(refletSetSetting(settings_, "shadow.filter", "none"));
        expectError(refletLampShadows(view_, settings_, &right, 1, &image_), "shadow.filter");
    });
}

TEST_F(EffectArguments, OfTheSunsShadow) {
    inAFrame([&] {
        expectSunError("map.image", [](auto& s) { s.map.image = VK_NULL_HANDLE; });
        expectSunError("map", [](auto& s) { s.map.width = 32; });
        expectSunError("cascades", [](auto& s) { s.cascades = 0; });
        expectSunError("cascades", [](auto& s) { s.cascades = 5; });
        expectSunError("map.format", [](auto& s) { s.map.format = VK_FORMAT_R8G8B8A8_UNORM; });
        expectSunError("depthKind", [](auto& s) { s.depthKind = RefletDepthKind(2); });
        expectSunError("clipYUp", [](auto& s) { s.clipYUp = 5; });
        expectSunError("contactShadows", [](auto& s) { s.contactShadows = 2; });
        expectSunError("cascadeSplits", [](auto& s) { s.cascades = 2; });
        expectSunError("worldToClip", [](auto& s) { s.worldToClip[0][2] = NAN; });
        expectSunError("worldToClip", [](auto& s) { s.worldToClip[0][15] = 0.0F; });
        expectSunError("toSun", [](auto& s) { s.toSun[1] = 0.0F; });
        expectSunError("angularDiameter", [](auto& s) { s.angularDiameter = -1.0F; });
        const RefletSunShadow right = room_.sun();
        expectError(refletSunShadow(view_, settings_, &right, nullptr), "visibility");
        EXPECT_REFLET(refletSetSetting(settings_, "shadow.filter", "traced"));
        expectError(refletSunShadow(view_, settings_, &right, &image_), "shadow.filter");
    });
}

TEST_F(EffectArguments, OfTheSunsSide) {
    // Row 2, column 1: depth by height, under a sun at the zenith.
    const auto sun = [](RefletSunShadow& s, RefletDepthKind kind, float rise) {
        s.depthKind = kind;
        s.worldToClip[0][6] = rise;
    };
    inAFrame([&] {
        expectSunError("toward the sun", [&](auto& s) { sun(s, REFLET_DEPTH_REVERSED, -0.05F); });
        expectSunError("toward the sun", [&](auto& s) { sun(s, REFLET_DEPTH_STANDARD, 0.05F); });
        expectSunError("toward the sun", [&](auto& s) {
            sun(s, REFLET_DEPTH_REVERSED, 0.05F);
            s.toSun[1] = -1.0F;
        });
        RefletSunShadow right = room_.sun();
        sun(right, REFLET_DEPTH_STANDARD, -0.05F);
        EXPECT_REFLET(refletSunShadow(view_, settings_, &right, &image_));
    });
}

TEST_F(EffectArguments, OfASecondCallInAFrame) {
    const RefletSunShadow sun = room_.sun();
    const RefletLens lens{sizeof lens, 0.05F, 3.0F, 0, 0.0F};
    RefletImage out{};
    EXPECT_REFLET(refletSetSetting(settings_, "ao.method", "bitmask"));
    const auto twice = [&](const std::function<RefletResult()>& call) {
        EXPECT_EQ(call(), REFLET_SUCCESS) << refletLastError();
        expectError(call(), "one history");
    };
    inAFrame([&] {
        twice([&] { return refletSunShadow(view_, settings_, &sun, &out); });
        twice([&] { return refletAmbientOcclusion(view_, settings_, &out); });
        twice([&] { return refletDiffuseGi(view_, settings_, &light_, &lobe_); });
        twice([&] { return refletReflections(view_, settings_, &light_, &lobe_); });
        EXPECT_REFLET(refletComposite(view_, settings_, nullptr, &sum_));
        twice([&] { return refletTemporal(view_, settings_, nullptr, &out); });
        twice([&] { return refletDepthOfField(view_, settings_, &lens, nullptr, &out); });
    });
}

TEST_F(EffectArguments, OfTheLens) {
    inAFrame([&] {
        expectLensError("apertureRadius", [](auto& l) { l.apertureRadius = -1.0F; });
        expectLensError("apertureRadius", [](auto& l) { l.apertureRadius = NAN; });
        expectLensError("focusDistance", [](auto& l) { l.focusDistance = 0.0F; });
        expectLensError("focusDistance", [](auto& l) { l.focusDistance = INFINITY; });
        expectLensError("blades", [](auto& l) { l.blades = 2; });
        expectLensError("blades", [](auto& l) { l.blades = 17; });
        expectLensError("bladeRotation", [](auto& l) { l.bladeRotation = NAN; });
        expectLensError("structSize", [](auto& l) { l.structSize = 0; });
        const RefletLens thin{sizeof thin, 0.1F, 2.0F, 0, 0.0F};
        expectError(refletDepthOfField(view_, settings_, &thin, nullptr, &image_), "color");
        expectError(refletDepthOfField(view_, settings_, &thin, &light_.light, nullptr), "blurred");
        expectError(refletDepthOfField(view_, settings_, nullptr, &light_.light, &image_), "RefletLens");
    });
}

TEST_F(EffectArguments, OfOtherEffects) {
    inAFrame([&] {
        expectError(refletMotionBlur(view_, settings_, nullptr, &image_), "color");
        expectError(refletMotionBlur(view_, settings_, &light_.light, nullptr), "blurred");
        expectError(refletAmbientOcclusion(view_, settings_, &image_), "ao.method");
        expectError(refletAmbientOcclusion(view_, settings_, nullptr), "occlusion");
        expectError(refletComposite(view_, settings_, nullptr, &sum_), "light");
        expectError(refletComposite(view_, settings_, &light_.light, nullptr), "RefletComposite");
        expectError(refletTemporal(view_, settings_, nullptr, &image_), "color");
        expectError(refletToneMap(view_, settings_, nullptr, 0, &image_), "color");
        expectError(refletToneMap(view_, settings_, &image_, 0, &image_), "color.image");
        expectError(refletDenoise(view_, settings_, RefletLobeKind(2), &light_.light, &lobe_), "kind");
        expectError(refletDenoise(view_, settings_, REFLET_LOBE_DIFFUSE, nullptr, &lobe_), "noisy");
    });
    expectError(refletFindImage(view_, "dept", &image_), "depth");
    expectError(refletPassTimes(view_, nullptr, nullptr), "count");
}

TEST_F(EffectArguments, OfMissedRays) {
    RefletMissedRays missed{};
    missed.structSize = sizeof missed;
    RefletRayAnswers answers{sizeof answers, 0, 0};
    constexpr RefletLobeKind specular = REFLET_LOBE_SPECULAR;
    const auto ask = [&](const RefletIndirectLight* light, RefletMissedRays* out) {
        return refletMissedRays(view_, settings_, specular, light, out);
    };
    expectError(ask(&light_, &missed), "no frame has begun");
    inAFrame([&] {
        expectError(refletMissedRays(view_, settings_, RefletLobeKind(5), &light_, &missed), "kind");
        expectError(ask(nullptr, &missed), "RefletIndirectLight");
        expectError(ask(&light_, nullptr), "RefletMissedRays");
        missed.structSize = 4;
        expectError(ask(&light_, &missed), "RefletMissedRays.structSize");
        missed.structSize = sizeof missed + 8;
        expectError(ask(&light_, &missed), "RefletMissedRays.structSize", REFLET_ERROR_INCOMPATIBLE_VERSION);
        missed.structSize = sizeof missed;
        RefletIndirectLight dark = light_;
        dark.light.image = VK_NULL_HANDLE;
        expectError(ask(&dark, &missed), "light.image");
        EXPECT_REFLET(refletSetSetting(settings_, "diffuse.adaptive", "false"));
        for (const char* rays : {"0", "17"}) {
            EXPECT_REFLET(refletSetSetting(settings_, "diffuse.rays", rays));
            expectError(refletMissedRays(view_, settings_, REFLET_LOBE_DIFFUSE, &light_, &missed), "diffuse.rays");
        }
        expectError(refletAnswerRays(view_, settings_, specular, &answers, &lobe_), "no rays wait");
        EXPECT_REFLET(ask(&light_, &missed));
        EXPECT_GT(missed.capacity, 0U);
        EXPECT_EQ(missed.rays.size, sizeof(RefletMissedRayHeader) + missed.capacity * sizeof(RefletMissedRay));
        EXPECT_EQ(missed.answers.size, missed.capacity * sizeof(RefletRayAnswer));
        EXPECT_REFLET(refletAnswerRays(view_, settings_, specular, &answers, &lobe_));
    });
}

// What would lose the rays is refused, and loses nothing.
TEST_F(EffectArguments, OfAnswersToMissedRays) {
    RefletMissedRays missed{};
    missed.structSize = sizeof missed;
    RefletRayAnswers answers{sizeof answers, 0, 0};
    constexpr RefletLobeKind specular = REFLET_LOBE_SPECULAR;
    const auto answer = [&](RefletLobeKind kind, const RefletRayAnswers* given, RefletLobe* out) {
        return refletAnswerRays(view_, settings_, kind, given, out);
    };
    inAFrame([&] {
        EXPECT_REFLET(refletMissedRays(view_, settings_, specular, &light_, &missed));
        expectError(refletMissedRays(view_, settings_, specular, &light_, &missed), "refletAnswerRays");
        expectError(refletReflections(view_, settings_, &light_, &lobe_), "refletAnswerRays");
        expectError(refletDiffuseGi(view_, settings_, &light_, &lobe_), "refletAnswerRays");
        expectError(refletDenoise(view_, settings_, specular, &light_.light, &lobe_), "refletAnswerRays");
        expectError(refletComposite(view_, settings_, nullptr, &sum_), "refletAnswerRays");
        expectError(refletEndFrame(view_), "REFLET_LOBE_SPECULAR");
        expectError(answer(REFLET_LOBE_DIFFUSE, &answers, &lobe_), "are of REFLET_LOBE_SPECULAR");
        expectError(answer(RefletLobeKind(3), &answers, &lobe_), "kind");
        expectError(answer(specular, nullptr, &lobe_), "RefletRayAnswers");
        expectError(answer(specular, &answers, nullptr), "lobe");
        answers.structSize = 1;
        expectError(answer(specular, &answers, &lobe_), "structSize");
        answers = {sizeof answers, 0, VK_ACCESS_2_SHADER_WRITE_BIT};
        expectError(answer(specular, &answers, &lobe_), "RefletRayAnswers.stages");
        answers.access = 0;
        const RefletSunShadow sun = room_.sun();
        EXPECT_REFLET(refletSunShadow(view_, settings_, &sun, &image_));
        EXPECT_REFLET(answer(specular, &answers, &lobe_));
        expectError(answer(specular, &answers, &lobe_), "no rays wait");
        EXPECT_REFLET(refletComposite(view_, settings_, nullptr, &sum_));
    });
}

TEST_F(EffectArguments, OfCallsBetweenFrames) {
    host_.host.frame([&](VkCommandBuffer commands) {
        const RefletFrameInfo info = room_.frame(commands, 0);
        EXPECT_REFLET(refletBeginFrame(view_, &info));
        expectError(refletBeginFrame(view_, &info), "begun already");
        expectError(refletResizeView(view_, 4, 4), "begun");
        expectError(refletSetOutputSize(view_, 4, 4), "begun");
        expectError(refletFinishView(view_), "begun");
        EXPECT_REFLET(refletEndFrame(view_));
    });
}

TEST_F(EffectArguments, OfPreparing) {
    RefletPrepareInfo prepare{};
    uint32_t left = 0;
    expectError(refletPrepare(view_, settings_, &prepare, 1, &left), "structSize");
    prepare.structSize = sizeof prepare;
    expectError(refletPrepare(view_, settings_, &prepare, 1, &left), "gbuffer");
    const RefletFrameInfo info = room_.frame(nullptr, 0);
    prepare.gbuffer = info.gbuffer;
    expectError(refletPrepare(view_, settings_, &prepare, 1, &left), "effects");
    prepare.effects = 1U << 20U;
    expectError(refletPrepare(view_, settings_, &prepare, 1, &left), "effects");
}

}  // namespace
}  // namespace reflet::test
