// Keyframe interpolation, after: Khronos, glTF 2.0 Specification, 2021, appendix C.
#include "scene/sample_channel.h"

#include <algorithm>
#include <cmath>

namespace reflet {

namespace {

// Cosine beyond which the sine of the angle is too small to divide by, and linear interpolation is as good.
constexpr double nearlyOne = 1.0 - 1e-12;

/// Slerp between unit quaternions along the shorter arc (Shoemake 1985).
glm::dvec4 spherical(const glm::dvec4& from, const glm::dvec4& to, double share) {
    const double cosine = glm::dot(from, to);
    const glm::dvec4 near = cosine < 0.0 ? -to : to;
    if (std::abs(cosine) > nearlyOne) {
        return glm::normalize(glm::mix(from, near, share));
    }
    const double angle = std::acos(std::abs(cosine));
    return (std::sin((1.0 - share) * angle) * from + std::sin(share * angle) * near) / std::sin(angle);
}

struct Between {
    size_t key;    // the previous one
    double share;  // fraction of the way to the next one
    double seconds;
};

Between findKeys(const std::vector<float>& times, double time) {
    const auto next = std::upper_bound(times.begin(), times.end(), time,
                                       [](double t, float key) { return t < static_cast<double>(key); });
    if (next == times.begin()) {
        return {0, 0.0, 0.0};
    }
    const auto key = static_cast<size_t>(next - times.begin()) - 1;
    if (next == times.end()) {
        return {key, 0.0, 0.0};
    }
    const double seconds = double(times[key + 1]) - double(times[key]);
    return {key, (time - double(times[key])) / seconds, seconds};
}

// Cubic Hermite spline; tangents are per second. valueAt(i): element i of the channel's values.
template <class ValueAt>
auto spline(const ValueAt& valueAt, const Between& at) {
    const auto from = valueAt(3 * at.key + 1);
    if (at.share == 0.0) {
        return from;
    }
    const auto leaving = valueAt(3 * at.key + 2);
    const auto arriving = valueAt(3 * at.key + 3);
    const auto to = valueAt(3 * at.key + 4);
    const double t = at.share;
    const double t2 = t * t;
    const double t3 = t2 * t;
    return (2.0 * t3 - 3.0 * t2 + 1.0) * from + at.seconds * (t3 - 2.0 * t2 + t) * leaving +
           (3.0 * t2 - 2.0 * t3) * to + at.seconds * (t3 - t2) * arriving;
}

}  // namespace

glm::dvec4 sampleChannel(const Channel& channel, double time) {
    const bool rotation = channel.target == Channel::Target::rotation;
    const Between at = findKeys(channel.times, time);
    if (channel.interpolation == Interpolation::cubicSpline) {
        const glm::dvec4 value = spline([&](size_t i) { return glm::dvec4(channel.values[i]); }, at);
        const double length = glm::length(value);
        return rotation && length > 0.0 ? value / length : rotation ? glm::dvec4(0, 0, 0, 1) : value;
    }
    const glm::dvec4 from(channel.values[at.key]);
    const glm::dvec4 start = rotation ? glm::normalize(from) : from;
    if (channel.interpolation == Interpolation::step || at.share == 0.0) {
        return start;
    }
    const glm::dvec4 to(channel.values[at.key + 1]);
    return rotation ? spherical(start, glm::normalize(to), at.share) : glm::mix(start, to, at.share);
}

std::vector<float> sampleWeights(const Channel& channel, double time) {
    const bool isSpline = channel.interpolation == Interpolation::cubicSpline;
    const size_t targets = channel.weights.size() / (channel.times.size() * (isSpline ? 3 : 1));
    const Between at = findKeys(channel.times, time);
    std::vector<float> result(targets);
    for (size_t t = 0; t < targets; ++t) {
        const auto valueAt = [&](size_t i) { return double(channel.weights[i * targets + t]); };
        double value = 0.0;
        if (isSpline) {
            value = spline(valueAt, at);
        } else if (channel.interpolation == Interpolation::step || at.share == 0.0) {
            value = valueAt(at.key);
        } else {
            value = glm::mix(valueAt(at.key), valueAt(at.key + 1), at.share);
        }
        result[t] = static_cast<float>(value);
    }
    return result;
}

}  // namespace reflet
