// The cone (direction and half angle) that represents a rough surface's lobe, against the lobe itself.
#include "shader/directions.h"
#include "shader/harness.h"
#include "support/ggx_reference.h"

#include <algorithm>

namespace reflet::test::ggx_middle_test {
namespace {

struct LobePart {
    glm::dvec3 l;
    double weight;
};

/// The lobe toward v without Fresnel, sampled by half vectors that follow the distribution.
std::vector<LobePart> lobeParts(double nv, double alpha) {
    constexpr int steps = 160;
    const glm::dvec3 v(std::sqrt(1.0 - nv * nv), 0.0, nv);
    std::vector<LobePart> parts;
    for (int i = 0; i < steps; ++i) {
        const double u = (i + 0.5) / steps;
        const double theta = std::atan(alpha * std::sqrt(u / (1.0 - u)));
        for (int j = 0; j < steps; ++j) {
            const double phi = 2.0 * glm::pi<double>() * (j + 0.5) / steps;
            const glm::dvec3 h(std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta));
            const double vh = glm::dot(v, h);
            const glm::dvec3 l = 2.0 * vh * h - v;
            if (vh > 0.0 && l.z > 0.0) {
                parts.push_back({l, ggxBrdf(v, l, alpha, 1.0) * l.z * 4.0 * vh / (ggxD(h.z, alpha) * h.z)});
            }
        }
    }
    return parts;
}

glm::dvec3 middleOf(const std::vector<LobePart>& parts) {
    glm::dvec3 sum(0.0);
    for (const LobePart& part : parts) {
        sum += part.weight * part.l;
    }
    return glm::normalize(sum);
}

/// Tangent of the angle around a direction that holds half of the lobe.
double halfTangent(std::vector<LobePart> parts, const glm::dvec3& around) {
    std::ranges::sort(parts, std::greater(), [&](const LobePart& part) { return glm::dot(part.l, around); });
    double all = 0.0;
    for (const LobePart& part : parts) {
        all += part.weight;
    }
    double sum = 0.0;
    const auto half =
        std::ranges::find_if(parts, [&](const LobePart& part) { return (sum += part.weight) >= 0.5 * all; });
    return std::tan(std::acos(glm::dot(half->l, around)));
}

class GgxMiddle : public ShaderTest {};

TEST_F(GgxMiddle, directionAndAngleAreThoseOfTheLobeAwayFromGrazing) {
    std::vector<vec2> cases;
    for (const float nv : {0.99F, 0.9F, 0.8F, 0.7F}) {
        for (const float alpha : {0.01F, 0.09F, 0.25F, 0.36F, 0.5F, 0.64F, 0.81F, 1.0F}) {
            cases.emplace_back(nv, alpha);
        }
    }
    const auto found = mapOnDevice<vec4>("ggx_middle_test.comp", cases);
    for (size_t i = 0; i < cases.size(); ++i) {
        const auto parts = lobeParts(cases[i].x, cases[i].y);
        const vec3 direction(found[i]);
        EXPECT_NEAR(glm::length(direction), 1.0F, 1e-5F);
        const glm::dvec3 middle = middleOf(parts);
        EXPECT_LT(angleBetween(direction, vec3(middle)), glm::radians(9.0)) << cases[i].x << ", " << cases[i].y;
        const double ratio = found[i].w / halfTangent(parts, middle);
        EXPECT_GT(ratio, 0.7) << cases[i].x << ", " << cases[i].y;
        EXPECT_LT(ratio, 1.4) << cases[i].x << ", " << cases[i].y;
    }
}

TEST_F(GgxMiddle, aSmoothSurfacesDirectionIsTheMirrors) {
    const std::vector<vec2> cases{{0.9F, 0.0F}, {0.5F, 0.0F}, {0.1F, 0.0F}};
    const auto found = mapOnDevice<vec4>("ggx_middle_test.comp", cases);
    for (size_t i = 0; i < cases.size(); ++i) {
        const vec3 mirror(-std::sqrt(1.0F - cases[i].x * cases[i].x), 0.0F, cases[i].x);
        EXPECT_LT(angleBetween(vec3(found[i]), mirror), 1e-5);
        EXPECT_EQ(found[i].w, 0.0F);
    }
}

TEST_F(GgxMiddle, theMeanDirectionIsThatOfTheLobeAtEveryAngle) {
    std::vector<vec2> cases;
    for (const float nv : {0.99F, 0.9F, 0.8F, 0.6F, 0.4F, 0.2F, 0.1F, 0.05F}) {
        for (const float roughness : {0.02F, 0.1F, 0.2F, 0.3F, 0.4F, 0.5F, 0.6F, 0.7F, 0.8F, 0.9F, 1.0F}) {
            cases.emplace_back(nv, roughness * roughness);
        }
    }
    const auto found = mapOnDevice<vec3>("ggx_mean_test.comp", cases);
    for (size_t i = 0; i < cases.size(); ++i) {
        EXPECT_NEAR(glm::length(found[i]), 1.0F, 1e-5F);
        const double cosine = glm::dot(glm::dvec3(found[i]), middleOf(lobeParts(cases[i].x, cases[i].y)));
        EXPECT_LT(glm::degrees(std::acos(std::min(cosine, 1.0))), 3.0) << cases[i].x << ", alpha " << cases[i].y;
    }
}

}  // namespace
}  // namespace reflet::test::ggx_middle_test
