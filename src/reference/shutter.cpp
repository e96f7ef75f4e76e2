// Averages references at several times.
#include "reference/shutter.h"

#include "base/error.h"
#include "reference/ray_scene.h"
#include "reference/sampler.h"
#include "scene/pose.h"

#include <algorithm>
#include <cmath>
#include <memory>

namespace reflet {

namespace {

constexpr uint32_t mostTimes = 32;
constexpr uint32_t leastSamples = 2;  // of a time: fewer have no noise that could be told

// References of a scene at different times. What does not move is built once.
class Poses {
public:
    explicit Poses(const Scene& scene) : scene_(scene) {
        if (scene.nodes.empty()) {
            still_ = std::make_unique<RayScene>(scene);
        }
    }

    [[nodiscard]] ReferencePicture trace(const View& view, uvec2 size, const ReferenceOptions& options,
                                         const std::function<bool(const ReferenceProgress&)>& proceed) const {
        return still_ ? traceReference(*still_, posed(view, scene_), size, options, proceed)
                      : traceReference(scene_, view, size, options, proceed);
    }

private:
    const Scene& scene_;
    std::unique_ptr<RayScene> still_;
};

void add(FloatImage& sum, const FloatImage& image) {
    if (sum.data.empty()) {
        sum = image;
        return;
    }
    std::ranges::transform(sum.data, image.data, sum.data.begin(), std::plus{});
}

constexpr FloatImage ReferencePicture::*meanLayers[] = {&ReferencePicture::final,
                                                        &ReferencePicture::direct,
                                                        &ReferencePicture::indirectDiffuse,
                                                        &ReferencePicture::indirectSpecular,
                                                        &ReferencePicture::albedo,
                                                        &ReferencePicture::sunVisibility,
                                                        &ReferencePicture::ambientOcclusion,
                                                        &ReferencePicture::coverage};

void add(ReferencePicture& sum, const ReferencePicture& picture) {
    for (FloatImage ReferencePicture::*layer : meanLayers) {
        add(sum.*layer, picture.*layer);
    }
    sum.samples += picture.samples;
    sum.noise += picture.noise * picture.noise;
    sum.rays += picture.rays;
    sum.seconds += picture.seconds;
}

void divide(ReferencePicture& sum, uint32_t count) {
    const float share = 1.0F / static_cast<float>(count);
    for (FloatImage ReferencePicture::*layer : meanLayers) {
        for (float& value : (sum.*layer).data) {
            value *= share;
        }
    }
    sum.noise = std::sqrt(sum.noise) / count;
}

}  // namespace

ReferencePicture traceShutter(const Scene& scene, const ShutterViews& at, uvec2 size, const ReferenceOptions& options,
                              const std::function<bool(const ReferenceProgress&)>& proceed) {
    REFLET_CHECK(options.samples > 0, "{} samples", options.samples);
    const uint32_t times = std::clamp(options.samples / leastSamples, 1U, mostTimes);
    const Poses poses(scene);
    ReferencePicture sum;
    ReferenceOptions own = options;
    own.noise = options.noise * std::sqrt(static_cast<float>(times));
    uint32_t traced = 0;
    const uint64_t pixels = uint64_t(size.x) * size.y;
    const auto tell = [&](const ReferenceProgress& now) {
        return !proceed || proceed({own.firstSample * pixels + now.done, options.samples * pixels, now.noise});
    };
    for (; traced < times && sum.complete; ++traced) {
        own.firstSample = static_cast<uint32_t>(uint64_t(options.samples) * traced / times);
        own.samples = static_cast<uint32_t>(uint64_t(options.samples) * (traced + 1) / times) - own.firstSample;
        const double chance = mixBits(mixBits(options.seed ^ 0x5bd1e995U) ^ mixBits(traced + 1)) * 0x1p-32;
        const ReferencePicture picture = poses.trace(at((traced + chance) / times), size, own, tell);
        add(sum, picture);
        sum.complete = picture.complete;
    }
    divide(sum, traced);
    ReferenceOptions centers = options;
    centers.samples = 1;
    centers.bounces = 0;
    const ReferencePicture middle = poses.trace(at(0.5), size, centers, {});
    sum.depth = middle.depth;
    sum.normal = middle.normal;
    return sum;
}

}  // namespace reflet
