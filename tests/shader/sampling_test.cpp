// sampling.glsl
#include "shader/sampling_test.h"

#include "shader/directions.h"
#include "shader/harness.h"
#include "support/ggx_reference.h"

#include <algorithm>
#include <functional>

namespace reflet::test::sampling_test {
namespace {

constexpr float alphas[] = {1e-4F, 0.002F, 0.01F, 0.1F, 0.3F, 1.0F};
constexpr double pi = glm::pi<double>();

class Sampling : public ShaderTest {
protected:
    static std::vector<vec3> sample(uint32_t kind, const std::vector<vec2>& u, float alpha = 1.0F) {
        return mapOnDevice<vec3>("sampling_test.comp", u, SamplingParams{alpha, {}},
                                 [&](gpu::ComputePass& pass) { pass.constant("kind", kind); });
    }

    static constexpr int strata = 512;

    /// The centres of strata x strata squares.
    static std::vector<vec2> stratified() {
        std::vector<vec2> u;
        u.reserve(size_t(strata) * strata);
        for (int i = 0; i < strata * strata; ++i) {
            u.push_back((vec2(i % strata, i / strata) + 0.5F) / static_cast<float>(strata));
        }
        return u;
    }

    /// Numbers from all of [0, 1), including both ends.
    static std::vector<vec2> extremes() {
        std::vector<vec2> u;
        const float ends[] = {0.0F, 1.0F / 16777216.0F, 1e-4F, 0.25F, 0.5F, 0.75F, 1.0F - 1.0F / 16777216.0F};
        for (const float a : ends) {
            for (const float b : ends) {
                u.emplace_back(a, b);
            }
        }
        return u;
    }

    static void expectUnitAndAbove(const std::vector<vec3>& directions) {
        for (const vec3& d : directions) {
            ASSERT_GE(d.z, 0.0F);
            ASSERT_NEAR(glm::length(glm::dvec3(d)), 1.0, 5e-7);
        }
    }

    /// z of the samples follows the distribution function `below` (Kolmogorov and Smirnov's largest difference). Strata
    /// leave at most half of one and a rounding; where z is rounded to a float, `below` may jump by `rounding`.
    static void expectDistribution(std::vector<vec3> directions, const std::function<double(double)>& below,
                                   double rounding = 1e-4) {
        std::ranges::sort(directions, {}, &vec3::z);
        const auto count = static_cast<double>(directions.size());
        double worst = 0.0;
        for (size_t i = 0; i < directions.size(); ++i) {
            worst = std::max(worst, std::abs((static_cast<double>(i) + 0.5) / count - below(directions[i].z)));
        }
        EXPECT_LT(worst, 0.5 / strata + rounding);
    }

    /// Expects equally many samples in each of 64 sectors around the normal.
    static void expectEvenAround(const std::vector<vec3>& directions) {
        std::vector<int> sectors(64, 0);
        for (const vec3& d : directions) {
            const double turn = std::atan2(d.y, d.x) / (2.0 * pi);
            ++sectors[std::min<size_t>(static_cast<size_t>((turn < 0.0 ? turn + 1.0 : turn) * 64.0), 63)];
        }
        for (const int sector : sectors) {
            EXPECT_EQ(sector, strata * strata / 64);
        }
    }

    static glm::dvec3 mean(const std::vector<vec3>& directions) {
        glm::dvec3 sum(0.0);
        for (const vec3& d : directions) {
            sum += glm::dvec3(d);
        }
        return sum / static_cast<double>(directions.size());
    }
};

TEST_F(Sampling, givesDirectionsOfTheHemisphereAtTheEndsOfTheNumbers) {
    expectUnitAndAbove(sample(samplerCosineHemisphere, extremes()));
    expectUnitAndAbove(sample(samplerUniformHemisphere, extremes()));
    for (const float alpha : alphas) {
        expectUnitAndAbove(sample(samplerGgx, extremes(), alpha));
    }
}

TEST_F(Sampling, spreadsCosineDirectionsByTheCosine) {
    const auto directions = sample(samplerCosineHemisphere, stratified());
    expectUnitAndAbove(directions);
    expectDistribution(directions, [](double z) { return z * z; });
    expectEvenAround(directions);
    EXPECT_NEAR(mean(directions).z, 2.0 / 3.0, 2e-5);  // midpoint rule on a square root: strata^-1.5 / 10
    EXPECT_NEAR(glm::length(glm::dvec2(mean(directions))), 0.0, 1e-6);
}

TEST_F(Sampling, spreadsUniformDirectionsEvenly) {
    const auto directions = sample(samplerUniformHemisphere, stratified());
    expectUnitAndAbove(directions);
    expectDistribution(directions, [](double z) { return z; });
    expectEvenAround(directions);
    EXPECT_NEAR(mean(directions).z, 0.5, 1e-6);
    EXPECT_NEAR(glm::length(glm::dvec2(mean(directions))), 0.0, 1e-6);
}

// Mean of f / pdf, with the pdf that the comment in sampling.glsl states.
TEST_F(Sampling, integratesTheCosineToPi) {
    double sum = 0.0;
    for (const vec3& d : sample(samplerUniformHemisphere, stratified())) {
        sum += d.z * 2.0 * pi;
    }
    EXPECT_NEAR(sum / (strata * strata), pi, 1e-5);
}

TEST_F(Sampling, integratesTheSquaredCosineToTwoThirdsOfPi) {
    double sum = 0.0;
    for (const vec3& d : sample(samplerCosineHemisphere, stratified())) {
        sum += d.z * d.z / (d.z / pi);
    }
    EXPECT_NEAR(sum / (strata * strata), 2.0 * pi / 3.0, 1e-4);
}

TEST_F(Sampling, spreadsHalfVectorsByTheGgxDistribution) {
    for (const float alpha : {0.1F, 0.3F, 0.6F, 1.0F}) {
        const auto directions = sample(samplerGgx, stratified(), alpha);
        expectUnitAndAbove(directions);
        const GgxDistributionTable table(alpha);
        // At alpha 0.1 one rounding of z (6e-8) near 1 is 6e-6 of the distribution; the table adds as much.
        expectDistribution(
            directions, [&](double z) { return table.below(z); }, 2e-4);
        expectEvenAround(directions);
    }
}

class Basis : public ShaderTest {
protected:
    static void expectFrames(const std::vector<vec3>& normals) {
        const auto frames = mapOnDevice<mat3>("basis_test.comp", normals);
        for (size_t i = 0; i < normals.size(); ++i) {
            const glm::dmat3 m(frames[i]);
            const glm::dmat3 product = glm::transpose(m) * m;
            for (int a = 0; a < 3; ++a) {
                for (int b = 0; b < 3; ++b) {
                    // n itself is unit to 1e-7, which the frame carries on.
                    ASSERT_NEAR(product[a][b], a == b ? 1.0 : 0.0, 1e-6)
                        << normals[i].x << ' ' << normals[i].y << ' ' << normals[i].z;
                }
            }
            ASSERT_NEAR(glm::determinant(m), 1.0, 1e-6);
            ASSERT_EQ(frames[i][2], normals[i]);
        }
    }
};

TEST_F(Basis, isARightHandedFrameAroundEveryDirection) {
    expectFrames(spreadDirections(100000));
}

TEST_F(Basis, isARightHandedFrameAroundAxesAndWhereItsSignsChange) {
    std::vector<vec3> normals = axesAndSeams();
    for (const float off : {0.0F, 1e-30F, 1e-10F, 1e-8F, 1e-6F, 1e-4F, 3e-4F, 1e-3F}) {  // around the old singularity
        for (const float z : {-1.0F, 1.0F}) {
            normals.push_back(glm::normalize(vec3(off, 0.0F, z)));
            normals.push_back(glm::normalize(vec3(-off, off, z)));
        }
    }
    expectFrames(normals);
}

}  // namespace
}  // namespace reflet::test::sampling_test
