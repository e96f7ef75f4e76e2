// Suns in environment images against the path tracer, which samples the image itself.
#include "compare/compare.h"
#include "pass/lamp_room.h"
#include "reference/reference.h"
#include "renderer/presets.h"
#include "scene/environment.h"

#include <memory>

namespace reflet::test::image_suns_test {
namespace {

constexpr uvec2 size(60, 34);

// A sky of 0.4 with suns of 2x2 texels from these columns on, each weaker than the one before.
Environment sunnySky(const std::vector<uint32_t>& columns = {170}) {
    FloatImage image{256, 128, {"R", "G", "B"}, std::vector<float>(size_t{3} * 256 * 128, 0.4F)};
    for (const uint32_t row : {39U, 40U}) {
        for (size_t i = 0; i < 2 * columns.size(); ++i) {
            const uint32_t column = columns[i / 2] + i % 2;
            for (uint32_t channel = 0; channel < 3; ++channel) {
                image.data[3 * (row * 256 + column) + channel] =
                    (12000.0F - 2000.0F * static_cast<float>(channel)) / static_cast<float>(1 + i / 2);
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

TEST(ImageSuns, AllCastShadows) {
    View view = viewOf(sunnySky({170, 100}));
    const vec3 toSecond = environmentDirection(vec2(101, 40) / vec2(256, 128), 0.0F);
    const Pictures p = render(boxOnGround(), view, size, settingsOf({"diffuse.rays=0", "specular.rays=0"}),
                              {"lamp_visibility", "depth"});
    unsigned dark = 0;
    unsigned lit = 0;
    for (unsigned y = 0; y < size.y; ++y) {
        for (unsigned x = 0; x < size.x; ++x) {
            if (!p.hasSurface(x, y) || std::abs(p.position(x, y).y) > 1e-3F) {
                continue;
            }
            const vec3 at = p.position(x, y);
            const auto shadowed = [&](float grown) {
                return meets({vec3(-0.4F, 0, -0.4F) - grown, vec3(0.4F, 1.6F, 0.4F) + grown}, at,
                             at + 10.0F * toSecond);
            };
            if (shadowed(-0.1F)) {  // the penumbra is up to 0.1 m wide
                EXPECT_LT(p.value("lamp_visibility", x, y), 0.02F) << at.x << ", " << at.z;
                ++dark;
            } else if (!shadowed(0.1F)) {
                EXPECT_GT(p.value("lamp_visibility", x, y), 0.98F) << at.x << ", " << at.z;
                ++lit;
            }
        }
    }
    EXPECT_GT(dark, 20U);
    EXPECT_GT(lit, 500U);
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
