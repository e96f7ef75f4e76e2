// Chooses resolution and rays of moving frames.
#include "view/effort.h"

#include <algorithm>
#include <cmath>

namespace reflet {

namespace {

constexpr float smallestScale = 0.25F;
constexpr float scaleSteps = 16.0F;  // per unit, so that small differences of time do not change the size

double pixelsOf(uvec2 size) {
    return double(size.x) * double(size.y);
}

float scaleFor(double factor) {
    const auto scale = static_cast<float>(std::sqrt(factor));
    return std::clamp(std::floor(scale * scaleSteps) / scaleSteps, smallestScale, 1.0F);
}

}  // namespace

void reduce(const Effort& effort, uvec2& size, Settings& settings) {
    if (!effort.isReduced()) {
        return;
    }
    size = glm::max(uvec2(glm::round(vec2(size) * effort.scale)), uvec2(16));
    if (effort.fewRays) {
        settings.diffuse.rays = std::min(settings.diffuse.rays, 1U);
        settings.specular.rays = std::min(settings.specular.rays, 1U);
        // Their cost is that of further views, most of it for any size.
        settings.transmission.layers = std::min(settings.transmission.layers, 1U);
        settings.planar.enabled = 0;
    }
}

void EffortControl::note(uvec2 size, const Effort& effort, double milliseconds) {
    if (!effort.isReduced()) {
        perPixel_ = milliseconds / pixelsOf(size);
        return;
    }
    const double factor = targetMs / std::max(milliseconds, 1e-3);
    constexpr double slack = 1.4;
    if (chosen_ == effort && (factor < 1.0 / slack || factor > slack)) {
        chosen_->scale = scaleFor(double(effort.scale) * double(effort.scale) * factor);
    }
}

void EffortControl::noteStopped(uvec2 size, double milliseconds) {
    perPixel_ = std::max(perPixel_, milliseconds / pixelsOf(size));
}

Effort EffortControl::choose(uvec2 size) {
    const double expected = perPixel_ * pixelsOf(size);
    constexpr double slack = 1.25;
    if (expected < slack * targetMs) {
        chosen_.reset();
        return {};
    }
    const bool sameCost = perPixel_ < 1.3 * chosenFor_ && chosenFor_ < 1.3 * perPixel_;
    if (!chosen_ || !sameCost) {
        chosen_ = Effort{scaleFor(targetMs / expected), true};
        chosenFor_ = perPixel_;
    }
    return *chosen_;
}

}  // namespace reflet
