// HDR-FLIP: LDR-FLIP over a range of exposures.
#include "compare/flip.h"

#include "compare/color.h"

#include <algorithm>
#include <cmath>

namespace reflet {

namespace {

// y(x) = (k0 x² + k1 x + k2) / (k3 x² + k4 x + k5) with k2 = 0. The radiance is scaled by 0.6 as in the paper, because
// the curve's author found it too bright otherwise.
constexpr double preScale = 0.6;
constexpr double k0 = 2.51 * preScale * preScale;
constexpr double k1 = 0.03 * preScale;
constexpr double k3 = 2.43 * preScale * preScale;
constexpr double k4 = 0.59 * preScale;
constexpr double k5 = 0.14;

constexpr double brightTone = 0.85;  // t in the paper: bright, but not saturated

// The radiance that displayTone maps to brightTone: y(x) = t is (t k3 - k0) x² + (t k4 - k1) x + t k5 = 0.
double brightRadiance() {
    const double a = brightTone * k3 - k0;
    const double b = brightTone * k4 - k1;
    const double c = brightTone * k5;
    const double half = -0.5 * b / a;
    return half + std::sqrt(half * half - c / a);
}

// values: in any order, at least one.
double median(std::vector<float>& values) {
    const auto middle = values.begin() + static_cast<ptrdiff_t>(values.size() / 2);
    std::ranges::nth_element(values, middle);
    if (values.size() % 2 == 1) {
        return *middle;
    }
    return 0.5 * (static_cast<double>(*middle) + *std::max_element(values.begin(), middle));
}

vec3 positive(const Planes3& planes, size_t i) {
    return glm::max(vec3(planes[0].data[i], planes[1].data[i], planes[2].data[i]), 0.0F);
}

// In double until tone mapping, because 2^exposure may overflow a float.
Planes3 exposed(const Planes3& radiance, double exposure) {
    const double factor = std::exp2(exposure);
    constexpr double whiteForSure = 1e4;
    Planes3 display = makePlanes3(radiance[0].width, radiance[0].height);
    for (size_t c = 0; c < 3; ++c) {
        forEachRow(display[c].height, [&](uint32_t y) {
            std::transform(radiance[c].row(y), radiance[c].row(y) + display[c].width, display[c].row(y), [&](float v) {
                return displayTone(static_cast<float>(std::clamp(v * factor, 0.0, whiteForSure)));
            });
        });
    }
    return display;
}

}  // namespace

double ExposureRange::at(uint32_t index) const {
    return count < 2 ? start : start + (stop - start) * index / (count - 1);
}

float displayTone(float radiance) {
    const double x = std::max(radiance, 0.0F);
    return static_cast<float>(std::min((k0 * x + k1) * x / ((k3 * x + k4) * x + k5), 1.0));
}

ExposureRange exposureRange(const Planes3& reference) {
    std::vector<float> luminances(reference[0].data.size());
    for (size_t i = 0; i < luminances.size(); ++i) {
        luminances[i] = cieLuminance(positive(reference, i));
    }
    const double largest = *std::ranges::max_element(luminances);
    if (largest <= 0.0) {
        return {};
    }
    double middle = median(luminances);
    if (middle <= 0.0) {
        std::erase_if(luminances, [](float y) { return y <= 0.0F; });
        middle = median(luminances);
    }
    ExposureRange range{std::log2(brightRadiance() / largest), std::log2(brightRadiance() / middle), 1};
    if (range.stop > range.start) {
        range.count = std::max(2U, static_cast<uint32_t>(std::ceil(range.stop - range.start)));
    }
    return range;
}

Plane hdrFlip(const Planes3& image, const Planes3& reference, float pixelsPerDegree) {
    const ExposureRange range = exposureRange(reference);
    Plane largest(reference[0].width, reference[0].height);
    for (uint32_t i = 0; i < range.count; ++i) {
        const double exposure = range.at(i);
        const Plane flip = ldrFlip(exposed(image, exposure), exposed(reference, exposure), pixelsPerDegree);
        std::ranges::transform(largest.data, flip.data, largest.data.begin(),
                               [](float a, float b) { return std::max(a, b); });
    }
    return largest;
}

}  // namespace reflet
