// LDR-FLIP: a colour pipeline, a feature pipeline, and their combination.
#include "compare/flip.h"

#include "compare/color.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace reflet {

namespace {

constexpr double piSquared = std::numbers::pi * std::numbers::pi;

// Section 4.1.1. The eye's contrast sensitivity per channel as one or two Gaussians: a is the weight, b the width.
struct Sensitivity {
    double a1, b1, a2, b2;
};
constexpr Sensitivity achromaticSensitivity{1.0, 0.0047, 0.0, 1e-5};
constexpr Sensitivity redGreenSensitivity{1.0, 0.0053, 0.0, 1e-5};
constexpr Sensitivity blueYellowSensitivity{34.1, 0.04, 13.5, 0.025};
constexpr double widestSensitivity = 0.04;  // the largest b, which sets the radius of all three filters

// Section 4.1.4: maps colour distances to 0..1. The exponent compresses large distances; distances below `knee` of the
// largest use `kneeError` of the range.
constexpr float colorExponent = 0.7F;
constexpr float knee = 0.4F;
constexpr float kneeError = 0.95F;

constexpr double featureWidth = 0.082;   // of the detectors in degrees, section 4.2.1
constexpr float featureExponent = 0.5F;  // section 4.2.2

Kernel gaussian(double scale, double b, int radius, double pixelsPerDegree) {
    Kernel kernel;
    for (int x = -radius; x <= radius; ++x) {
        const double degrees = x / pixelsPerDegree;
        kernel.push_back(static_cast<float>(scale * std::exp(-piSquared * degrees * degrees / b)));
    }
    return kernel;
}

double sum(const Kernel& kernel) {
    double total = 0.0;
    for (const float weight : kernel) {
        total += weight;
    }
    return total;
}

void scale(Kernel& kernel, double factor) {
    for (float& weight : kernel) {
        weight = static_cast<float>(weight * factor);
    }
}

// A two-dimensional Gaussian is separable; a sum of two Gaussians is filtered separately.
struct SpatialFilter {
    Kernel first;
    Kernel second;  // empty if the second Gaussian has no weight
};

SpatialFilter makeSpatialFilter(const Sensitivity& s, double pixelsPerDegree) {
    const int radius =
        static_cast<int>(std::ceil(3.0 * std::sqrt(widestSensitivity / (2.0 * piSquared)) * pixelsPerDegree));
    // Applied along rows and columns: each has the square root of the weight a · sqrt(pi / b).
    SpatialFilter filter{gaussian(std::sqrt(s.a1 * std::sqrt(std::numbers::pi / s.b1)), s.b1, radius, pixelsPerDegree),
                         {}};
    double total = std::pow(sum(filter.first), 2.0);
    if (s.a2 > 0.0) {
        filter.second = gaussian(std::sqrt(s.a2 * std::sqrt(std::numbers::pi / s.b2)), s.b2, radius, pixelsPerDegree);
        total += std::pow(sum(filter.second), 2.0);
        scale(filter.second, 1.0 / std::sqrt(total));
    }
    scale(filter.first, 1.0 / std::sqrt(total));
    return filter;
}

// Temporary planes of the filters, reused because allocating them costs as much as a filter.
struct Scratch {
    Scratch(uint32_t width, uint32_t height) : rows(width, height), other(width, height) {}

    Plane rows;
    Plane other;
};

void applySpatialFilter(Plane& plane, const SpatialFilter& filter, Scratch& scratch) {
    filterRows(plane, filter.first, scratch.rows);
    if (filter.second.empty()) {
        filterColumns(scratch.rows, filter.first, plane);
        return;
    }
    filterRows(plane, filter.second, scratch.other);
    filterColumns(scratch.rows, filter.first, plane);
    filterColumns(scratch.other, filter.second, scratch.rows);
    forEachRow(plane.height, [&](uint32_t y) {
        std::transform(plane.row(y), plane.row(y) + plane.width, scratch.rows.row(y), plane.row(y), std::plus<>());
    });
}

// Colours after the contrast sensitivity filter, in Hunt-adjusted CIELAB.
void toPerceived(Planes3& opponent, float pixelsPerDegree, Scratch& scratch) {
    constexpr std::array sensitivities{achromaticSensitivity, redGreenSensitivity, blueYellowSensitivity};
    for (size_t c = 0; c < 3; ++c) {
        applySpatialFilter(opponent[c], makeSpatialFilter(sensitivities[c], pixelsPerDegree), scratch);
    }
    forEachRow(opponent[0].height, [&](uint32_t y) {
        for (uint32_t x = 0; x < opponent[0].width; ++x) {
            const vec3 blurred(opponent[0].row(y)[x], opponent[1].row(y)[x], opponent[2].row(y)[x]);
            const vec3 linear = glm::clamp(opponentToLinear(blurred), 0.0F, 1.0F);
            const vec3 lab = huntAdjusted(linearToLab(linear));
            for (int c = 0; c < 3; ++c) {
                opponent[static_cast<size_t>(c)].row(y)[x] = lab[c];
            }
        }
    });
}

float poweredDistance(const vec3& labA, const vec3& labB) {
    return std::pow(hyabDistance(labA, labB), colorExponent);
}

// The largest distance of two sRGB colours: green and blue.
float largestDistance() {
    return poweredDistance(huntAdjusted(linearToLab({0.0F, 1.0F, 0.0F})),
                           huntAdjusted(linearToLab({0.0F, 0.0F, 1.0F})));
}

float redistributed(float distance, float largest) {
    const float kneeDistance = knee * largest;
    const float error = distance < kneeDistance
                            ? kneeError / kneeDistance * distance
                            : kneeError + (distance - kneeDistance) / (largest - kneeDistance) * (1.0F - kneeError);
    return std::min(error, 1.0F);
}

Planes3 toOpponent(const Planes3& linear) {
    Planes3 opponent = makePlanes3(linear[0].width, linear[0].height);
    forEachRow(linear[0].height, [&](uint32_t y) {
        for (uint32_t x = 0; x < linear[0].width; ++x) {
            const vec3 color = linearToOpponent({linear[0].row(y)[x], linear[1].row(y)[x], linear[2].row(y)[x]});
            for (int c = 0; c < 3; ++c) {
                opponent[static_cast<size_t>(c)].row(y)[x] = color[c];
            }
        }
    });
    return opponent;
}

// Yy normalized to 0..1.
Plane normalizedLuminance(const Plane& opponentY) {
    Plane result = opponentY;
    for (float& value : result.data) {
        value = (value + 16.0F) / 116.0F;
    }
    return result;
}

// A detector's response to black and white is at most 1: its positive weights sum to 1, its negative ones to -1.
Kernel detector(const std::vector<double>& weights) {
    double positive = 0.0;
    double negative = 0.0;
    for (const double weight : weights) {
        (weight > 0.0 ? positive : negative) += std::abs(weight);
    }
    Kernel kernel;
    for (const double weight : weights) {
        kernel.push_back(static_cast<float>(weight / (weight > 0.0 ? positive : negative)));
    }
    return kernel;
}

// Section 4.2.1: first and second derivative of a Gaussian along one axis, the Gaussian itself along the other.
struct FeatureFilters {
    explicit FeatureFilters(double pixelsPerDegree) {
        const double deviation = 0.5 * featureWidth * pixelsPerDegree;
        const int radius = static_cast<int>(std::ceil(3.0 * deviation));
        std::vector<double> edgeWeights;
        std::vector<double> pointWeights;
        for (int x = -radius; x <= radius; ++x) {
            const double square = x * x / (deviation * deviation);
            const double g = std::exp(-0.5 * square);
            edgeWeights.push_back(-x * g);
            pointWeights.push_back((square - 1.0) * g);
            blur.push_back(static_cast<float>(g));
        }
        scale(blur, 1.0 / sum(blur));
        edge = detector(edgeWeights);
        point = detector(pointWeights);
    }

    Kernel blur, edge, point;
};

// Magnitude of (derivative along x, derivative along y) in every pixel.
Plane detectorResponse(const Plane& image, const Kernel& derivative, const Kernel& blur, Scratch& scratch) {
    Plane alongX(image.width, image.height);
    filterRows(image, derivative, scratch.rows);
    filterColumns(scratch.rows, blur, alongX);
    filterRows(image, blur, scratch.rows);
    filterColumns(scratch.rows, derivative, scratch.other);
    forEachRow(image.height, [&](uint32_t y) {
        const float* alongY = scratch.other.row(y);
        float* row = alongX.row(y);
        for (uint32_t x = 0; x < image.width; ++x) {
            row[x] = std::sqrt(row[x] * row[x] + alongY[x] * alongY[x]);
        }
    });
    return alongX;
}

}  // namespace

Plane featureDifference(const Plane& a, const Plane& b, float pixelsPerDegree) {
    const FeatureFilters filters(pixelsPerDegree);
    Scratch scratch(a.width, a.height);
    const Plane edgesA = detectorResponse(a, filters.edge, filters.blur, scratch);
    const Plane edgesB = detectorResponse(b, filters.edge, filters.blur, scratch);
    const Plane pointsA = detectorResponse(a, filters.point, filters.blur, scratch);
    const Plane pointsB = detectorResponse(b, filters.point, filters.blur, scratch);
    Plane difference(a.width, a.height);
    for (size_t i = 0; i < difference.data.size(); ++i) {
        const float larger =
            std::max(std::abs(edgesA.data[i] - edgesB.data[i]), std::abs(pointsA.data[i] - pointsB.data[i]));
        difference.data[i] = std::min(std::pow(larger / std::numbers::sqrt2_v<float>, featureExponent), 1.0F);
    }
    return difference;
}

Plane ldrFlip(const Planes3& linearA, const Planes3& linearB, float pixelsPerDegree) {
    Planes3 a = toOpponent(linearA);
    Planes3 b = toOpponent(linearB);
    Plane flip = featureDifference(normalizedLuminance(a[0]), normalizedLuminance(b[0]), pixelsPerDegree);
    Scratch scratch(flip.width, flip.height);
    toPerceived(a, pixelsPerDegree, scratch);
    toPerceived(b, pixelsPerDegree, scratch);
    const float largest = largestDistance();
    forEachRow(flip.height, [&](uint32_t y) {
        for (uint32_t x = 0; x < flip.width; ++x) {
            const vec3 labA(a[0].row(y)[x], a[1].row(y)[x], a[2].row(y)[x]);
            const vec3 labB(b[0].row(y)[x], b[1].row(y)[x], b[2].row(y)[x]);
            const float color = redistributed(poweredDistance(labA, labB), largest);
            flip.row(y)[x] = std::pow(color, 1.0F - flip.row(y)[x]);
        }
    });
    return flip;
}

}  // namespace reflet
