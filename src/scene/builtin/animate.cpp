#include "scene/builtin/animate.h"

#include <cmath>
#include <utility>

namespace reflet::builtin {

int32_t addNode(Scene& scene, const glm::dvec3& translation, int32_t parent) {
    Node node;
    node.parent = parent;
    node.translation = translation;
    scene.nodes.push_back(node);
    return static_cast<int32_t>(scene.nodes.size() - 1);
}

void animate(Scene& scene, int32_t node, Channel channel) {
    channel.node = static_cast<uint32_t>(node);
    if (scene.animations.empty()) {
        scene.animations.push_back({.name = "all", .channels = {}});
    }
    scene.animations.front().channels.push_back(std::move(channel));
}

vec4 rotation(double degrees, const glm::dvec3& axis) {
    const double half = 0.5 * glm::radians(degrees);
    return {vec3(std::sin(half) * axis), static_cast<float>(std::cos(half))};
}

int32_t addSlidingNode(Scene& scene, const vec3& from, const vec3& to, float seconds) {
    const int32_t node = addNode(scene, from);
    animate(scene, node,
            {.target = Channel::Target::translation,
             .interpolation = Interpolation::linear,
             .times = {0.0F, seconds},
             .values = {vec4(from, 0), vec4(to, 0)}});
    return node;
}

int32_t addTurningNode(Scene& scene, const vec3& origin, const vec3& axis, float degrees, float seconds) {
    const int32_t node = addNode(scene, origin);
    Channel channel{.target = Channel::Target::rotation, .times = {}, .values = {}};
    const int keys = std::max(1, static_cast<int>(std::ceil(std::abs(degrees) / 90.0F)));
    for (int i = 0; i <= keys; ++i) {
        const float share = static_cast<float>(i) / static_cast<float>(keys);
        channel.times.push_back(share * seconds);
        channel.values.push_back(rotation(share * degrees, glm::normalize(axis)));
    }
    animate(scene, node, std::move(channel));
    return node;
}

}  // namespace reflet::builtin
