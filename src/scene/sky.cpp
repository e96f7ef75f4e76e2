// The analytic daylight model of Preetham, Shirley and Smits (1999), and the studio.
#include "scene/sky.h"

#include "base/color.h"
#include "base/error.h"
#include "scene/environment.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace reflet {
namespace {

constexpr uvec2 imageSize{1024, 512};
constexpr double turbidity = 3.0;
constexpr double groundAlbedo = 0.25;
constexpr double radian = glm::pi<double>() / 180.0;

using glm::dvec3;

// The paper's distribution coefficients for (Y, x, y), by rows A to E.
dvec3 perez(double t, double cosTheta, double gamma) {
    const dvec3 a = dvec3(0.1787, -0.0193, -0.0167) * t + dvec3(-1.4630, -0.2592, -0.2608);
    const dvec3 b = dvec3(-0.3554, -0.0665, -0.0950) * t + dvec3(0.4275, 0.0008, 0.0092);
    const dvec3 c = dvec3(-0.0227, -0.0004, -0.0079) * t + dvec3(5.3251, 0.2125, 0.2102);
    const dvec3 d = dvec3(0.1206, -0.0641, -0.0441) * t + dvec3(-2.5771, -0.8989, -1.6537);
    const dvec3 e = dvec3(-0.0670, -0.0033, -0.0109) * t + dvec3(0.3703, 0.0452, 0.0529);
    const double cosGamma = std::cos(gamma);
    return (1.0 + a * glm::exp(b / std::max(cosTheta, 1e-3))) *
           (1.0 + c * glm::exp(d * gamma) + e * cosGamma * cosGamma);
}

// (Y [kcd/m²], x, y) at the zenith.
dvec3 zenith(double t, double sunTheta) {
    const double chi = (4.0 / 9.0 - t / 120.0) * (glm::pi<double>() - 2.0 * sunTheta);
    const double luminance = (4.0453 * t - 4.9710) * std::tan(chi) - 0.2155 * t + 2.4192;
    const glm::dvec4 s(sunTheta * sunTheta * sunTheta, sunTheta * sunTheta, sunTheta, 1.0);
    const auto cubic = [&](const glm::dvec4& square, const glm::dvec4& linear, const glm::dvec4& constant) {
        return glm::dot(square * t * t + linear * t + constant, s);
    };
    return {luminance,
            cubic({0.00166, -0.00375, 0.00209, 0.0}, {-0.02903, 0.06377, -0.03202, 0.00394},
                  {0.11693, -0.21196, 0.06052, 0.25886}),
            cubic({0.00275, -0.00610, 0.00317, 0.0}, {-0.04214, 0.08970, -0.04153, 0.00516},
                  {0.15346, -0.26756, 0.06670, 0.26688})};
}

// Linear Rec. 709 from CIE XYZ (IEC 61966-2-1).
dvec3 rgbFromXyz(const dvec3& c) {
    return {3.2406 * c.x - 1.5372 * c.y - 0.4986 * c.z, -0.9689 * c.x + 1.8758 * c.y + 0.0415 * c.z,
            0.0557 * c.x - 0.2040 * c.y + 1.0570 * c.z};
}

/// Radiance of the sky in a direction above the horizon [kcd/m²], for one place of the sun.
class Dome {
public:
    explicit Dome(double sunTheta)
        : toSun_(0.0, std::cos(sunTheta), -std::sin(sunTheta)),
          scale_(zenith(turbidity, sunTheta) / perez(turbidity, 1.0, sunTheta)) {}

    [[nodiscard]] dvec3 operator()(const dvec3& direction) const {
        const double gamma = std::acos(std::clamp(glm::dot(direction, toSun_), -1.0, 1.0));
        const dvec3 c = scale_ * perez(turbidity, direction.y, gamma);
        return glm::max(rgbFromXyz({c.x * c.y / c.z, c.x, c.x * (1.0 - c.y - c.z) / c.z}), dvec3(0.0));
    }

private:
    dvec3 toSun_;
    dvec3 scale_;
};

// CIE 1931 colour matching functions. (C. Wyman, P.-P. Sloan, P. Shirley, Simple Analytic Approximations to the CIE XYZ
// Color Matching Functions, 2013: multi-lobe fit.) wavelength: nm.
dvec3 matchingFunctions(double wavelength) {
    const auto lobe = [&](double center, double below, double above) {
        const double d = (wavelength - center) / (wavelength < center ? below : above);
        return std::exp(-0.5 * d * d);
    };
    return {1.056 * lobe(599.8, 37.9, 31.0) + 0.362 * lobe(442.0, 16.0, 26.7) - 0.065 * lobe(501.1, 20.4, 26.2),
            0.821 * lobe(568.8, 46.9, 40.5) + 0.286 * lobe(530.9, 16.3, 31.1),
            1.217 * lobe(437.0, 11.8, 36.0) + 0.681 * lobe(459.0, 26.0, 13.8)};
}

// Share of the sun's light that arrives, by the paper's appendix: Rayleigh scattering, aerosol (Ångström), ozone
// (0.35 cm). elevation: 0 to pi/2.
double sunTransmittance(double wavelength, double elevation) {
    // Absorption of ozone [1/cm] every 20 nm from 440 to 700 nm (M. Iqbal, An Introduction to Solar Radiation, 1983).
    static constexpr std::array<double, 14> ozone{0.003, 0.006, 0.014, 0.030, 0.048, 0.075, 0.103,
                                                  0.120, 0.125, 0.105, 0.079, 0.057, 0.036, 0.023};
    const double zenithDegrees = 90.0 - elevation / radian;
    const double airMass = 1.0 / (std::sin(elevation) + 0.15 * std::pow(93.885 - zenithDegrees, -1.253));
    const double micrometres = wavelength / 1000.0;
    const double at = std::clamp((wavelength - 440.0) / 20.0, 0.0, 12.999);
    const auto index = static_cast<size_t>(at);
    const double absorbed = glm::mix(ozone[index], ozone[index + 1], at - static_cast<double>(index));
    const double aerosol = 0.04608 * turbidity - 0.04586;
    return std::exp(
        -airMass * (0.008735 * std::pow(micrometres, -4.08) + aerosol * std::pow(micrometres, -1.3) + 0.35 * absorbed));
}

// Irradiance on a surface that faces the sun [klx], as linear Rec. 709.
dvec3 sunIrradiance(double elevation) {
    constexpr double outside = 133.3;  // klx above the atmosphere
    dvec3 sum(0.0);
    double whole = 0.0;
    for (double wavelength = 380.0; wavelength <= 780.0; wavelength += 5.0) {
        const double metres = wavelength * 1e-9;
        const double planck = 1.0 / (std::pow(wavelength, 5.0) * (std::exp(0.0143878 / (metres * 5778.0)) - 1.0));
        const dvec3 response = planck * matchingFunctions(wavelength);
        sum += response * sunTransmittance(wavelength, elevation);
        whole += response.y;
    }
    return glm::max(rgbFromXyz(outside * sum / whole), dvec3(0.0));
}

// A camera's picture of the sky: white-balanced, and with half the saturation, without which shadows and metals look
// dyed. Linear, so that both changes keep the neutral sum of sun and sky.
dvec3 toned(const dvec3& color, const dvec3& gains) {
    constexpr double saturation = 0.5;
    const dvec3 balanced = gains * color;
    return glm::mix(dvec3(luminance(vec3(balanced))), balanced, saturation);
}

// Irradiance of the dome on a horizontal surface [klx]: midpoint rule in cos² theta and azimuth.
dvec3 skyIrradiance(const Dome& dome) {
    constexpr int count = 32;
    dvec3 sum(0.0);
    for (int i = 0; i < count; ++i) {
        const double cosine = std::sqrt((i + 0.5) / count);
        const double sine = std::sqrt(1.0 - cosine * cosine);
        for (int j = 0; j < count; ++j) {
            const double azimuth = glm::pi<double>() * (j + 0.5) / count;  // symmetric: half the circle
            sum += dome({sine * std::sin(azimuth), cosine, -sine * std::cos(azimuth)});
        }
    }
    return glm::pi<double>() / (count * count) * sum;
}

// Gains that make a horizontal surface neutral under a sun at 53 degrees, keeping its luminance.
dvec3 whiteBalance() {
    const double elevation = 53.0 * radian;
    const dvec3 total = std::sin(elevation) * sunIrradiance(elevation) + skyIrradiance(Dome(90.0 * radian - elevation));
    return double(luminance(vec3(total))) / total;
}

}  // namespace

Sky makeSky(float elevation) {
    constexpr double lowest = 10.0 * radian;
    constexpr double night = -18.0 * radian;
    static const dvec3 gains = whiteBalance();
    const double shown = std::clamp<double>(elevation, 0.0, 90.0 * radian);
    const double unit =
        Sky::sunLuminance / double(luminance(vec3(toned(sunIrradiance(std::max(shown, lowest)), gains))));
    // Illuminance falls by a factor of 120 from sunset to civil dusk, 6 degrees below the horizon.
    const double twilight = unit * std::pow(120.0, std::clamp<double>(elevation, night, 0.0) / (6.0 * radian));
    const Dome dome(90.0 * radian - shown);
    Sky sky;
    sky.sunIrradiance = elevation > 0.0F ? vec3(unit * toned(sunIrradiance(shown), gains)) : vec3(0.0F);
    const dvec3 ground = groundAlbedo / glm::pi<double>() *
                         (twilight * toned(skyIrradiance(dome), gains) + std::sin(shown) * dvec3(sky.sunIrradiance));
    sky.image = {imageSize.x, imageSize.y, {"R", "G", "B"}, {}};
    sky.image.data.reserve(size_t{3} * imageSize.x * imageSize.y);
    for (uint32_t row = 0; row < imageSize.y; ++row) {
        for (uint32_t column = 0; column < imageSize.x; ++column) {
            const vec2 uv = (vec2(column, row) + 0.5F) / vec2(imageSize);
            const dvec3 direction = environmentDirection(uv, 0.0F);
            const dvec3 above = glm::normalize(dvec3(direction.x, std::max(direction.y, 0.0), direction.z));
            const double below = glm::smoothstep(0.0, 0.06, -direction.y);  // haze over the horizon
            const vec3 radiance = glm::mix(twilight * toned(dome(above), gains), ground, below);
            sky.image.data.insert(sky.image.data.end(), {radiance.x, radiance.y, radiance.z});
        }
    }
    return sky;
}

namespace {

struct SoftBox {
    vec3 towards;   // the box's centre
    vec2 halfSize;  // tangents of half its width and height
    float radiance;
};

// Share of the box in a direction: 1 inside, falling to 0 over its soft edge.
float coverage(const SoftBox& box, const vec3& direction) {
    constexpr float edge = 0.06F;
    const vec3 axis = glm::normalize(box.towards);
    const float ahead = glm::dot(direction, axis);
    if (ahead <= 0.05F) {
        return 0.0F;
    }
    const vec3 right = glm::normalize(glm::cross(axis, std::abs(axis.y) < 0.99F ? vec3(0, 1, 0) : vec3(0, 0, -1)));
    const vec2 at = vec2(glm::dot(direction, right), glm::dot(direction, glm::cross(right, axis))) / ahead;
    const vec2 inside = glm::smoothstep(-box.halfSize - edge, -box.halfSize + edge, -glm::abs(at));
    return inside.x * inside.y;
}

}  // namespace

FloatImage makeStudio() {
    // The camera looks along -Z, so it stands at +Z and its left is -X.
    static constexpr std::array<SoftBox, 4> boxes{{{{-0.75F, 0.60F, 0.80F}, {0.70F, 0.60F}, 3.2F},
                                                   {{0.95F, 0.25F, 0.45F}, {0.35F, 0.60F}, 1.1F},
                                                   {{0.75F, 0.60F, -0.90F}, {0.12F, 0.50F}, 3.0F},
                                                   {{0.0F, 1.0F, -0.12F}, {0.60F, 0.40F}, 1.2F}}};
    FloatImage image{imageSize.x, imageSize.y, {"R", "G", "B"}, {}};
    image.data.reserve(size_t{3} * imageSize.x * imageSize.y);
    for (uint32_t row = 0; row < imageSize.y; ++row) {
        for (uint32_t column = 0; column < imageSize.x; ++column) {
            const vec3 direction = environmentDirection((vec2(column, row) + 0.5F) / vec2(imageSize), 0.0F);
            // The surround: darker floor, lighter above.
            float radiance = glm::mix(0.15F, 0.33F, glm::smoothstep(-0.4F, 0.5F, direction.y));
            for (const SoftBox& box : boxes) {
                radiance = glm::mix(radiance, box.radiance, coverage(box, direction));
            }
            image.data.insert(image.data.end(), 3, radiance);
        }
    }
    return image;
}

vec3 meanRadiance(const FloatImage& image) {
    REFLET_CHECK(image.channels.size() == 3, "{} channels", image.channels.size());
    dvec3 sum(0.0);
    double total = 0.0;
    for (uint32_t row = 0; row < image.height; ++row) {
        const double solidAngle = std::sin(glm::pi<double>() * (row + 0.5) / image.height);
        const float* texel = &image.data[size_t{3} * row * image.width];
        for (uint32_t column = 0; column < image.width; ++column, texel += 3) {
            sum += solidAngle * dvec3(texel[0], texel[1], texel[2]);
        }
        total += solidAngle * image.width;
    }
    return sum / total;
}

}  // namespace reflet
