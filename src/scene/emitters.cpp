// Finds emitters.
#include "scene/emitters.h"

#include "base/color.h"
#include "scene/emissive_surface.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <span>

namespace reflet {

namespace {

// Larger sources fill at least this share of a cosine-weighted hemisphere at the middle of what they light, and rays
// find them well. Measured on cornell and on rooms lit by balls and panels.
constexpr float largestShare = 0.02F;
// An emitter is cut, or merged with others, until its radius is this share of its distance to what it lights.
constexpr float finestShare = 0.1F;
// The noise of one ray, relative to the light of other sources, below which an emitter is left to rays.
constexpr float leastNoise = 0.1F;
// Triangles around an emitter that are looked at.
constexpr size_t mostAround = 20000;

/// Emissive surfaces that may become one emitter or several.
struct Group {
    uint32_t instance = 0;  ///< that all of them move with
    std::vector<EmissiveSum> parts;
    EmissiveSum sum;
    float finest = 0.0F;  ///< parts closer together need not be told apart [m]

    [[nodiscard]] bool canSplit() const { return parts.size() > 1 && sum.reach > finest; }
};

/// All groups of a material.
struct Candidate {
    uint32_t material = 0;
    std::vector<Group> groups;
    float noise = 0.0F;
};

bool mayBeEmitter(const Material& m) {
    return m.emissive != vec3(0.0F) && !m.unlit && m.camera.empty() && !m.blended && m.alphaCutoff <= 0.0F &&
           m.transmission.factor <= 0.0F && m.clearcoat.factor <= 0.0F;
}

std::vector<bool> eligible(const Scene& scene) {
    std::vector<bool> materials;
    std::ranges::transform(scene.materials, std::back_inserter(materials), mayBeEmitter);
    for (const auto& [index, material] : scenePose(scene, 0.0).properties.materials) {
        materials[index] = false;
    }
    const std::vector<bool> appears = nodesThatAppear(scene);
    for (const Instance& instance : scene.instances) {
        const bool hides = instance.node >= 0 && !appears.empty() && appears[static_cast<size_t>(instance.node)];
        if (hides || isDeformed(instance)) {
            materials[scene.meshes[instance.mesh].material] = false;
        }
    }
    return materials;
}

// Luminance of the irradiance at a point from all that is not an emitter.
float otherLight(const Scene& scene, const vec3& at, float nearest) {
    float sum = scene.sun ? luminance(scene.sun->irradiance) : 0.0F;
    sum += scene.environment.image ? pi * scene.environment.intensity : pi * luminance(scene.environment.radiance);
    for (const Lamp& lamp : scene.lamps) {
        const vec3 way = lamp.position - at;
        const bool far = lamp.type == Lamp::Type::directional;
        const float square = far ? 1.0F : std::max(glm::dot(way, way), nearest * nearest);
        const bool reaches = far || lamp.range <= 0.0F || square < lamp.range * lamp.range;
        sum += reaches ? luminance(lamp.intensity) / square : 0.0F;
    }
    return sum;
}

class Finder {
public:
    explicit Finder(const Scene& scene)
        : scene_(scene), pose_(scenePose(scene, 0.0)), triangles_(sceneTriangles(scene, pose_)) {
        first_.assign(scene.instances.size() + 1, triangles_.size());
        for (size_t i = triangles_.size(); i-- > 0;) {
            first_[triangles_[i].instance] = i;
        }
        for (size_t i = scene.instances.size(); i-- > 0;) {
            first_[i] = std::min(first_[i], first_[i + 1]);
        }
        around_ = sampled(triangles_, mostAround);
    }

    /// None if rays find the light of the material well.
    [[nodiscard]] std::optional<Candidate> candidate(uint32_t material) const {
        Candidate found{.material = material, .groups = {}};
        Group still;  // of instances that never move
        for (uint32_t i = 0; i < scene_.instances.size(); ++i) {
            if (scene_.meshes[scene_.instances[i].mesh].material != material) {
                continue;
            }
            Group group;
            if (!addInstance(i, group, found.noise)) {
                return std::nullopt;
            }
            if (group.parts.empty()) {
                continue;
            }
            if (isAnimated(pose_, scene_.instances[i])) {
                found.groups.push_back(std::move(group));
            } else {
                still.instance = i;
                still.finest = still.parts.empty() ? group.finest : std::min(still.finest, group.finest);
                still.parts.insert(still.parts.end(), group.parts.begin(), group.parts.end());
            }
        }
        if (!still.parts.empty()) {
            found.groups.push_back(std::move(still));
        }
        for (Group& group : found.groups) {
            group.sum = sumOf(group.parts);
        }
        return found.groups.empty() ? std::nullopt : std::optional(std::move(found));
    }

private:
    // False if rays find its light well.
    bool addInstance(uint32_t instance, Group& group, float& noise) const {
        const std::span<const SceneTriangle> own(&triangles_[first_[instance]],
                                                 first_[instance + 1] - first_[instance]);
        const std::vector<EmissiveSum> coarse = emissivePieces(scene_, own, std::numeric_limits<float>::max());
        if (coarse.empty()) {
            return true;
        }
        const EmissiveSum sum = sumOf(coarse);
        const vec3 centre = sum.centre();
        const float away = litDistance(around_, centre, instance);
        const float share = sum.meanProjectedArea() / (pi * away * away);
        if (!(share < largestShare)) {
            return away <= 0.0F;
        }
        const float bright = pi * sum.weight / sum.area * std::sqrt(share);
        const float relative = bright / std::max(otherLight(scene_, centre, 0.5F * away), 1e-20F);
        if (relative < leastNoise) {
            return false;
        }
        noise = std::max(noise, relative);
        group.instance = instance;
        group.finest = finestShare * away;
        group.parts = sum.reach > group.finest ? emissivePieces(scene_, own, 0.5F * group.finest) : std::vector{sum};
        return true;
    }

    const Scene& scene_;
    ScenePose pose_;
    std::vector<SceneTriangle> triangles_;
    std::vector<size_t> first_;  // triangle of each instance
    std::vector<Sampled> around_;
};

// In the middle along the longest side of the box of its parts.
std::pair<Group, Group> split(Group group) {
    Aabb box;
    for (const EmissiveSum& part : group.parts) {
        box.add(part.centre());
    }
    const vec3 size = box.size();
    const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
    // Not of std::ranges: Clang 14 does not compile libstdc++'s.
    const auto middle = std::partition(group.parts.begin(), group.parts.end(), [&](const EmissiveSum& part) {
        return part.centre()[axis] < box.center()[axis];
    });
    Group other{.instance = group.instance, .parts = {middle, group.parts.end()}, .finest = group.finest};
    group.parts.erase(middle, group.parts.end());
    if (group.parts.empty() || other.parts.empty()) {  // all in one place
        Group& all = group.parts.empty() ? other : group;
        all.sum = sumOf(all.parts);
        all.finest = std::numeric_limits<float>::max();
        return {all, {}};
    }
    group.sum = sumOf(group.parts);
    other.sum = sumOf(other.parts);
    return {std::move(group), std::move(other)};
}

// The groups that blur most of the light are split until there are enough.
void refine(std::vector<Group>& groups, uint32_t most) {
    const auto blur = [](const Group& g) { return g.canSplit() ? g.sum.weight * g.sum.reach / g.finest : 0.0F; };
    while (groups.size() < most) {
        const auto worst = std::ranges::max_element(groups, {}, blur);
        if (!worst->canSplit()) {
            return;
        }
        auto [a, b] = split(std::move(*worst));
        *worst = std::move(a);
        if (!b.parts.empty()) {
            groups.push_back(std::move(b));
        }
    }
}

Emitter emitterOf(const Group& group) {
    const EmissiveSum& sum = group.sum;
    const float mean = sum.weight / sum.area;  // luminance
    const mat3 spread = sum.spread / mean;
    // The mean of |S w| is that of half of the sum of area · |n · w|. Over directions of a spiral.
    constexpr int directions = 256;
    float length = 0.0F;
    for (int i = 0; i < directions; ++i) {
        const float z = 1.0F - (2.0F * static_cast<float>(i) + 1.0F) / static_cast<float>(directions);
        const float around = 2.3999632F * static_cast<float>(i);
        const float across = std::sqrt(1.0F - z * z);
        length += glm::length(spread * vec3(across * std::cos(around), across * std::sin(around), z));
    }
    Emitter emitter;
    emitter.instance = group.instance;
    emitter.position = sum.centre();
    emitter.radiance = sum.power / sum.area;
    emitter.facing = 0.5F * sum.normals / mean;
    emitter.shape = spread * (sum.meanProjectedArea() * static_cast<float>(directions) / length);
    emitter.covariance = sum.covariance();
    emitter.radius = sum.reach;
    // None for a sphere; for a disk the square of its radius, which is exact on its axis.
    emitter.softening = 4.0F * std::max(sum.variance() - sum.meanProjectedArea() / pi, 0.0F);
    return emitter;
}

}  // namespace

SceneEmitters findEmitters(const Scene& scene, uint32_t most) {
    SceneEmitters found;
    found.materials.resize(scene.materials.size());
    const std::vector<bool> materials = eligible(scene);
    if (std::ranges::find(materials, true) == materials.end()) {
        return found;
    }
    const Finder finder(scene);
    std::vector<Candidate> candidates;
    for (uint32_t i = 0; i < materials.size(); ++i) {
        if (std::optional<Candidate> candidate = materials[i] ? finder.candidate(i) : std::nullopt) {
            candidates.push_back(std::move(*candidate));
        }
    }
    std::ranges::stable_sort(candidates, std::greater<>(), &Candidate::noise);
    std::vector<Group> groups;
    for (Candidate& candidate : candidates) {
        if (groups.size() + candidate.groups.size() <= most) {
            found.materials[candidate.material] = true;
            std::ranges::move(candidate.groups, std::back_inserter(groups));
        }
    }
    if (!groups.empty()) {
        refine(groups, most);
    }
    std::ranges::transform(groups, std::back_inserter(found.all), emitterOf);
    return found;
}

}  // namespace reflet
