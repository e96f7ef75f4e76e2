// Suns in environment images against the path tracer, which samples the image itself.
#include "compare/compare.h"
#include "pass/harness.h"
#include "reference/reference.h"
#include "renderer/presets.h"
#include "scene/environment.h"

#include <memory>

namespace reflet::test::image_suns_test {
namespace {

constexpr uvec2 size(60, 34);

// A sky of 0.4 with a sun of 2x2 texels.
Environment sunnySky() {
    FloatImage image{256, 128, {"R", "G", "B"}, std::vector<float>(size_t{3} * 256 * 128, 0.4F)};
    for (const uint32_t row : {39U, 40U}) {
        for (const uint32_t column : {170U, 171U}) {
            for (uint32_t channel = 0; channel < 3; ++channel) {
                image.data[3 * (row * 256 + column) + channel] = 12000.0F - 2000.0F * static_cast<float>(channel);
            }
        }
    }
    Environment environment;
    environment.image = std::make_shared<FloatImage>(std::move(image));
    return environment;
}

Scene boxOnGround() {
    Scene scene = sceneOf(lambertMaterial(vec3(0.6F)), builtin::ground({6, 6}, {1, 1}, {1, 1}));
    builtin::place(scene, "box", builtin::addMesh(scene, "box", 0, builtin::box({0.4F, 0.8F, 0.4F})),
                   builtin::at({0, 0.8F, 0}));
    return scene;
}

View viewOf(const Environment& environment) {
    View view;
    view.camera.position = {-1.5F, 2.2F, 4.0F};
    view.camera.target = {0, 0.6F, 0};
    view.environment = environment;
    return view;
}

TEST(ImageSuns, LightAndCastShadowsAsInTheReference) {
    const Scene scene = boxOnGround();
    View view = viewOf(sunnySky());
    view.environment.rotation = 0.6F;
    ReferenceOptions options;
    options.samples = 64;
    const ReferencePicture truth = traceReference(scene, view, size, options);
    Settings settings;
    applyPreset(settings, "balanced");
    settings.probes.resolution = 16;  // large ones take most of the time
    const Pictures p = renderMean(scene, view, size, settings, {"final"}, 8);
    const Difference d = compareImages(p.images.at("final"), truth.final, {}).difference;
    EXPECT_LT(d.relativeMse, 0.025);  // a single object has no probes; with them: 0.02
    EXPECT_LT(std::abs(d.bias), 0.04);
}

TEST(ImageSuns, StayInTheBackgroundAndGoWithTheEnvironment) {
    View view = viewOf(sunnySky());
    view.camera.target = view.camera.position + environmentDirection(vec2(171, 40) / vec2(256, 128), 0.0F);
    view.camera.fovY = 0.05F;
    const Scene scene = boxOnGround();
    for (const char* enabled : {"environment.enabled=true", "environment.enabled=false"}) {
        const Pictures p = render(scene, view, size, settingsOf({enabled}), {"final"});
        EXPECT_NEAR(p.color("final", 30, 17).r, 12000.0F, 20.0F) << enabled;
    }
    view.camera.target = {0, 0.6F, 0};
    view.camera.fovY = 0.1F;
    const Pictures p = render(scene, view, size, settingsOf({"environment.enabled=false"}), {"direct"});
    EXPECT_EQ(rangeOf(p.images.at("direct")).max, 0.0F);
}

}  // namespace
}  // namespace reflet::test::image_suns_test
