// Clear coats in the path tracer, against closed forms.
#include "reference/harness.h"

namespace reflet::test::clearcoat_test {
namespace {

// Toward the origin, in a white environment.
ReferencePicture trace(const Scene& scene, const vec3& position, float fovYDegrees, uint32_t samples) {
    View view = darkView(position, {0, 0, 0}, fovYDegrees);
    view.environment.radiance = vec3(1.0F);
    return traceReference(scene, view, {8, 8}, {.samples = samples});
}

TEST(Clearcoat, ReturnsNoMoreThanAllLight) {
    for (const float coatRoughness : {0.0F, 0.3F, 1.0F}) {
        for (const float metallic : {0.0F, 1.0F}) {
            Scene scene;
            Material m = lambertMaterial(vec3(1.0F));
            m.roughness = 0.5F;
            m.metallic = metallic;
            m.clearcoat = {.factor = 1.0F, .roughness = coatRoughness};
            add(scene, m, square({0, 0, 0}, {0, 1, 0}, 10.0F));
            const ReferencePicture p = trace(scene, {0, 1, 2}, 60.0F, 512);
            EXPECT_NEAR(mean(p.final).x, 1.0F, 0.006F) << coatRoughness << ", " << metallic;
        }
    }
}

// On black, the coat alone reflects; on a glowing surface it takes what it reflects.
TEST(Clearcoat, ReflectsFourPercentAndCoversWhatIsBeneath) {
    for (const float factor : {0.5F, 1.0F}) {
        Scene scene;
        Material m = lambertMaterial(vec3(0.0F), vec3(3.0F));
        m.specular = 0.0F;
        m.clearcoat.factor = factor;
        add(scene, m, square({0, 0, 0}, {0, 1, 0}, 10.0F));
        const ReferencePicture p = trace(scene, {0, 2, 0}, 2.0F, 64);
        EXPECT_NEAR(mean(p.indirectSpecular).x, 0.04F * factor, 2e-3F);
        EXPECT_NEAR(mean(p.direct).x, 3.0F * (1.0F - 0.04F * factor), 2e-3F);
    }
}

}  // namespace
}  // namespace reflet::test::clearcoat_test
