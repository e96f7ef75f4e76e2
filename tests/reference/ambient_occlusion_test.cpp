// The layer ambient_occlusion of the reference, where its value is known in closed form.
#include "reference/harness.h"

#include <cmath>

namespace reflet::test::reference_ambient_occlusion_test {
namespace {

constexpr float toleranceOfSamples = 0.01F;  // 16384 in all: at most 2.6 standard deviations of independent ones

ReferenceOptions occlusion(float radius, float falloff = 0.0F) {
    ReferenceOptions options = lambert(0, 256);
    options.ambientOcclusion = true;
    options.aoRadius = radius;
    options.aoFalloff = falloff;
    return options;
}

/// Mean over a spot of the ground, seen from above: so small that the value is the same all over it.
float visibilityAt(const Scene& scene, const vec3& spot, const ReferenceOptions& options) {
    View view = darkView(spot + vec3(0, 6, 0), spot);
    view.camera.orthographicHeight = 0.01F;
    return mean(traceReference(scene, view, {8, 8}, options).ambientOcclusion).x;
}

Scene ground() {
    Scene scene;
    add(scene, lambertMaterial(vec3(0.5F)), square({0, 0, 0}, {0, 1, 0}, 100.0F));
    return scene;
}

/// The ground under a ceiling that the camera sees through, as it shows its back.
Scene underCeiling(float height) {
    Scene scene = ground();
    add(scene, lambertMaterial(vec3(0.5F)), square({0, height, 0}, {0, -1, 0}, 100.0F));
    return scene;
}

TEST(AmbientOcclusionLayer, IsThereOnlyIfAskedFor) {
    const View view = darkView({0, 3, 0}, {0, 0, 0});
    EXPECT_TRUE(traceReference(ground(), view, {2, 2}, lambert(0, 1)).ambientOcclusion.data.empty());
    EXPECT_EQ(traceReference(ground(), view, {2, 2}, occlusion(1)).layers().back().name, "ambient_occlusion");
}

TEST(AmbientOcclusionLayer, OfALonePlaneIsOne) {
    EXPECT_EQ(visibilityAt(ground(), {0, 0, 0}, occlusion(1000)), 1.0F);
}

TEST(AmbientOcclusionLayer, OfTheGroundBeforeAWallIsItsFormFactor) {
    Scene scene = ground();
    add(scene, lambertMaterial(vec3(0.5F)), builtin::box({100, 0.5F, 0.5F}),
        glm::translate(mat4(1.0F), vec3(0, 0.5F, -0.5F)));  // 1 m high, its front at z = 0
    for (const float distance : {0.1F, 0.5F, 1.0F, 3.0F}) {
        const float expected = 0.5F * (1.0F + distance / std::hypot(distance, 1.0F));
        EXPECT_NEAR(visibilityAt(scene, {0, 0, distance}, occlusion(1000)), expected, toleranceOfSamples) << distance;
    }
}

TEST(AmbientOcclusionLayer, CountsSurfacesWithinTheRadius) {
    // The directions that meet a ceiling at the height h within the radius R have cosines of h / R and more.
    const Scene scene = underCeiling(1.0F);
    for (const float radius : {1.25F, 2.0F, 5.0F}) {
        const float expected = 1.0F / (radius * radius);
        EXPECT_NEAR(visibilityAt(scene, {0, 0, 0}, occlusion(radius)), expected, toleranceOfSamples) << radius;
    }
    EXPECT_EQ(visibilityAt(scene, {0, 0, 0}, occlusion(0.99F)), 1.0F);
}

TEST(AmbientOcclusionLayer, FadesOverTheEndOfTheRadius) {
    // With a falloff over all of the radius the ceiling covers the mean of 1 - distance / R.
    const Scene scene = underCeiling(1.0F);
    for (const float radius : {1.25F, 2.0F, 5.0F}) {
        const float expected = 1.0F - std::pow(1.0F - 1.0F / radius, 2.0F);
        EXPECT_NEAR(visibilityAt(scene, {0, 0, 0}, occlusion(radius, 1.0F)), expected, toleranceOfSamples) << radius;
    }
    const float half = visibilityAt(scene, {0, 0, 0}, occlusion(2.0F, 0.5F));
    EXPECT_GT(half, visibilityAt(scene, {0, 0, 0}, occlusion(2.0F)) + toleranceOfSamples);
    EXPECT_LT(half, visibilityAt(scene, {0, 0, 0}, occlusion(2.0F, 1.0F)) - toleranceOfSamples);
}

TEST(AmbientOcclusionLayer, WithVisibleOnlyLeavesOutWhatTheCameraDoesNotSee) {
    ReferenceOptions options = occlusion(2.0F);
    options.visibleOnly = true;
    EXPECT_EQ(visibilityAt(underCeiling(1.0F), {0, 0, 0}, options), 1.0F);
}

}  // namespace
}  // namespace reflet::test::reference_ambient_occlusion_test
