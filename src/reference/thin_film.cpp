// Thin films.
#include "reference/thin_film.h"

#include "reference/microfacet.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace reflet {

namespace {

/// A Gaussian of the Fourier transform of a colour matching function; the paper's table of fits.
struct Fit {
    size_t channel;  ///< X, Y, Z
    double height;
    double middle;
    double variance;
};
constexpr std::array<Fit, 4> fits{{{0, 5.4856e-13, 1.6810e6, 4.3278e9},
                                   {1, 4.4201e-13, 1.7953e6, 9.3046e9},
                                   {2, 5.2481e-13, 2.2084e6, 6.6121e9},
                                   {0, 9.7470e-14, 2.2399e6, 4.5282e9}}};
constexpr double normalization = 1.0685e-7;

/// Linear RGB (Rec. 709) of light whose waves are `path` [m] and a phase per channel out of step.
glm::dvec3 interference(double path, const glm::dvec3& shift) {
    const double k = 2.0 * glm::pi<double>() * path;
    glm::dvec3 xyz(0.0);
    for (const Fit& fit : fits) {
        const auto c = static_cast<int>(fit.channel);
        xyz[c] += fit.height * std::sqrt(2.0 * glm::pi<double>() * fit.variance) * std::cos(fit.middle * k + shift[c]) *
                  std::exp(-fit.variance * k * k);
    }
    xyz /= normalization;
    return {3.2404542 * xyz.x - 1.5371385 * xyz.y - 0.4985314 * xyz.z,
            -0.9692660 * xyz.x + 1.8760108 * xyz.y + 0.0415560 * xyz.z,
            0.0556434 * xyz.x - 0.2040259 * xyz.y + 1.0572252 * xyz.z};
}

double fresnel(double f0, double cosine) {
    return f0 + (1.0 - f0) * schlick(static_cast<float>(cosine));
}

double normalIncidence(double a, double b) {
    const double root = (a - b) / (a + b);
    return root * root;
}

}  // namespace

vec3 ThinFilm::reflectance(float cosine, const vec3& f0) const {
    constexpr double appears = 30.0;  // nm: below, the film's index fades to that of air
    const double part = std::clamp(thickness / appears, 0.0, 1.0);
    const double n = glm::mix(1.0, double(ior), part * part * (3.0 - 2.0 * part));
    const double sine2 = (1.0 - double(cosine) * cosine) / (n * n);
    if (sine2 >= 1.0) {
        return vec3(1.0F);
    }
    const double inside = std::sqrt(1.0 - sine2);
    const double outer = fresnel(normalIncidence(n, 1.0), cosine);
    const double passes = 1.0 - outer;
    glm::dvec3 order(0.0);
    glm::dvec3 step(0.0);
    glm::dvec3 shift(0.0);
    glm::dvec3 sum(0.0);
    for (int c = 0; c < 3; ++c) {
        const double root = std::sqrt(std::clamp(double(f0[c]), 0.0, 0.9999));
        const double base = (1.0 + root) / (1.0 - root);
        const double inner = fresnel(normalIncidence(base, n), inside);
        const double both = std::clamp(outer * inner, 1e-5, 0.9999);
        const double often = passes * passes * inner / (1.0 - both);
        sum[c] = outer + often;
        order[c] = often - passes;
        step[c] = std::sqrt(both);
        shift[c] = glm::pi<double>() * (base < n ? 2.0 : 1.0);
    }
    const double path = 2.0 * n * thickness * 1e-9 * inside;
    for (int m = 1; m <= 2; ++m) {
        order *= step;
        sum += 2.0 * order * interference(m * path, double(m) * shift);
    }
    return vec3(glm::clamp(sum, 0.0, 1.0));
}

vec3 ThinFilm::f0At(float cosine, const vec3& f0) const {
    const float edge = std::min(schlick(cosine), 0.999F);
    return glm::clamp((reflectance(cosine, f0) - edge) / (1.0F - edge), 0.0F, 1.0F);
}

}  // namespace reflet
