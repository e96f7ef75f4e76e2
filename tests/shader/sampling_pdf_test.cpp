// The samplers of sampling.glsl against their documented densities: these integrate to one, and random samples fall
// into the cells of a grid as often as the density predicts (Pearson's chi-square test).
#include "shader/sampling_test.h"

#include "shader/harness.h"
#include "support/ggx_reference.h"

#include <algorithm>
#include <functional>
#include <random>

namespace reflet::test::sampling_pdf_test {
namespace {

constexpr double pi = glm::pi<double>();
constexpr int sectors = 24;
constexpr size_t sampleCount = 200000;

/// Per solid angle.
using Density = std::function<double(const glm::dvec3& direction)>;

glm::dvec3 around(double z, double phi) {
    const double r = std::sqrt(std::max(1.0 - z * z, 0.0));
    return {r * std::cos(phi), r * std::sin(phi), z};
}

/// Rings between rising heights z, each in equal sectors.
class Grid {
public:
    explicit Grid(std::vector<double> heights) : heights_(std::move(heights)) {}

    /// The integral of the density over every cell, by the midpoint rule.
    [[nodiscard]] std::vector<double> integrate(const Density& density) const {
        constexpr int parts = 24;
        std::vector<double> sums;
        for (size_t ring = 0; ring + 1 < heights_.size(); ++ring) {
            const double zStep = (heights_[ring + 1] - heights_[ring]) / parts;
            for (int sector = 0; sector < sectors; ++sector) {
                double sum = 0.0;
                for (int i = 0; i < parts; ++i) {
                    const double z = heights_[ring] + (i + 0.5) * zStep;
                    for (int j = 0; j < parts; ++j) {
                        sum += density(around(z, 2.0 * pi * (sector + (j + 0.5) / parts) / sectors));
                    }
                }
                sums.push_back(sum * zStep * 2.0 * pi / (sectors * parts));
            }
        }
        return sums;
    }

    /// How many directions lie in every cell.
    [[nodiscard]] std::vector<double> count(const std::vector<glm::dvec3>& directions) const {
        std::vector<double> counts((heights_.size() - 1) * sectors, 0.0);
        for (const glm::dvec3& d : directions) {
            const auto above = std::upper_bound(heights_.begin() + 1, heights_.end() - 1, d.z);
            const double turn = std::atan2(d.y, d.x) / (2.0 * pi);
            const auto sector = static_cast<size_t>((turn < 0.0 ? turn + 1.0 : turn) * sectors);
            const auto ring = static_cast<size_t>(above - heights_.begin()) - 1;
            counts[ring * sectors + std::min<size_t>(sector, sectors - 1)] += 1.0;
        }
        return counts;
    }

private:
    std::vector<double> heights_;
};

/// Rings of the upper hemisphere that resolve a GGX lobe at any alpha: tan(theta) = alpha · s / (1 - s), s even.
Grid ringsOfLobe(double alpha) {
    constexpr int rings = 16;
    std::vector<double> heights{0.0};
    for (int i = rings - 1; i > 0; --i) {
        const double s = static_cast<double>(i) / rings;
        heights.push_back(std::cos(std::atan(alpha * s / (1.0 - s))));
    }
    heights.push_back(1.0);
    return Grid(heights);
}

/// Rings of the whole sphere, one border of which is at the given height.
Grid ringsOfSphere(double border) {
    constexpr int rings = 24;
    std::vector<double> heights{border};
    for (int i = 0; i <= rings; ++i) {
        heights.push_back(2.0 * i / rings - 1.0);
    }
    std::ranges::sort(heights);
    return Grid(heights);
}

/// Expects directions that follow the density. Cells with low expected counts are merged.
void expectSpread(const std::vector<glm::dvec3>& directions, const Grid& grid, const Density& density,
                  const std::string& what) {
    const auto shares = grid.integrate(density);
    const auto counts = grid.count(directions);
    double total = 0.0;
    double square = 0.0;
    double freedom = -1.0;
    double pooledExpected = 0.0;
    double pooledCount = 0.0;
    const auto add = [&](double expected, double count) {
        square += (count - expected) * (count - expected) / expected;
        freedom += 1.0;
    };
    for (size_t i = 0; i < shares.size(); ++i) {
        total += shares[i];
        const double expected = shares[i] * static_cast<double>(directions.size());
        if (expected < 10.0) {
            pooledExpected += expected;
            pooledCount += counts[i];
        } else {
            add(expected, counts[i]);
        }
    }
    EXPECT_NEAR(total, 1.0, 1e-3) << what;
    if (pooledExpected > 1.0) {
        add(pooledExpected, pooledCount);
    } else {
        EXPECT_LT(pooledCount, 10.0) << what;
    }
    EXPECT_LT(square, freedom + 4.0 * std::sqrt(2.0 * freedom)) << what << ": " << freedom << " degrees of freedom";
}

class SamplingPdf : public ShaderTest {
protected:
    static std::vector<glm::dvec3> sample(uint32_t kind, const std::vector<vec2>& u, const SamplingParams& params) {
        const auto samples = mapOnDevice<vec3>("sampling_test.comp", u, params,
                                               [&](gpu::ComputePass& pass) { pass.constant("kind", kind); });
        return {samples.begin(), samples.end()};
    }

    static std::vector<vec2> randomNumbers() {
        std::mt19937 random(5);
        const auto unit = [&] { return static_cast<float>(random() >> 8U) / 16777216.0F; };
        std::vector<vec2> u;
        for (size_t i = 0; i < sampleCount; ++i) {
            const float first = unit();
            u.emplace_back(first, unit());
        }
        return u;
    }

    /// An eye at this cosine from the normal, turned so that no symmetry hides an error.
    static vec3 eyeAt(float cosine) { return glm::normalize(vec3(around(cosine, 0.7))); }

    static double visibleDensity(const glm::dvec3& h, const glm::dvec3& v, double alpha) {
        const double masking = 1.0 / (1.0 + smithLambda(v.z, alpha));
        return ggxD(h.z, alpha) * std::max(glm::dot(v, h), 0.0) * masking / v.z;
    }
};

TEST_F(SamplingPdf, ofTheUniformHemisphereIsEven) {
    expectSpread(
        sample(samplerUniformHemisphere, randomNumbers(), {}), ringsOfSphere(0.0),
        [](const glm::dvec3& d) { return d.z > 0.0 ? 0.5 / pi : 0.0; }, "uniform");
}

TEST_F(SamplingPdf, ofTheCosineHemisphereIsTheCosineOverPi) {
    expectSpread(
        sample(samplerCosineHemisphere, randomNumbers(), {}), ringsOfSphere(0.0),
        [](const glm::dvec3& d) { return std::max(d.z, 0.0) / pi; }, "cosine");
}

TEST_F(SamplingPdf, ofHalfVectorsIsTheirDistributionTimesTheCosine) {
    for (const float alpha : {0.1F, 0.4F, 1.0F}) {
        expectSpread(
            sample(samplerGgx, randomNumbers(), {alpha, {}}), ringsOfLobe(alpha),
            [&](const glm::dvec3& h) { return ggxD(h.z, alpha) * h.z; }, "alpha " + std::to_string(alpha));
    }
}

TEST_F(SamplingPdf, ofVisibleHalfVectorsIsTheDistributionOfVisibleNormals) {
    for (const float alpha : {0.05F, 0.3F, 1.0F}) {
        for (const float cosine : {0.05F, 0.3F, 0.7F, 1.0F}) {
            const vec3 v = eyeAt(cosine);
            expectSpread(
                sample(samplerGgxVisible, randomNumbers(), {alpha, v}), ringsOfLobe(alpha),
                [&](const glm::dvec3& h) { return visibleDensity(h, v, alpha); },
                "alpha " + std::to_string(alpha) + " cosine " + std::to_string(cosine));
        }
    }
}

// Reflection divides the density by 4 dot(v, h). Some of the directions lie below the surface.
TEST_F(SamplingPdf, ofReflectedDirectionsIsThatOfTheirHalfVectorsOverFourTimesTheCosineBetween) {
    for (const float alpha : {0.4F, 1.0F}) {
        for (const float cosine : {0.1F, 0.5F, 0.9F}) {
            const vec3 v = eyeAt(cosine);
            auto directions = sample(samplerGgxVisible, randomNumbers(), {alpha, v});
            for (glm::dvec3& d : directions) {
                d = 2.0 * glm::dot(glm::dvec3(v), d) * d - glm::dvec3(v);
            }
            expectSpread(
                directions, ringsOfSphere(-cosine),
                [&](const glm::dvec3& l) {
                    const glm::dvec3 h = glm::normalize(glm::dvec3(v) + l);
                    return h.z > 0.0 ? visibleDensity(h, v, alpha) / (4.0 * glm::dot(glm::dvec3(v), h)) : 0.0;
                },
                "alpha " + std::to_string(alpha) + " cosine " + std::to_string(cosine));
        }
    }
}

// BRDF · cos / pdf is G2 / G1 for a mirror without Fresnel: its mean is the lobe's directional albedo.
TEST_F(SamplingPdf, ofVisibleHalfVectorsGivesTheAlbedoOfTheLobe) {
    for (const float alpha : {0.1F, 0.4F, 1.0F}) {
        for (const float cosine : {0.1F, 0.5F, 0.9F}) {
            const glm::dvec3 v(eyeAt(cosine));
            double sum = 0.0;
            for (const glm::dvec3& h : sample(samplerGgxVisible, randomNumbers(), {alpha, vec3(v)})) {
                const double down = 2.0 * glm::dot(v, h) * h.z - v.z;
                sum += down > 0.0 ? smithG2(down, v.z, alpha) * (1.0 + smithLambda(v.z, alpha)) : 0.0;
            }
            EXPECT_NEAR(sum / sampleCount, ggxAlbedo(cosine, alpha, 1.0), 0.005) << alpha << ' ' << cosine;
        }
    }
}

TEST_F(SamplingPdf, ofVisibleHalfVectorsHasNoHoleAtTheEndsOfTheNumbers) {
    std::vector<vec2> u;
    const float ends[] = {0.0F, 1.0F / 16777216.0F, 0.25F, 0.5F, 0.75F, 1.0F - 1.0F / 16777216.0F};
    for (const float a : ends) {
        for (const float b : ends) {
            u.emplace_back(a, b);
        }
    }
    for (const float alpha : {1e-4F, 0.01F, 0.3F, 1.0F}) {
        for (const float cosine : {0.001F, 0.3F, 0.7071F, 1.0F}) {
            for (int quarter = 0; quarter < 4; ++quarter) {  // where a cap's rim meets the eye's opposite
                const vec3 v = glm::normalize(vec3(around(cosine, 0.5 * pi * quarter)));
                for (const glm::dvec3& h : sample(samplerGgxVisible, u, {alpha, v})) {
                    ASSERT_NEAR(glm::length(h), 1.0, 5e-7) << alpha << ' ' << cosine << ' ' << quarter;
                    ASSERT_GE(h.z, 0.0);
                }
            }
        }
    }
}

}  // namespace
}  // namespace reflet::test::sampling_pdf_test
