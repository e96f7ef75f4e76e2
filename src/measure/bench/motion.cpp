// Measures frames in motion.
#include "measure/bench/motion.h"

#include "base/error.h"
#include "base/progress.h"
#include "compare/compare.h"
#include "measure/bench/displayed_flip.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>
#include <string>

namespace reflet {

namespace {

// Bilinear sample; `at` in pixels, pixel centres at halves, inside the image.
float bilinear(const FloatImage& image, vec2 at, size_t channel) {
    const vec2 last(static_cast<float>(image.width - 1), static_cast<float>(image.height - 1));
    const vec2 place = glm::clamp(at - 0.5F, vec2(0.0F), last);
    const uvec2 low(place);
    const uvec2 high = glm::min(low + 1U, uvec2(last));
    const vec2 share = place - vec2(low);
    const auto texel = [&](uint32_t x, uint32_t y) {
        return image.data[(size_t(y) * image.width + x) * image.channels.size() + channel];
    };
    return std::lerp(std::lerp(texel(low.x, low.y), texel(high.x, low.y), share.x),
                     std::lerp(texel(low.x, high.y), texel(high.x, high.y), share.x), share.y);
}

const std::string reflections = "indirect_specular";
// Frames at rest, the last of which are averaged to the final value: single frames are noisy.
constexpr uint32_t framesToRest = 48;
constexpr uint32_t finalFrames = 16;

struct Moved {
    FloatImage picture;
    FloatImage motion;
    FloatImage depth;
};

struct MovedFrames {
    std::vector<Moved> moving;
    std::vector<double> rest;  // as in MotionResult
};

std::vector<double> renderRest(Subject& subject, const MotionPlan& plan, const FloatImage& before) {
    std::vector<FloatImage> frames;
    FloatImage final;
    const uint32_t count = std::max(framesToRest, plan.rest + finalFrames);
    for (uint32_t i = 0; i < count; ++i) {
        FloatImage frame = std::move(subject.picture({reflections}).at(reflections));
        if (i + finalFrames == count) {
            final = frame;
        } else if (i + finalFrames > count) {
            std::ranges::transform(final.data, frame.data, final.data.begin(), std::plus());
        }
        if (i < plan.rest) {
            frames.push_back(std::move(frame));
        }
    }
    for (float& value : final.data) {
        value /= finalFrames;
    }
    std::vector<double> rest;
    rest.reserve(frames.size());
    for (const FloatImage& frame : frames) {
        rest.push_back(changeAtRest(frame, final, before));
    }
    return rest;
}

MovedFrames renderMotion(gpu::Device& device, const BenchScene& scene, uvec2 size, const Settings& settings,
                         const MotionPlan& plan) {
    Subject subject(device, scene, size, settings);
    Progress progress(scene.name + ", in motion: frame", plan.frames);
    for (uint32_t i = 0; i < plan.warmup; ++i) {
        subject.render();
    }
    const FloatImage before = plan.rest > 0 ? subject.picture({reflections}).at(reflections) : FloatImage{};
    MovedFrames frames;
    for (uint32_t i = 0; i < plan.frames; ++i) {
        subject.setView(viewInMotion(scene.view, plan, i + 1));
        Layers layers = subject.picture({"final", "motion", "depth"});
        frames.moving.push_back(
            {std::move(layers.at("final")), std::move(layers.at("motion")), std::move(layers.at("depth"))});
        progress.advance();
    }
    if (plan.rest > 0) {
        frames.rest = renderRest(subject, plan, before);
    }
    return frames;
}

}  // namespace

View viewInMotion(const View& view, const MotionPlan& plan, uint32_t frame) {
    const float angle =
        glm::radians(plan.degrees) * static_cast<float>(frame) / static_cast<float>(std::max(plan.frames, 1U));
    const vec3 arm = view.camera.position - view.camera.target;
    const float c = std::cos(angle);
    const float s = std::sin(angle);
    View moved = view;
    moved.time += static_cast<double>(frame) / plan.fps;
    moved.camera.position = view.camera.target + vec3(c * arm.x + s * arm.z, arm.y, c * arm.z - s * arm.x);
    moved.camera.up = {c * view.camera.up.x + s * view.camera.up.z, view.camera.up.y,
                       c * view.camera.up.z - s * view.camera.up.x};
    return moved;
}

double changeBeyondMotion(const FloatImage& now, const FloatImage& before, const FloatImage& motion) {
    REFLET_CHECK(now.data.size() == before.data.size() && motion.width == now.width && motion.height == now.height,
                 "images of {}x{} and {}x{}", now.width, now.height, motion.width, motion.height);
    const size_t channels = now.channels.size();
    const vec2 size(static_cast<float>(now.width), static_cast<float>(now.height));
    double sum = 0.0;
    uint64_t count = 0;
    for (uint32_t y = 0; y < now.height; ++y) {
        for (uint32_t x = 0; x < now.width; ++x) {
            const size_t pixel = size_t(y) * now.width + x;
            const vec2 moved(motion.data[pixel * motion.channels.size()],
                             motion.data[pixel * motion.channels.size() + 1]);
            const vec2 at = vec2(static_cast<float>(x) + 0.5F, static_cast<float>(y) + 0.5F) - moved * size;
            if (glm::any(glm::lessThan(at, vec2(0.0F))) || glm::any(glm::greaterThan(at, size))) {
                continue;
            }
            for (size_t c = 0; c < channels; ++c) {
                sum += std::abs(double(now.data[pixel * channels + c]) - bilinear(before, at, c));
            }
            ++count;
        }
    }
    return count > 0 ? sum / static_cast<double>(count * channels) : 0.0;
}

double changeAtRest(const FloatImage& frame, const FloatImage& final, const FloatImage& before) {
    REFLET_CHECK(frame.data.size() == final.data.size() && before.data.size() == final.data.size(),
                 "images of {}x{}, {}x{} and {}x{}", frame.width, frame.height, final.width, final.height, before.width,
                 before.height);
    const size_t channels = final.channels.size();
    const double mean = std::accumulate(final.data.begin(), final.data.end(), 0.0) / double(final.data.size());
    double changed = 0.0;
    double sum = 0.0;
    double difference = 0.0;
    for (size_t pixel = 0; pixel < final.data.size(); pixel += channels) {
        double step = 0.0;
        for (size_t i = pixel; i < pixel + channels; ++i) {
            step += std::abs(double(final.data[i]) - before.data[i]) / double(channels);
        }
        for (size_t i = pixel; i < pixel + channels && step > 0.1 * mean; ++i) {
            difference += std::abs(double(frame.data[i]) - final.data[i]);
            sum += final.data[i];
            ++changed;
        }
    }
    return changed > 0.0 && sum > 0.0 ? difference / sum : 0.0;
}

MotionResult measureMotion(gpu::Device& device, const BenchScene& scene, uvec2 size, const Settings& settings,
                           const TruthOptions& truth, const MotionPlan& plan) {
    const MovedFrames moved = renderMotion(device, scene, size, settings, plan);
    const std::vector<Moved>& frames = moved.moving;
    MotionResult result;
    result.rest = moved.rest;
    BenchScene now = scene;
    FloatImage truthBefore;
    for (uint32_t i = 0; i < plan.frames; ++i) {
        now.view = viewInMotion(scene.view, plan, i + 1);
        const Truth own = getTruth(device, now, size, settings, truth);
        const FloatImage& picture = own.layers.at("final");
        CompareOptions options;
        options.octaves = true;
        const Difference difference = compareImages(frames[i].picture, picture, options).difference;
        result.flip.push_back(difference.flip);
        result.relativeMse.push_back(difference.relativeMse);
        std::ranges::transform(result.octaves, difference.octaves, result.octaves.begin(),
                               [&](double mean, double value) { return mean + value / plan.frames; });
        result.displayedFlip.push_back(displayedFlip(frames[i].picture, picture, frames[i].depth, settings.tonemap,
                                                     scene.scene, options.pixelsPerDegree));
        if (i > 0) {
            const double turns = plan.frames - 1;
            result.flicker += changeBeyondMotion(frames[i].picture, frames[i - 1].picture, frames[i].motion) / turns;
            result.truthFlicker += changeBeyondMotion(picture, truthBefore, frames[i].motion) / turns;
        }
        truthBefore = picture;
    }
    return result;
}

}  // namespace reflet
