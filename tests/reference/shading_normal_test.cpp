// Shading normals that would reflect below the surface.
#include "reference/harness.h"
#include "reference/surface.h"
#include "support/shading_normal_cases.h"

namespace reflet::test::shading_normal_test {
namespace {

TEST(ShadingNormal, BendsUntilItsMirrorDirectionLeavesTheSurface) {
    for (const NormalCase& c : normalCases()) {
        ASSERT_NO_FATAL_FAILURE(expectConsistentNormal(c, consistentNormal(c.normal, c.geometric, c.toViewer)));
    }
}

// Its normals face away from the viewer.
TEST(ShadingNormal, LeavesNothingBlack) {
    for (const float roughness : {0.0F, 0.1F}) {
        Scene scene;
        Material white = lambertMaterial(vec3(1.0F));
        white.metallic = 1.0F;
        white.roughness = roughness;
        Mesh floor = square({0, 0, 0}, {0, 1, 0}, 20.0F);
        for (VertexAttributes& v : floor.attributes) {
            v.normal = glm::normalize(vec3(0, 1, -1));
        }
        add(scene, white, floor);
        View view = darkView({0, 1, 4}, {0, 0, 0}, 10.0F);
        view.environment.radiance = vec3(1.0F);
        EXPECT_GT(mean(traceReference(scene, view, {8, 8}, {.samples = 64}).final).x, roughness > 0.0F ? 0.7F : 0.999F);
    }
}

}  // namespace
}  // namespace reflet::test::shading_normal_test
