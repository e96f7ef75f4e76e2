// Measures noise.
#include "job/noise_meter.h"

#include <cmath>

namespace reflet {

namespace {

// Root mean square difference of two pictures of 8-bit display values, 0 to 1.
double difference(std::span<const std::byte> a, std::span<const std::byte> b) {
    double sum = 0.0;
    for (size_t i = 0; i < a.size(); ++i) {
        const double d = std::to_integer<int>(a[i]) - std::to_integer<int>(b[i]);
        sum += d * d;
    }
    return std::sqrt(sum / static_cast<double>(a.size())) / 255.0;
}

}  // namespace

void NoiseMeter::add(uint32_t frame, std::span<const std::byte> display) {
    if (!last_.empty()) {
        noise_ = difference(last_, display);
    }
    last_.assign(display.begin(), display.end());
    next_ = 2 * (frame + 1);
}

}  // namespace reflet
