// Records automatic exposure.
#include "effects/exposure/exposure.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <span>

namespace reflet {

uint32_t meterStep(uvec2 size) {
    constexpr double enough = 57600.0;  // pixels; a quarter of 1280x720 along each side
    return static_cast<uint32_t>(std::max(std::sqrt(double(size.x) * size.y / enough), 1.0));
}

gpu::Image measureExposure(gpu::PassList& f, gpu::HistoryImage& own, gpu::Image radiance, gpu::Image depth,
                           float elapsed, float adaptation, float preExposure) {
    const auto scope = f.scope("exposure");
    const gpu::BufferView histogram = f.buffer("histogram", meterSize * sizeof(uint32_t));
    constexpr std::array<uint32_t, meterSize> none{};
    f.update(histogram, std::as_bytes(std::span(none)));
    const uint32_t step = meterStep(radiance.size);
    constexpr uint32_t perThread = 4;  // along each side
    f.compute("meter", "meter.comp")
        .read("radiance", radiance)
        .read("depth", depth)
        .write("histogram", histogram)
        .params(MeterParams{radiance.size, step})
        .dispatch((radiance.size + step * perThread - 1U) / (step * perThread));
    const gpu::History exposures = own.swap(f, VK_FORMAT_R32G32_SFLOAT, {exposureTexels, 1});
    f.compute("smooth", "exposure.comp")
        .read("histogram", histogram)
        .read("previous", exposures.previous)
        .write("next", exposures.next)
        .params(ExposureParams{elapsed, adaptation, exposures.valid ? 1U : 0U, preExposure})
        .dispatch(1);
    return exposures.next;
}

gpu::Image exposureFactor(gpu::PassList& f, gpu::Image exposure) {
    const gpu::Image factor = f.image("exposure_factor", VK_FORMAT_R32_SFLOAT, uvec2(1));
    f.compute("exposure.factor", "exposure_factor.comp").read("exposure", exposure).write("factor", factor).dispatch(1);
    return factor;
}

float exposureOf(const gpu::Recorder& f, gpu::Readback exposure) {
    vec2 smoothed(0.0F);
    std::memcpy(&smoothed, f.bytes(exposure).data() + exposureFrames * sizeof(vec2), sizeof(vec2));
    return smoothed.x;
}

}  // namespace reflet
