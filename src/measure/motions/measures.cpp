#include "measure/motions/measures.h"

#include "base/error.h"
#include "base/math.h"
#include "measure/bench/motion.h"

#include <algorithm>
#include <limits>
#include <numeric>

namespace reflet {

namespace {

constexpr double none = std::numeric_limits<double>::quiet_NaN();
constexpr int radius = 2;          // pixels to each side whose light counts as there
constexpr float least = 0.05F;     // compressed; smaller differences are no former light
constexpr double leastStep = 0.1;  // of the mean, for stepLeft

vec3 texel(const FloatImage& image, int x, int y) {
    const int cx = std::clamp(x, 0, static_cast<int>(image.width) - 1);
    const int cy = std::clamp(y, 0, static_cast<int>(image.height) - 1);
    const float* at = &image.data[(static_cast<size_t>(cy) * image.width + static_cast<size_t>(cx)) * 3];
    return {at[0], at[1], at[2]};
}

vec3 bilinear(const FloatImage& image, const vec2& at) {
    const vec2 place = at - 0.5F;
    const vec2 low = glm::floor(place);
    const vec2 share = place - low;
    const int x = static_cast<int>(low.x);
    const int y = static_cast<int>(low.y);
    return glm::mix(glm::mix(texel(image, x, y), texel(image, x + 1, y), share.x),
                    glm::mix(texel(image, x, y + 1), texel(image, x + 1, y + 1), share.x), share.y);
}

struct Limits {
    vec3 low;
    vec3 high;

    [[nodiscard]] vec3 excess(const vec3& light) const { return light - glm::clamp(light, low, high); }
};

Limits limitsAround(const FloatImage& image, int x, int y) {
    Limits limits{vec3(std::numeric_limits<float>::max()), vec3(0.0F)};
    for (int dy = -radius; dy <= radius; ++dy) {
        for (int dx = -radius; dx <= radius; ++dx) {
            const vec3 light = texel(image, x + dx, y + dy);
            limits.low = glm::min(limits.low, light);
            limits.high = glm::max(limits.high, light);
        }
    }
    return limits;
}

float largest(const vec3& v) {
    const vec3 size = glm::abs(v);
    return std::max({size.x, size.y, size.z});
}

// One step into the past; false outside of the image.
bool followMotion(const FloatImage& motion, vec2& at) {
    const vec2 size(static_cast<float>(motion.width), static_cast<float>(motion.height));
    const uvec2 pixel(at);
    const float* moved = &motion.data[(size_t(pixel.y) * motion.width + pixel.x) * motion.channels.size()];
    at -= vec2(moved[0], moved[1]) * size;
    return glm::all(glm::greaterThanEqual(at, vec2(0.0F))) && glm::all(glm::lessThan(at, size));
}

// Sums over pixels of one age.
struct Shares {
    double product = 0.0;
    double square = 0.0;
    uint64_t pixels = 0;
};

struct Compressed {
    FloatImage picture;
    FloatImage settled;
};

void addPixel(std::span<const MotionFrame> frames, std::span<const Compressed> light, size_t now, int x, int y,
              std::vector<Shares>& ages) {
    const Limits limits = limitsAround(light[now].settled, x, y);
    vec2 at(static_cast<float>(x) + 0.5F, static_cast<float>(y) + 0.5F);
    for (size_t k = 1; k <= std::min(now, ages.size()); ++k) {
        if (!followMotion(frames[now - k + 1].motion, at)) {
            return;
        }
        const vec3 former = limits.excess(bilinear(light[now - k].settled, at));
        if (largest(former) < least) {
            continue;
        }
        Shares& age = ages[k - 1];
        age.product += glm::dot(limits.excess(texel(light[now].picture, x, y)), former);
        age.square += glm::dot(former, former);
        ++age.pixels;
        return;
    }
}

std::vector<Compressed> compressedFrames(std::span<const MotionFrame> frames) {
    std::vector<Compressed> light;
    light.reserve(frames.size());
    for (const MotionFrame& frame : frames) {
        REFLET_CHECK(frame.picture.data.size() == frame.settled.data.size() && frame.picture.channels.size() == 3 &&
                         frame.motion.width == frame.picture.width && frame.motion.height == frame.picture.height,
                     "images of {}x{}, {}x{} and {}x{}", frame.picture.width, frame.picture.height, frame.settled.width,
                     frame.settled.height, frame.motion.width, frame.motion.height);
        light.push_back({compressed(frame.picture), compressed(frame.settled)});
    }
    return light;
}

}  // namespace

FloatImage compressed(const FloatImage& radiance) {
    FloatImage image = radiance;
    for (float& value : image.data) {
        const float light = std::clamp(value, 0.0F, 65504.0F);
        value = light / (1.0F + light);
    }
    return image;
}

Ghosts ghostsOf(std::span<const MotionFrame> frames, uint32_t oldest) {
    const std::vector<Compressed> light = compressedFrames(frames);
    std::vector<Shares> ages(oldest);
    for (size_t now = 1; now < frames.size(); ++now) {
        for (uint32_t y = 0; y < frames[now].picture.height; ++y) {
            for (uint32_t x = 0; x < frames[now].picture.width; ++x) {
                addPixel(frames, light, now, static_cast<int>(x), static_cast<int>(y), ages);
            }
        }
    }
    Ghosts ghosts;
    for (const Shares& age : ages) {
        ghosts.left.push_back(age.pixels >= fewestGhostPixels ? age.product / age.square : none);
        ghosts.pixels.push_back(age.pixels);
    }
    return ghosts;
}

double stepLeft(const FloatImage& picture, const FloatImage& before, const FloatImage& after) {
    REFLET_CHECK(picture.data.size() == before.data.size() && before.data.size() == after.data.size() &&
                     picture.channels.size() == 3,
                 "images of {}x{}, {}x{} and {}x{}", picture.width, picture.height, before.width, before.height,
                 after.width, after.height);
    const FloatImage lights[] = {compressed(picture), compressed(before), compressed(after)};
    const std::vector<float>& was = lights[1].data;
    const double mean = std::accumulate(was.begin(), was.end(), 0.0) / static_cast<double>(was.size());
    Shares shares;
    for (size_t i = 0; i < was.size(); i += 3) {
        const auto at = [&](int image) {
            const std::vector<float>& data = lights[image].data;
            return vec3(data[i], data[i + 1], data[i + 2]);
        };
        const vec3 step = at(1) - at(2);
        if (largest(step) >= leastStep * mean) {
            shares.product += glm::dot(at(0) - at(2), step);
            shares.square += glm::dot(step, step);
            ++shares.pixels;
        }
    }
    return shares.pixels >= fewestGhostPixels && shares.square > 0.0 ? shares.product / shares.square : none;
}

std::optional<uint32_t> framesUntil(std::span<const double> values, double limit) {
    size_t first = values.size();
    while (first > 0 && values[first - 1] <= limit) {
        --first;
    }
    return first < values.size() ? std::optional(static_cast<uint32_t>(first)) : std::nullopt;
}

Flicker flickerOf(std::span<const MotionFrame> frames) {
    const std::vector<Compressed> light = compressedFrames(frames);
    Flicker flicker;
    for (size_t i = 1; i < frames.size(); ++i) {
        const auto turns = static_cast<double>(frames.size() - 1);
        flicker.frames += changeBeyondMotion(light[i].picture, light[i - 1].picture, frames[i].motion) / turns;
        flicker.settled += changeBeyondMotion(light[i].settled, light[i - 1].settled, frames[i].motion) / turns;
    }
    return flicker;
}

}  // namespace reflet
