// Independent GGX in double precision, after the papers, to check the shaders against.
// D: Walter et al., Microfacet Models for Refraction through Rough Surfaces, 2007. G2, height-correlated: Heitz,
// Understanding the Masking-Shadowing Function, JCGT 2014. F: Schlick 1994.
#pragma once

#include "base/math.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace reflet::test {

inline double ggxD(double cosine, double alpha) {
    if (cosine <= 0.0) {
        return 0.0;
    }
    const double tan2 = (1.0 - cosine * cosine) / (cosine * cosine);
    const double a2 = alpha * alpha;
    return a2 / (glm::pi<double>() * std::pow(cosine, 4.0) * std::pow(a2 + tan2, 2.0));
}

inline double smithLambda(double cosine, double alpha) {
    const double tan2 = (1.0 - cosine * cosine) / (cosine * cosine);
    return 0.5 * (std::sqrt(1.0 + alpha * alpha * tan2) - 1.0);
}

inline double smithG2(double nl, double nv, double alpha) {
    return 1.0 / (1.0 + smithLambda(nl, alpha) + smithLambda(nv, alpha));
}

inline double schlick(double f0, double cosine) {
    return f0 + (1.0 - f0) * std::pow(1.0 - cosine, 5.0);
}

/// Specular BRDF of directions around +Z.
inline double ggxBrdf(const glm::dvec3& v, const glm::dvec3& l, double alpha, double f0) {
    const glm::dvec3 h = glm::normalize(v + l);
    return ggxD(h.z, alpha) * smithG2(l.z, v.z, alpha) * schlick(f0, glm::dot(v, h)) / (4.0 * l.z * v.z);
}

/// Directional albedo by the midpoint rule over half vectors, distributed to resolve the lobe at every alpha:
/// tan(theta) = alpha · s / (1 - s).
inline double ggxAlbedo(double nv, double alpha, double f0, int steps = 256) {
    const glm::dvec3 v(std::sqrt(1.0 - nv * nv), 0.0, nv);
    double sum = 0.0;
    for (int i = 0; i < steps; ++i) {
        const double s = (i + 0.5) / steps;
        const double tangent = alpha * s / (1.0 - s);
        const double theta = std::atan(tangent);
        const double thetaStep = alpha / ((1.0 - s) * (1.0 - s)) / (1.0 + tangent * tangent) / steps;
        for (int j = 0; j < steps; ++j) {
            const double phi = glm::pi<double>() * (j + 0.5) / steps;  // half a turn: the other half is symmetric
            const glm::dvec3 h(std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta));
            const double vh = glm::dot(v, h);
            const glm::dvec3 l = 2.0 * vh * h - v;
            if (vh > 0.0 && l.z > 0.0) {
                const double solidAngleOfL = 4.0 * vh * std::sin(theta) * thetaStep * 2.0 * glm::pi<double>() / steps;
                sum += ggxBrdf(v, l, alpha, f0) * l.z * solidAngleOfL;
            }
        }
    }
    return sum;
}

/// Cumulative distribution of half vectors (weighted by D · cos) over their cosine, integrated over tan(theta).
class GgxDistributionTable {
public:
    explicit GgxDistributionTable(double alpha) : alpha_(alpha), below_(steps + 1, 0.0) {
        for (int i = 0; i < steps; ++i) {  // from the horizon (s = 1) to the normal (s = 0)
            const double s = 1.0 - (i + 0.5) / steps;
            const double tangent = alpha * s / (1.0 - s);
            const double theta = std::atan(tangent);
            const double thetaStep = alpha / ((1.0 - s) * (1.0 - s)) / (1.0 + tangent * tangent) / steps;
            const double z = std::cos(theta);
            below_[i + 1] = below_[i] + ggxD(z, alpha) * z * 2.0 * glm::pi<double>() * std::sin(theta) * thetaStep;
        }
    }

    [[nodiscard]] double total() const { return below_.back(); }
    [[nodiscard]] double below(double z) const {
        const double ratio = std::sqrt(std::max(1.0 - z * z, 0.0)) / z / alpha_;
        const double at = (1.0 - ratio / (1.0 + ratio)) * steps;
        const int i = std::clamp(static_cast<int>(at), 0, steps - 1);
        return glm::mix(below_[i], below_[i + 1], at - i);
    }

private:
    static constexpr int steps = 20000;
    double alpha_;
    std::vector<double> below_;
};

}  // namespace reflet::test
