// Blended surfaces in the path tracer, against closed forms.
#include "reference/harness.h"

#include <cmath>

namespace reflet::test::blend_test {
namespace {

Material blended(const vec3& albedo, const vec3& emissive, float alpha) {
    Material m = lambertMaterial(albedo, emissive);
    m.baseColor.a = alpha;
    m.alphaCutoff = blendCutoff;
    m.blended = true;
    return m;
}

// Black surfaces that emit, so that the camera sees nothing else.
struct Pane {
    float z;
    vec3 light;
    float alpha;
};

Scene panesBefore(const vec3& wall, const std::vector<Pane>& panes) {
    Scene scene;
    add(scene, lambertMaterial(vec3(0), wall), square({0, 0, -2}, {0, 0, 1}, 5));
    for (const Pane& p : panes) {
        add(scene, blended(vec3(0), p.light, p.alpha), square({0, 0, p.z}, {0, 0, 1}, 5));
    }
    return scene;
}

ReferencePicture trace(const Scene& scene, const View& view, uint32_t bounces, uint32_t samples) {
    return traceReference(scene, view, {16, 16}, lambert(bounces, samples));
}

// Standard deviations that a mean over 256 pixels of 64 samples may be off by.
constexpr float sigmas = 5.0F;

TEST(Blend, APaneIsMixedWithWhatIsBehindByItsAlpha) {
    for (const float alpha : {0.0F, 0.25F, 0.8F, 1.0F}) {
        const ReferencePicture p =
            trace(panesBefore({1, 2, 0.5F}, {{0, {3, 0, 1}, alpha}}), darkView({0, 0, 5}, {0, 0, 0}), 0, 64);
        const vec3 expected = alpha * vec3(3, 0, 1) + (1 - alpha) * vec3(1, 2, 0.5F);
        const float noise = std::sqrt(alpha * (1 - alpha) / (256 * 64));
        for (int i = 0; i < 3; ++i) {
            const float contrast = std::abs(vec3(2, -2, 0.5F)[i]);
            EXPECT_NEAR(mean(p.final)[i], expected[i], sigmas * noise * contrast + 1e-5F) << alpha;
        }
    }
}

TEST(Blend, OfTwoPanesTheNearerOneIsInFront) {
    const std::vector<Pane> panes{{0, {4, 0, 0}, 0.5F}, {1, {0, 4, 0}, 0.25F}};
    const ReferencePicture p = trace(panesBefore({0, 0, 4}, panes), darkView({0, 0, 5}, {0, 0, 0}), 0, 64);
    const vec3 expected = 4.0F * vec3(0.75F * 0.5F, 0.25F, 0.75F * 0.5F);
    EXPECT_LT(glm::distance(mean(p.final), expected), sigmas * 4.0F / 128.0F);
    EXPECT_NEAR(pixel(p.depth, 8, 8), 7.0F, 1e-4F) << "depth is that of the opaque surface";
}

TEST(Blend, ThePaneLetsSunLightThrough) {
    Scene scene;
    add(scene, lambertMaterial(vec3(0.5F)), square({0, 0, 0}, {0, 1, 0}, 1));
    View view = darkView({0, 1, 0.01F}, {0, 0, 0}, 20);
    view.sun.direction = glm::normalize(vec3(1, -1, 0));
    view.sun.irradiance = vec3(2);
    const vec3 free = mean(trace(scene, view, 0, 64).final);
    add(scene, blended(vec3(0), vec3(0), 0.25F), square({-2, 0, 0}, {1, 0, 0}, 5));
    EXPECT_NEAR(mean(trace(scene, view, 0, 64).final).x, 0.75F * free.x, free.x * sigmas * 0.5F / 128.0F);
}

// A plane under a blended light: both estimators, light samples and scattered rays, must weigh it by its alpha.
TEST(Blend, ALampBehindAPaneAndABlendedLampShineByTheirAlpha) {
    const auto under = [](float alpha) {
        Scene scene;
        add(scene, lambertMaterial(vec3(0.5F)), square({0, 0, 0}, {0, 1, 0}, 1));
        add(scene, blended(vec3(0), vec3(10), alpha), square({0, 1, 0}, {0, -1, 0}, 0.5F));
        return mean(trace(scene, darkView({0, 0.5F, 3}, {0, 0, 0}, 5), 1, 256).indirectDiffuse).x;
    };
    const float whole = under(1.0F);
    EXPECT_GT(whole, 0.2F);
    EXPECT_NEAR(under(0.4F), 0.4F * whole, 0.01F * whole);
}

}  // namespace
}  // namespace reflet::test::blend_test
