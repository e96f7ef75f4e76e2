// Effect of a depth buffer of low precision on the frame.
#include "pass/harness.h"

#include <algorithm>
#include <cmath>

namespace reflet::test::kept_depth_test {
namespace {

constexpr uvec2 size(96, 54);
const std::string standard16 = "depth.format=standard16";
const std::string standard24 = "depth.format=standard24";

// Errors of the depth image on an endless floor 1 m under the camera, near plane at 0.1 mm.
struct Errors {
    double relative = 0.0;  // largest |d' - d| / (d · d') [1/m]: half a step of 1 / distance
    double atFive = 0.0;    // largest |d' - d| from 4.5 to 5.5 m [m]
};

Errors errorsOf(const std::vector<std::string>& assignments) {
    View view;
    view.camera.position = {0, 1, 0};
    view.camera.target = {0, 0, -5};
    view.camera.up = {0.5F, 1, 0};  // so that the pixels of a row differ in depth
    view.camera.near = 1e-4F;
    const Scene scene = sceneOf(lambertMaterial(vec3(0.5F)), builtin::ground({50, 50}, {1, 1}, {1, 1}));
    auto all = assignments;
    all.insert(all.end(), {"diffuse.rays=0", "specular.rays=0"});
    const Pictures p = render(scene, view, size, settingsOf(all), {"depth"});
    const vec3 forward = glm::normalize(view.camera.target - view.camera.position);
    Errors errors;
    for (unsigned y = 0; y < size.y; ++y) {
        for (unsigned x = 0; x < size.x; ++x) {
            const vec3 d = pixelDirection(view.camera, size, x, y);
            const double expected = glm::dot(d, forward) * (-1.0F / d.y);
            if (!p.hasSurface(x, y) || expected < 1.0 || expected > 10.0) {
                continue;
            }
            const double got = p.value("depth", x, y);
            errors.relative = std::max(errors.relative, std::abs(got - expected) / (got * expected));
            if (expected > 4.5 && expected < 5.5) {
                errors.atFive = std::max(errors.atFive, std::abs(got - expected));
            }
        }
    }
    return errors;
}

// 1 / d is kept in steps of 1 / (near · 2^16): at distance d half a step is d² / (near · 2^17), 1.9 m at 5 m.
TEST(KeptDepth, OfSixteenBitsIsOffByHalfAStepWhichIsMetresWithATinyNearPlane) {
    const double halfStep = 1.0 / (1e-4 * 131072.0);
    const Errors errors = errorsOf({standard16});
    EXPECT_LT(errors.relative, 1.02 * halfStep);
    EXPECT_GT(errors.relative, 0.9 * halfStep);
    EXPECT_GT(errors.atFive, 1.0);
}

TEST(KeptDepth, OfTwentyFourBitsIsOffByMillimetres) {
    const double halfStep = 1.0 / (1e-4 * 33554432.0);
    const double subpixel = 0.01 / 256.0;  // of 1 / d, which changes by about 0.01 per pixel (shaders/subpixel.glsl)
    const Errors errors = errorsOf({standard24});
    EXPECT_LT(errors.relative, 1.02 * halfStep + subpixel);
    EXPECT_GT(errors.relative, 0.9 * halfStep);
    EXPECT_LT(errors.atFive, 0.01);
}

TEST(KeptDepth, OfReversedFloatsIsOffByLessThanAMillimetre) {
    EXPECT_LT(errorsOf({}).atFive, 1e-3);
}

TEST(KeptDepth, IsWhatLightIsComputedWith) {
    // A wall 5 m ahead, and a lamp 3 m ahead: the brightness of the wall shows at which depth it was lit.
    View view;
    view.camera.position = {0, 0, 5};
    view.camera.near = 1e-4F;
    Scene scene =
        sceneOf(lambertMaterial(vec3(0.5F)), builtin::patch({{0, 0, 0}, {9, 0, 0}, {0, 9, 0}, {1, 1}, {1, 1}}));
    Lamp lamp;
    lamp.position = {0, 0, 2};
    scene.lamps.push_back(lamp);
    const auto wallDistance = [&](const std::string& buffer) {
        const Pictures p = render(
            scene, view, size,
            settingsOf({buffer, "materials.lambert_only=true", "diffuse.rays=0", "specular.rays=0", "shadow.lamps=0"}),
            {"direct", "depth"});
        const float distance = p.value("depth", size.x / 2, size.y / 2);
        const float toLamp = distance - 3.0F;
        const float expected = 0.5F / glm::pi<float>() / (toLamp * toLamp);
        EXPECT_NEAR(p.value("direct", size.x / 2, size.y / 2), expected, 0.02F * expected) << buffer;
        return distance;
    };
    EXPECT_NEAR(wallDistance("depth.format=reversed_float"), 5.0F, 1e-3F);
    EXPECT_GT(std::abs(wallDistance(standard16) - 5.0F), 1.0F);
    expectSilentValidation("kept depth");
}

}  // namespace
}  // namespace reflet::test::kept_depth_test
