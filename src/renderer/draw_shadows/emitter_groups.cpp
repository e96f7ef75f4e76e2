// Groups emitters by k-means, which starts from emitters far from one another.
#include "renderer/draw_shadows/emitter_groups.h"

#include "base/color.h"

#include <algorithm>
#include <limits>

namespace reflet {

namespace {

float squaredDistance(const vec3& a, const vec3& b) {
    return glm::dot(a - b, a - b);
}

size_t nearest(const std::vector<vec3>& centres, const vec3& p) {
    const auto found =
        std::ranges::min_element(centres, {}, [&](const vec3& centre) { return squaredDistance(centre, p); });
    return static_cast<size_t>(found - centres.begin());
}

std::vector<vec3> farApart(const LampBlock& block, const std::vector<uint32_t>& emitters, size_t count) {
    const auto strength = [&](uint32_t i) { return luminance(block.lamps[i].intensity); };
    std::vector<vec3> centres{block.lamps[*std::ranges::max_element(emitters, {}, strength)].position};
    while (centres.size() < count) {
        const auto away = [&](uint32_t i) {
            const vec3& p = block.lamps[i].position;
            return squaredDistance(centres[nearest(centres, p)], p);
        };
        centres.push_back(block.lamps[*std::ranges::max_element(emitters, {}, away)].position);
    }
    return centres;
}

std::vector<EmitterGroup> groupsAround(const LampBlock& block, const std::vector<uint32_t>& emitters,
                                       const std::vector<vec3>& centres) {
    std::vector<EmitterGroup> groups(centres.size());
    for (const uint32_t i : emitters) {
        groups[nearest(centres, block.lamps[i].position)].lamps.push_back(i);
    }
    std::erase_if(groups, [](const EmitterGroup& g) { return g.lamps.empty(); });
    for (EmitterGroup& group : groups) {
        LampParams& all = group.seenFrom;
        all.type = lampEmitter;
        float sum = 0.0F;
        for (const uint32_t i : group.lamps) {
            const LampParams& lamp = block.lamps[i];
            const float weight = std::max(luminance(lamp.intensity), std::numeric_limits<float>::min());
            all.position += weight * lamp.position;
            all.radius += weight * lamp.radius;
            all.intensity += lamp.intensity;
            sum += weight;
        }
        all.position /= sum;
        all.radius /= sum;
    }
    return groups;
}

}  // namespace

std::vector<EmitterGroup> groupEmitters(const LampBlock& block, uint32_t most) {
    std::vector<uint32_t> emitters;
    for (uint32_t i = 0; i < block.count; ++i) {
        if (block.lamps[i].type == lampEmitter) {
            emitters.push_back(i);
        }
    }
    if (emitters.empty() || most == 0) {
        return {};
    }
    std::vector<EmitterGroup> groups =
        groupsAround(block, emitters, farApart(block, emitters, std::min<size_t>(most, emitters.size())));
    constexpr int rounds = 8;
    for (int round = 0; round < rounds && groups.size() < emitters.size(); ++round) {
        std::vector<vec3> centres;
        std::ranges::transform(groups, std::back_inserter(centres),
                               [](const EmitterGroup& g) { return g.seenFrom.position; });
        groups = groupsAround(block, emitters, centres);
    }
    return groups;
}

}  // namespace reflet
