// ggx.glsl and ggx_table.comp against GGX in double precision and against the conservation of energy.
#include "shader/ggx_test.h"

#include "effects/direct/direct.h"
#include "shader/harness.h"
#include "support/ggx_reference.h"

#include <algorithm>
#include <optional>
#include <string>

namespace reflet::test::ggx_test {
namespace {

constexpr double pi = glm::pi<double>();
constexpr int tableSide = 32;

// Tolerance between the energy of direct light and the table: its interpolation error, largest toward nv = 0.
constexpr double tableError = 0.02;
constexpr double tableErrorNotGrazing = 0.012;

constexpr GgxMaterial white{vec3(1.0F), 0.0F, 0.5F, 0};

vec3 fromNormal(float cosine, float turn = 0.0F) {
    const float r = std::sqrt(std::max(1.0F - cosine * cosine, 0.0F));
    return {r * std::cos(turn), r * std::sin(turn), cosine};
}

class Ggx : public ShaderTest {
protected:
    static void TearDownTestSuite() { table().reset(); }

    template <class Out, class In>
    static std::vector<Out> withTable(std::string_view shader, const std::vector<In>& inputs) {
        if (!table()) {
            table().emplace("ggx_table");
            record([](gpu::Frame& f) { static_cast<void>(ggxTable(f, *table())); });
        }
        VkSampler linear = device().sampler({VK_FILTER_LINEAR, VK_FILTER_LINEAR});
        return mapOnDevice<Out>(shader, inputs, {},
                                [&](gpu::ComputePass& pass) { pass.read("ggxTable", table()->last(), linear); });
    }

    static std::vector<GgxResult> surfaces(const std::vector<GgxCase>& cases) {
        return withTable<GgxResult>("ggx_surface_test.comp", cases);
    }

    struct Lit {
        GgxMaterial material;
        float nv = 1.0F;
    };

    /// Integrals of brdfTimesCosine over the hemisphere.
    static std::vector<double> integrals(const std::vector<Lit>& cases, bool byHalfVector) {
        constexpr uint32_t rings = 256;
        const uint32_t around = byHalfVector ? 64 : 512;  // a grazing lobe is narrow to the side
        std::vector<GgxRing> parts;
        for (const Lit& c : cases) {
            for (uint32_t ring = 0; ring < rings; ++ring) {
                parts.push_back({c.material, c.nv, ring, rings, around, byHalfVector ? 1U : 0U});
            }
        }
        const auto sums = withTable<float>("ggx_integral_test.comp", parts);
        std::vector<double> result(cases.size(), 0.0);
        for (size_t i = 0; i < sums.size(); ++i) {
            result[i / rings] += sums[i];
        }
        return result;
    }

    /// Every texel of the table, read at the place where ggxTableUv looks for it.
    static std::vector<vec2> texels() {
        std::vector<GgxCase> cases;
        for (int y = 0; y < tableSide; ++y) {
            for (int x = 0; x < tableSide; ++x) {
                GgxMaterial material = white;
                material.roughness = static_cast<float>(y) / (tableSide - 1);
                cases.push_back({material, fromNormal(static_cast<float>(x) / (tableSide - 1)), vec3(0, 0, 1)});
            }
        }
        std::vector<vec2> result;
        for (const GgxResult& r : surfaces(cases)) {
            result.push_back(r.table);
        }
        return result;
    }

private:
    static std::optional<gpu::KeptImage>& table() {
        static std::optional<gpu::KeptImage> instance;
        return instance;
    }
};

TEST_F(Ggx, hasTheTermsOfThePapers) {
    std::vector<vec4> inputs;
    for (const float alpha : {0.002025F, 0.01F, 0.1F, 0.3F, 1.0F}) {
        for (const float nh : {0.05F, 0.3F, 0.7F, 0.99F, 1.0F}) {
            for (const float nl : {0.01F, 0.2F, 0.6F, 1.0F}) {
                inputs.emplace_back(nh, nl, 1.01F - nl, alpha);
            }
        }
    }
    inputs.back().z = 1.0F;
    const auto terms = mapOnDevice<vec3>("ggx_terms_test.comp", inputs);
    for (size_t i = 0; i < inputs.size(); ++i) {
        const glm::dvec4 c(inputs[i]);
        const double d = ggxD(c.x, c.w);
        const double v = smithG2(c.y, std::min(c.z, 1.0), c.w) / (4.0 * c.y * c.z);
        // 1 - nh² is a difference of numbers near 1: one rounding of these, over alpha² where the lobe is highest.
        EXPECT_NEAR(terms[i].x, d, d * (1e-5 + 4e-7 / (c.w * c.w + 1.0 - c.x * c.x))) << c.x << ' ' << c.w;
        EXPECT_NEAR(terms[i].y, v, 1e-5 * v) << c.y << ' ' << c.z << ' ' << c.w;
        EXPECT_NEAR(terms[i].z, schlick(0.04, c.x), 1e-6);
    }
}

TEST_F(Ggx, distributionOfHalfVectorsIntegratesToOne) {
    constexpr int steps = 65536;
    for (const float alpha : {0.05F, 0.25F, 1.0F}) {
        std::vector<vec4> inputs;
        inputs.reserve(steps);
        for (int i = 0; i < steps; ++i) {
            inputs.emplace_back((static_cast<float>(i) + 0.5F) / steps, 1.0F, 1.0F, alpha);
        }
        double sum = 0.0;
        const auto terms = mapOnDevice<vec3>("ggx_terms_test.comp", inputs);
        for (int i = 0; i < steps; ++i) {
            sum += terms[i].x * inputs[i].x * 2.0 * pi / steps;
        }
        EXPECT_NEAR(sum, 1.0, 2e-4) << alpha;  // roundings of D: 2e-7 / alpha² at the narrowest lobe
    }
}

TEST_F(Ggx, tableHoldsTheDirectionalAlbedoOfEveryAngleAndRoughness) {
    const auto table = texels();
    double worst = 0.0;
    for (int y = 0; y < tableSide; y += 3) {
        for (int x = 0; x < tableSide; x += x == 0 ? 1 : 3) {
            const double nv = std::max(x / (tableSide - 1.0), 1e-3);
            const double alpha = std::max(std::pow(y / (tableSide - 1.0), 2.0), 1e-4);
            const double black = ggxAlbedo(nv, alpha, 0.0);
            const double full = ggxAlbedo(nv, alpha, 1.0);
            const vec2 texel = table[y * tableSide + x];
            EXPECT_NEAR(texel.x + texel.y, full, 0.01) << x << ' ' << y;
            EXPECT_NEAR(texel.y, black, 0.01) << x << ' ' << y;
            worst = std::max({worst, std::abs(texel.x + texel.y - full), std::abs(texel.y - black)});
        }
    }
    RecordProperty("worst", std::to_string(worst));
}

TEST_F(Ggx, tableIsReadAtItsTexels) {
    const auto table = texels();  // a rough surface, seen from above, loses most light; a smooth one none
    EXPECT_NEAR(table[tableSide - 1].x + table[tableSide - 1].y, 1.0F, 2e-3F);
    EXPECT_NEAR(table.back().x + table.back().y, ggxAlbedo(1.0, 1.0, 1.0), 2e-3);
    const float last = table.back().x;
    EXPECT_LT(last, 0.7F);
}

std::vector<GgxCase> whiteCases(float metallic) {
    std::vector<GgxCase> cases;
    for (int r = 0; r <= 50; ++r) {
        for (int a = 0; a <= 50; ++a) {
            cases.push_back({{vec3(1.0F), metallic, static_cast<float>(r) / 50.0F, 0},
                             fromNormal(static_cast<float>(a) / 50.0F),
                             vec3(0, 0, 1)});
        }
    }
    return cases;
}

TEST_F(Ggx, whiteInAWhiteWorldIsWhiteMetalOrNot) {
    for (const float metallic : {0.0F, 0.25F, 0.5F, 1.0F}) {
        for (const GgxResult& r : surfaces(whiteCases(metallic))) {
            ASSERT_NEAR(r.diffuse.x + r.specular.x, 1.0F, 1e-3F);
            ASSERT_EQ(r.diffuse.y, r.diffuse.x);
            ASSERT_EQ(r.specular.z, r.specular.x);
        }
    }
}

TEST_F(Ggx, metalHasNoDiffuseAndBlackDielectricsReflectTheirCoat) {
    GgxMaterial metal{{0.9F, 0.6F, 0.3F}, 1.0F, 0.4F, 0};
    GgxMaterial black{vec3(0.0F), 0.0F, 0.1F, 0};
    const auto r = surfaces({{metal, fromNormal(1.0F), fromNormal(1.0F)}, {black, fromNormal(1.0F), fromNormal(1.0F)}});
    EXPECT_EQ(r[0].diffuse, vec3(0.0F));
    EXPECT_EQ(r[1].diffuse, vec3(0.0F));
    EXPECT_NEAR(r[1].specular.x, 0.04F, 1e-3F);
}

TEST_F(Ggx, lambertOnlyReflectsItsAlbedoOverPi) {
    const vec3 albedo(0.8F, 0.25F, 0.0F);
    std::vector<GgxCase> cases;
    for (const float metallic : {0.0F, 1.0F}) {
        for (const float nl : {0.001F, 0.3F, 1.0F}) {
            cases.push_back({{albedo, metallic, 0.2F, 1}, fromNormal(0.4F), fromNormal(nl, 2.0F)});
        }
    }
    const auto results = surfaces(cases);
    for (size_t i = 0; i < cases.size(); ++i) {
        EXPECT_EQ(results[i].diffuse, albedo);
        EXPECT_EQ(results[i].specular, vec3(0.0F));
        for (int channel = 0; channel < 3; ++channel) {
            EXPECT_FLOAT_EQ(results[i].reflected[channel], albedo[channel] * cases[i].l.z / glm::pi<float>());
        }
    }
}

TEST_F(Ggx, reflectsNothingFromBelow) {
    std::vector<GgxCase> cases;
    for (const float nl : {0.0F, -1e-6F, -0.5F, -1.0F}) {
        for (const float roughness : {0.0F, 0.5F, 1.0F}) {
            cases.push_back({{vec3(1.0F), 0.5F, roughness, 0}, fromNormal(0.7F), fromNormal(nl, 1.0F)});
        }
    }
    for (const GgxResult& r : surfaces(cases)) {
        EXPECT_EQ(r.reflected, vec3(0.0F));
    }
}

// Swapping eye and light changes the compensation (it depends on the view), but not the single-scattering BRDF.
TEST_F(Ggx, isTheBrdfOfThePapersPositiveAndReciprocal) {
    std::vector<GgxCase> cases;
    for (const float roughness : {0.05F, 0.2F, 0.5F, 1.0F}) {
        for (const float nv : {0.02F, 0.3F, 0.7F, 0.99F}) {
            for (const float nl : {0.03F, 0.4F, 0.8F, 0.98F}) {
                for (const float turn : {0.1F, 1.0F, 3.1F}) {
                    const GgxMaterial metal{vec3(0.9F, 0.5F, 0.1F), 1.0F, roughness, 0};
                    cases.push_back({metal, fromNormal(nv), fromNormal(nl, turn)});
                    cases.push_back({metal, fromNormal(nl, turn), fromNormal(nv)});
                }
            }
        }
    }
    const auto results = surfaces(cases);
    for (size_t i = 0; i < cases.size(); ++i) {
        const GgxCase& c = cases[i];
        const double alpha = std::pow(static_cast<double>(c.material.roughness), 2.0);
        for (int channel = 0; channel < 3; ++channel) {
            const double expected = ggxBrdf(glm::normalize(glm::dvec3(c.v)), glm::normalize(glm::dvec3(c.l)), alpha,
                                            c.material.baseColor[channel]);
            // Roundings of nh near 1, over alpha²: 6e-8 / 6e-6 at the narrowest lobe here.
            const double tolerance = expected * (1e-4 + 2e-7 / (alpha * alpha));
            ASSERT_GT(results[i].singleScattering[channel], 0.0F);
            ASSERT_NEAR(results[i].singleScattering[channel], expected, tolerance);
            const float swapped = results[i ^ 1U].singleScattering[channel];
            ASSERT_NEAR(results[i].singleScattering[channel], swapped, 1e-3F * swapped);
        }
    }
}

TEST_F(Ggx, reflectsAsMuchDirectLightAsTheSurfaceSays) {
    std::vector<Lit> cases;
    std::vector<GgxCase> same;
    for (const float roughness : {0.3F, 0.4F, 0.6F, 0.8F, 1.0F}) {
        for (const float nv : {0.1F, 0.25F, 0.5F, 0.75F, 1.0F}) {
            for (const GgxMaterial& material :
                 {GgxMaterial{vec3(1.0F), 0.0F, roughness, 0}, GgxMaterial{vec3(1.0F), 1.0F, roughness, 0},
                  GgxMaterial{vec3(0.5F), 0.3F, roughness, 0}}) {
                cases.push_back({material, nv});
                same.push_back({material, fromNormal(nv), vec3(0, 0, 1)});
            }
        }
    }
    const auto energy = integrals(cases, false);
    const auto said = surfaces(same);
    for (size_t i = 0; i < cases.size(); ++i) {
        const Lit& c = cases[i];
        EXPECT_LE(energy[i], 1.0 + tableErrorNotGrazing);
        EXPECT_NEAR(energy[i], said[i].diffuse.x + said[i].specular.x, tableErrorNotGrazing)
            << "roughness " << c.material.roughness << " metallic " << c.material.metallic << " nv " << c.nv;
    }
}

TEST_F(Ggx, makesNoLightAtAnyRoughness) {
    std::vector<Lit> cases;
    for (int r = 0; r <= 20; ++r) {
        for (int a = 1; a <= 20; ++a) {
            cases.push_back({{vec3(1.0F), 1.0F, static_cast<float>(r) / 20.0F, 0}, static_cast<float>(a) / 20.0F});
        }
    }
    const auto energy = integrals(cases, true);
    for (size_t i = 0; i < cases.size(); ++i) {
        // D near its peak loses digits in 1 - nh²: 6e-8 over alpha² of 4e-6 where the roughness is smallest.
        const double rounding = cases[i].material.roughness < 0.1F ? 0.02 : 0.0;
        const double tolerance = (cases[i].nv < 0.09F ? tableError : tableErrorNotGrazing) + rounding;
        ASSERT_NEAR(energy[i], 1.0, tolerance) << "roughness " << cases[i].material.roughness << " nv " << cases[i].nv;
    }
}

}  // namespace
}  // namespace reflet::test::ggx_test
