// Places the lamps of emitters.
#include "renderer/emitter_lamps.h"

#include <glm/gtc/packing.hpp>

#include <algorithm>
#include <bit>
#include <cmath>

namespace reflet {

namespace {

// Each is evaluated for every pixel.
constexpr uint32_t mostEmitters = 64;

float packHalfs(float low, float high) {
    return std::bit_cast<float>(glm::packHalf2x16(vec2(low, high)));
}

// moved: since time 0.
LampParams lampOf(const Emitter& emitter, const mat4& moved) {
    const mat3 m(moved);
    const float scale = std::cbrt(std::abs(glm::determinant(m)));
    const mat3 turn = m / std::max(scale, 1e-12F);
    const mat3 shape = turn * emitter.shape * glm::transpose(turn);
    const float area = std::max(shape[0][0] + shape[1][1] + shape[2][2], 1e-20F);  // so that halfs suffice
    const mat3 s = shape / area;
    LampParams lamp{};
    lamp.type = lampEmitter;
    lamp.position = vec3(moved * vec4(emitter.position, 1.0F));
    lamp.intensity = emitter.radiance * (area * scale * scale);
    lamp.toLamp = turn * emitter.facing / area;
    lamp.inverseRange = -emitter.softening * scale * scale;
    lamp.spotScale = packHalfs(s[0][0], s[1][1]);
    lamp.spotOffset = packHalfs(s[2][2], s[1][0]);
    lamp.cosOuter = packHalfs(s[2][0], s[2][1]);
    const mat3 extent =
        turn * emitter.covariance * glm::transpose(turn) / std::max(emitter.radius * emitter.radius, 1e-20F);
    lamp.extent = {packHalfs(extent[0][0], extent[1][1]), packHalfs(extent[2][2], extent[1][0]),
                   packHalfs(extent[2][0], extent[2][1])};
    lamp.radius = emitter.radius * scale;
    lamp.shadow = noLampShadow;
    return lamp;
}

}  // namespace

EmitterLamps::EmitterLamps(const Scene& scene, uint32_t others)
    : emitters_(findEmitters(scene, std::min(mostEmitters, maxLamps - others))) {
    const ScenePose pose = scenePose(scene, 0.0);
    for (const Emitter& emitter : emitters_.all) {
        worldToObject_.push_back(glm::inverse(pose.objectToWorld[emitter.instance]));
        lamps_.push_back(lampOf(emitter, mat4(1.0F)));
    }
}

void EmitterLamps::pose(const ScenePose& now) {
    for (size_t i = 0; i < lamps_.size(); ++i) {
        const Emitter& emitter = emitters_.all[i];
        lamps_[i] = lampOf(emitter, now.objectToWorld[emitter.instance] * worldToObject_[i]);
    }
}

void EmitterLamps::appendTo(LampBlock& block) const {
    std::ranges::copy(lamps_, block.lamps + block.count);
    block.count += static_cast<uint32_t>(lamps_.size());
}

}  // namespace reflet
