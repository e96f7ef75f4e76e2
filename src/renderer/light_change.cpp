// Compares the lights of two frames.
#include "renderer/light_change.h"

#include <algorithm>
#include <cmath>

namespace reflet {

namespace {

constexpr float farMetres = 1.0F;
const float farTurn = glm::radians(10.0F);
// An environment has no intensity to compare with that of lamps.
constexpr float ofEnvironment = 0.5F;
constexpr float squaredSunDistance = 25.0F;
// Light at hits is the last frame's, so what has changed goes on changing for some bounces.
constexpr float echoed = 0.7F;
constexpr float shareThatCounts = 0.01F;

float sumOf(const vec3& v) {
    return v.x + v.y + v.z;
}

}  // namespace

float LightChange::update(const LampBlock& lamps, const View& view) {
    Lights now{{{squaredSunDistance * view.sun.irradiance, vec3(0.0F), -view.sun.direction}}, view.environment};
    for (uint32_t i = 0; i < lamps.count; ++i) {
        const LampParams& lamp = lamps.lamps[i];
        const bool sun = lamp.type == lampDirectional || lamp.type == lampReflected;
        now.all.push_back({(sun ? squaredSunDistance : 1.0F) * lamp.intensity, lamp.position, lamp.toLamp});
    }
    float changed = 0.0F;
    float total = 0.0F;
    for (size_t i = 0; last_ && i < std::max(now.all.size(), last_->all.size()); ++i) {
        const Light none{};
        const Light& a = i < last_->all.size() ? last_->all[i] : none;
        const Light& b = i < now.all.size() ? now.all[i] : none;
        const float most = sumOf(glm::max(a.intensity, b.intensity));
        const float turn = std::acos(std::clamp(glm::dot(a.toLight, b.toLight), -1.0F, 1.0F));
        const bool turns = glm::dot(a.toLight, a.toLight) > 0.5F && glm::dot(b.toLight, b.toLight) > 0.5F;
        const float moved = glm::length(a.position - b.position) / farMetres + (turns ? turn / farTurn : 0.0F);
        const float same = sumOf(glm::min(a.intensity, b.intensity)) * (1.0F - std::min(moved, 1.0F));
        changed += most - same;
        total += most;
    }
    float share = total > 0.0F ? changed / total : 0.0F;
    if (last_ && !(last_->environment == now.environment)) {
        share = std::max(share, ofEnvironment);
    }
    last_ = std::move(now);
    echo_ = std::max(share, echoed * echo_);
    echo_ = echo_ > shareThatCounts ? echo_ : 0.0F;
    return echo_;
}

}  // namespace reflet
