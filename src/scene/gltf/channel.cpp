// Reads and checks the keyframes of one channel of a glTF animation.
#include "scene/gltf/channel.h"

#include "scene/gltf/accessor.h"

#include <cmath>

namespace reflet {

namespace {

std::optional<Channel::Target> targetOf(const std::string& path) {
    return path == "translation" ? std::optional(Channel::Target::translation)
           : path == "rotation"  ? std::optional(Channel::Target::rotation)
           : path == "scale"     ? std::optional(Channel::Target::scale)
           : path == "weights"   ? std::optional(Channel::Target::weights)
                                 : std::nullopt;
}

Interpolation interpolationOf(const std::string& name) {
    return name == "STEP"          ? Interpolation::step
           : name == "CUBICSPLINE" ? Interpolation::cubicSpline
                                   : Interpolation::linear;
}

std::vector<float> readTimes(const GltfDocument& document, int input, GltfReport& report) {
    const std::string part = fmt::format("accessors[{}]", input);
    const auto& accessor = document.model.accessors[static_cast<size_t>(input)];
    if (accessor.type != TINYGLTF_TYPE_SCALAR || accessor.componentType != TINYGLTF_COMPONENT_TYPE_FLOAT) {
        report.fail(part, "must hold the keyframes' times as SCALAR floats");
    }
    const AccessorView view = viewAccessor(document, input, report);
    report.charge(part, uint64_t(view.count) * sizeof(float));
    std::vector<float> times;
    times.reserve(view.count);
    for (uint32_t i = 0; i < view.count; ++i) {
        const float time = view.at(i).x;
        if (!(time >= 0.0F) || !std::isfinite(time)) {
            report.fail(part, "time {} is {}, must be finite and not negative", i, time);
        }
        if (!times.empty() && time <= times.back()) {
            report.fail(part, "time {} is not later than the one before it", i);
        }
        times.push_back(time);
    }
    return times;
}

void checkComponents(const AccessorView& view, Channel::Target target, int components, const std::string& part,
                     const GltfReport& report) {
    struct Rule {
        const char* name;
        int components;
    };
    const Rule rule = target == Channel::Target::rotation   ? Rule{"rotation", 4}
                      : target == Channel::Target::property ? Rule{"value of that property", components}
                      : target == Channel::Target::weights  ? Rule{"weight", 1}
                      : target == Channel::Target::scale    ? Rule{"scale", 3}
                                                            : Rule{"translation", 3};
    if (view.components != rule.components) {
        report.fail(part, "has {} components, but a {} has {}", view.components, rule.name, rule.components);
    }
}

void readValues(Channel& channel, const AccessorView& view, const std::string& part, GltfReport& report) {
    const bool weights = channel.target == Channel::Target::weights;
    report.charge(part, uint64_t(view.count) * (weights ? sizeof(float) : sizeof(vec4)));
    for (uint32_t i = 0; i < view.count; ++i) {
        const vec4 value = view.at(i);
        if (!isFinite(value)) {
            report.fail(part, "value {} is not finite", i);
        }
        if (weights) {
            channel.weights.push_back(value.x);
        } else {
            channel.values.push_back(value);
        }
    }
}

// Normalizes rotations, but not the tangents of splines, which may have any length.
void makeUnit(Channel& channel, const std::string& part, const GltfReport& report) {
    const bool spline = channel.interpolation == Interpolation::cubicSpline;
    for (size_t i = spline ? 1 : 0; i < channel.values.size(); i += spline ? 3 : 1) {
        const double length = glm::length(glm::dvec4(channel.values[i]));
        if (!(length > 0.0)) {
            report.fail(part, "value {} is not a rotation: the quaternion's length is 0", i);
        }
        channel.values[i] = vec4(glm::dvec4(channel.values[i]) / length);
    }
}

}  // namespace

std::optional<Channel> readGltfChannel(const GltfDocument& document, const GltfChannelSource& source,
                                       GltfReport& report) {
    const auto target =
        source.components > 0 ? std::optional(Channel::Target::property) : targetOf(source.channel.target_path);
    if (!target) {
        report.warn("path " + source.channel.target_path, source.part + ".target.path",
                    "the channel will be ignored: {} is not supported", source.channel.target_path);
        return std::nullopt;
    }
    const auto& samplers = source.animation.samplers;
    if (source.channel.sampler < 0 || static_cast<size_t>(source.channel.sampler) >= samplers.size()) {
        report.fail(source.part + ".sampler", "is {}, but there are {} samplers", source.channel.sampler,
                    samplers.size());
    }
    const tinygltf::AnimationSampler& sampler = samplers[static_cast<size_t>(source.channel.sampler)];
    if (sampler.input < 0 || sampler.output < 0) {
        return std::nullopt;  // a stand-in
    }
    Channel channel;
    channel.target = *target;
    channel.interpolation = interpolationOf(sampler.interpolation);
    channel.times = readTimes(document, sampler.input, report);
    const std::string part = fmt::format("accessors[{}]", sampler.output);
    const AccessorView view = viewAccessor(document, sampler.output, report);
    checkComponents(view, *target, source.components, part, report);
    const uint64_t each = (channel.interpolation == Interpolation::cubicSpline ? 3 : 1) *
                          (*target == Channel::Target::weights ? source.morphTargets : 1);
    if (view.count != each * channel.times.size()) {
        report.fail(part, "has {} elements for {} keyframes, must have {} for each", view.count, channel.times.size(),
                    each);
    }
    readValues(channel, view, part, report);
    if (*target == Channel::Target::rotation) {
        makeUnit(channel, part, report);
    }
    return channel;
}

}  // namespace reflet
