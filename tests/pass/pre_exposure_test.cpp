// Light in any unit: lights that are brighter by a factor give the same picture, brighter by that factor.
#include "renderer/pre_exposure.h"

#include "base/exposure.h"
#include "capture/show.h"
#include "pass/harness.h"
#include "renderer/presets.h"
#include "scene/builtin/shapes.h"

#include <algorithm>
#include <cmath>

namespace reflet::test::pre_exposure_test {
namespace {

constexpr uvec2 size(60, 34);

// A box and a metal ball on a floor beside a wall that emits, under a lamp.
Scene lit(float factor) {
    Scene scene;
    Material floor = lambertMaterial({0.6F, 0.5F, 0.4F});
    const uint32_t grey = builtin::addMaterial(scene, floor);
    Material metal = floor;
    metal.metallic = 1.0F;
    metal.roughness = 0.2F;
    Material glowing = floor;
    glowing.emissive = factor * vec3(2.0F, 1.0F, 0.5F);
    builtin::place(scene, "floor", grey, builtin::ground({3, 3}, {1, 1}, {1, 1}));
    builtin::place(scene, "ball", builtin::addMaterial(scene, metal), builtin::sphere(0.5F, 24));
    builtin::place(scene, "glow", builtin::addMaterial(scene, glowing),
                   builtin::patch({{-1.5F, 0.5F, 0}, {0, 0, -0.5F}, {0, 0.5F, 0}}));
    Lamp lamp;
    lamp.position = {1, 2, 1};
    lamp.intensity = factor * vec3(3.0F);
    scene.lamps.push_back(lamp);
    return scene;
}

View seen(float factor) {
    View view;
    view.camera = builtin::camera("front", {0, 1.5F, 4}, {0, 0.3F, 0}, 50);
    view.sun = builtin::sun(glm::normalize(vec3(0.4F, -0.9F, -0.3F)), factor * vec3(2.0F));
    view.environment.radiance = factor * vec3(0.3F, 0.4F, 0.5F);
    return view;
}

FloatImage pictureOf(float factor) {
    Settings settings;
    applyPreset(settings, "balanced");
    settings.probes.resolution = 16;  // large ones take most of the time
    FloatImage image = render(lit(factor), seen(factor), size, settings, {"final"}, 2).images.at("final");
    std::ranges::for_each(image.data, [&](float& v) { v /= factor; });
    return image;
}

double meanDifference(const FloatImage& a, const FloatImage& b) {
    double sum = 0.0;
    double all = 0.0;
    for (size_t i = 0; i < a.data.size(); ++i) {
        sum += std::abs(double(a.data[i]) - b.data[i]);
        all += b.data[i];
    }
    return sum / all;
}

TEST(PreExposure, LightTimesAFactorIsTheSamePicture) {
    const FloatImage usual = pictureOf(1.0F);
    const FloatImage bright = pictureOf(0x1p20F);
    EXPECT_EQ(pictureOf(0x1p-14F).data, bright.data);
    EXPECT_LT(meanDifference(bright, usual), 0.01);
}

TEST(PreExposure, UnlitSurfacesKeepTheirRadiance) {
    Material unlit = lambertMaterial({0.5F, 0.25F, 1.0F});
    unlit.unlit = true;
    Scene scene = sceneOf(unlit, builtin::box({2, 2, 0.1F}));
    const float factor = 1e5F;
    const Scene others = lit(factor);
    scene.lamps = others.lamps;
    const vec3 color = render(scene, seen(factor), size, settingsOf({}), {"final"}).color("final", 32, 18);
    EXPECT_NEAR(glm::length(color - vec3(0.5F, 0.25F, 1.0F)), 0.0F, 0.02F);
}

TEST(PreExposure, FollowsLightThatChangesByManyStops) {
    const Settings settings = settingsOf({});
    const Scene scene = sceneOf(lambertMaterial(vec3(0.5F)), builtin::box({2, 2, 0.1F}));
    const auto now = renderPath(scene, {seen(1.0F), seen(1.0F), seen(1e6F)}, size, settings, {"final"}).back();
    const auto alone = render(scene, seen(1e6F), size, settings, {"final"});
    EXPECT_LT(meanDifference(now.images.at("final"), alone.images.at("final")), 0.05);
    EXPECT_GT(rangeOf(now.images.at("final")).max, largestHalf);
}

TEST(PreExposure, IsOneForOrdinaryLight) {
    PreExposure exposure(lit(1.0F));
    LampBlock none{};
    for (const float factor : {0.1F, 1.0F, 10.0F}) {
        EXPECT_EQ(exposure.update(none, seen(factor)), 1.0F) << factor;
    }
    const float bright = exposure.update(none, seen(1e5F));
    EXPECT_LT(bright, 1e-4F);
    EXPECT_EQ(exposure.update(none, seen(2e4F)), bright);  // as it was, as long as that fits
    EXPECT_EQ(exposure.update(none, seen(1.0F)), 1.0F);
    EXPECT_GT(PreExposure(Scene{}).update(none, seen(1e-4F)), 1e2F);
    EXPECT_EQ(preExposureFor(0.0F, 0.25F), 0.25F);
}

}  // namespace
}  // namespace reflet::test::pre_exposure_test
