// Dielectrics of KHR_materials_ior and KHR_materials_specular in ggx.glsl: their energy.
#include "shader/ggx_dielectric_test.h"

#include "effects/direct/direct.h"
#include "shader/harness.h"
#include "support/ggx_reference.h"

#include <algorithm>

namespace reflet::test::ggx_dielectric_test {
namespace {

constexpr double tableError = 0.012;

float f0Of(float ior) {
    const float root = (ior - 1.0F) / (ior + 1.0F);
    return root * root;
}

const std::vector<vec4>& dielectrics() {
    static const std::vector<vec4> all{vec4(vec3(f0Of(1.0F)), 1.0F), vec4(vec3(f0Of(1.5F)), 1.0F),
                                       vec4(vec3(f0Of(2.4F)), 1.0F), vec4(vec3(0.0F), 0.0F),
                                       vec4(vec3(0.02F), 0.5F),      vec4(0.3F, 0.04F, 0.0F, 1.0F),
                                       vec4(vec3(1.0F), 1.0F)};
    return all;
}

std::vector<DielectricCase> cases(const vec3& baseColor, float metallic) {
    std::vector<DielectricCase> all;
    for (const vec4& dielectric : dielectrics()) {
        for (const float roughness : {0.2F, 0.5F, 1.0F}) {
            for (const float nv : {0.2F, 0.6F, 1.0F}) {
                all.push_back({baseColor, metallic, dielectric, roughness, nv});
            }
        }
    }
    return all;
}

float largest(const vec3& v) {
    return std::max({v.x, v.y, v.z});
}

class GgxDielectric : public ShaderTest {
protected:
    static std::vector<DielectricResult> results(const std::vector<DielectricCase>& all) {
        gpu::KeptImage table("ggx_table");
        record([&](gpu::Frame& f) { ggxTable(f, table); });
        VkSampler linear = device().sampler({VK_FILTER_LINEAR, VK_FILTER_LINEAR});
        return mapOnDevice<DielectricResult>("ggx_dielectric_test.comp", all, {}, [&](gpu::ComputePass& pass) {
            pass.read("ggxTable", table.last(), linear);
        });
    }
};

// The split sum of F0 and F90, compensated for multiple scattering; the base gets what the strongest channel leaves.
TEST_F(GgxDielectric, reflectsItsSplitSumAndTransmitsTheRest) {
    const std::vector<DielectricCase> all = cases(vec3(1.0F), 0.0F);
    const auto got = results(all);
    for (size_t i = 0; i < all.size(); ++i) {
        const DielectricCase& c = all[i];
        const double alpha = std::pow(double(c.roughness), 2.0);
        const double black = ggxAlbedo(c.nv, alpha, 0.0, 128);
        const double white = ggxAlbedo(c.nv, alpha, 1.0, 128);
        vec3 expected(0.0F);
        for (int k = 0; k < 3; ++k) {
            const double f0 = c.dielectric[k];
            expected[k] =
                static_cast<float>((f0 * (white - black) + c.dielectric.w * black) * (1.0 + f0 * (1.0 / white - 1.0)));
        }
        for (int k = 0; k < 3; ++k) {
            EXPECT_NEAR(got[i].specular[k], expected[k], tableError) << i;
            EXPECT_NEAR(got[i].diffuse[k], 1.0F - largest(got[i].specular), 1e-5F) << i;
            EXPECT_NEAR(got[i].energy[k], got[i].diffuse[k] + got[i].specular[k], tableError) << i;
        }
    }
}

TEST_F(GgxDielectric, ofStrength0IsItsBaseAlone) {
    for (const DielectricResult& r : results({{vec3(0.5F), 0.0F, vec4(0.0F), 0.3F, 0.2F}})) {
        EXPECT_EQ(r.specular, vec3(0.0F));
        EXPECT_EQ(r.diffuse, vec3(0.5F));
        EXPECT_EQ(r.energy, vec3(0.5F));
    }
}

TEST_F(GgxDielectric, doesNotChangeMetals) {
    const vec3 gold(1.0F, 0.7F, 0.3F);
    const std::vector<DielectricCase> all = cases(gold, 1.0F);
    const auto got = results(all);
    const size_t perDielectric = all.size() / dielectrics().size();
    for (size_t i = 0; i < all.size(); ++i) {
        // SwiftShader rounds the same expression otherwise where it does not know that the dielectric's share is 0.
        constexpr float roundingTolerance = 1.2e-7F;
        EXPECT_LE(glm::distance(got[i].specular, got[i % perDielectric].specular), roundingTolerance);
        EXPECT_EQ(got[i].f0, gold);
        EXPECT_EQ(got[i].f90, 1.0F);
        EXPECT_EQ(got[i].diffuse, vec3(0.0F));
    }
}

}  // namespace
}  // namespace reflet::test::ggx_dielectric_test
