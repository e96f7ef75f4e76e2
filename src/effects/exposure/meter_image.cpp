// Automatic exposure on the CPU: compiles the shader's metering as C++ and runs it on an image.
#include "base/error.h"
#include "effects/exposure/exposure.h"
#include "effects/tonemap/tonemap.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

namespace reflet {
namespace {

// GLSL built-ins. All headers that the files include must be included above.
namespace glsl {
using namespace glm;
#include "shaders/luminance.glsl"

struct Meter {
    std::array<uint32_t, meterSize> numbers{};

    [[nodiscard]] uint32_t meterCount(uint32_t i) const { return numbers[i]; }
#include "effects/exposure/meter.glsl"

    [[nodiscard]] uint32_t total(uint32_t kind) const {
        const auto first = numbers.begin() + kind;
        return std::accumulate(first, first + meterBins, 0U);
    }
    [[nodiscard]] float mean(uint32_t kind, uint32_t which) {
        const auto all = static_cast<float>(total(kind));
        const float sum = meterPart(kind, 0, meterBins, 0, firstShare(which) * all, lastShare(which) * all);
        return meterMean(sum, lastShare(which) * all - firstShare(which) * all);
    }
    [[nodiscard]] float exposure(uint32_t kind) {
        return exposureFor(total(kind), mean(kind, 0), mean(kind, 1), mean(kind, 2));
    }
    [[nodiscard]] float exposure() {
        return exposureForAll(total(meterSurfaces), exposure(meterSurfaces), total(meterBackground),
                              exposure(meterBackground), mean(meterBackground, 0));
    }
};
}  // namespace glsl

// Stops that bring the brightest value into the range of the levels, and the darkest with it. Whole ones change nothing
// else.
float stopsIntoRange(const FloatImage& radiance) {
    constexpr int dim = -8;
    const float brightest = std::accumulate(radiance.data.begin(), radiance.data.end(), 0.0F, [](float most, float v) {
        return std::isfinite(v) ? std::max(most, v) : most;
    });
    const float stops = brightest > 0.0F ? std::ceil(std::log2(brightest)) : 0.0F;
    return stops < dim ? -stops : std::min(float(highestStop) - stops, 0.0F);
}

}  // namespace

float meteredExposure(const FloatImage& radiance, const FloatImage& depth) {
    REFLET_CHECK(radiance.channels.size() == 3, "{} channels", radiance.channels.size());
    const size_t pixels = size_t(radiance.width) * radiance.height;
    REFLET_CHECK(depth.data.empty() || depth.data.size() == pixels, "{} depths of {} pixels", depth.data.size(),
                 pixels);
    const uint32_t step = meterStep({radiance.width, radiance.height});
    const float stops = stopsIntoRange(radiance);
    const float factor = std::exp2(stops);
    glsl::Meter meter;
    for (uint32_t y = step / 2; y < radiance.height; y += step) {
        for (uint32_t x = step / 2; x < radiance.width; x += step) {
            const size_t pixel = size_t(y) * radiance.width + x;
            const float* c = &radiance.data[3 * pixel];
            const int level = meter.meterLevel(factor * glsl::luminance({c[0], c[1], c[2]}));
            if (level >= 0) {
                const bool surface = depth.data.empty() || depth.data[pixel] > 0.0F;
                const uint32_t bin =
                    (surface ? meterSurfaces : meterBackground) + static_cast<uint32_t>(level) / levelsPerBin;
                ++meter.numbers[bin];
                meter.numbers[meterSums + bin] += static_cast<uint32_t>(level) % levelsPerBin;
            }
        }
    }
    return meter.exposure() + stops;
}

}  // namespace reflet
