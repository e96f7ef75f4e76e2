// Finds rooms that no light reaches.
#include "scene/closed_room.h"

#include "scene/pose.h"
#include "scene/ray_caster.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace reflet {

namespace {

constexpr int views = 128;          // rays of the camera
constexpr int rays = 16;            // from each place that it sees
constexpr float leastOpen = 1e-3F;  // share of these that get out

// The i-th of `count` directions, evenly over the sphere (a Fibonacci lattice).
vec3 spread(int i, int count) {
    const float height = 1.0F - (2.0F * static_cast<float>(i) + 1.0F) / static_cast<float>(count);
    const float turn = static_cast<float>(i) * glm::pi<float>() * (3.0F - std::sqrt(5.0F));
    const float radius = std::sqrt(1.0F - height * height);
    return {radius * std::cos(turn), height, radius * std::sin(turn)};
}

bool hasLightInside(const Scene& scene) {
    const auto shines = [](const Material& m) { return m.unlit || m.emissive != vec3(0.0F) || !m.camera.empty(); };
    return !scene.lamps.empty() || std::ranges::any_of(scene.materials, shines);
}

// A little in front of what the camera sees, in directions to all of the scene.
std::vector<vec3> seenPlaces(const RayCaster& caster, const Aabb& bounds, const vec3& eye) {
    const float least = 1e-4F * glm::length(bounds.size());
    std::vector<vec3> places;
    for (int i = 0; i < views; ++i) {
        const float part = (static_cast<float>(i % 4) + 0.5F) / 4.0F;
        const vec3 direction = bounds.center() + 0.5F * part * bounds.size() * spread(i, views) - eye;
        if (const RayCaster::Hit hit = caster.cast(eye, direction, RayCaster::Faces::drawn)) {
            places.push_back(eye + direction * hit.distance + hit.normal * least);
        }
    }
    return places;
}

float openness(const RayCaster& caster, const std::vector<vec3>& places) {
    int open = 0;
    for (const vec3& place : places) {
        for (int i = 0; i < rays; ++i) {
            open += caster.cast(place, spread(i, rays), RayCaster::Faces::blocking) ? 0 : 1;
        }
    }
    return static_cast<float>(open) / static_cast<float>(places.size() * rays);
}

struct Candidate {
    vec3 position{0.0F};
    size_t lights = 0;       ///< places that it sees
    float distance = 0.0F;   ///< mean, of these
    float clearance = 0.0F;  ///< to the nearest surface
};

Candidate tried(const RayCaster& caster, const std::vector<vec3>& places, const vec3& position) {
    Candidate candidate{position};
    float sum = 0.0F;
    for (const vec3& place : places) {
        if (!(caster.cast(position, place - position, RayCaster::Faces::blocking).distance < 1.0F)) {
            ++candidate.lights;
            sum += glm::distance(position, place);
        }
    }
    candidate.clearance = std::numeric_limits<float>::infinity();
    for (int i = 0; i < rays; ++i) {
        candidate.clearance = std::min(candidate.clearance, caster.cast(position, spread(i, rays)).distance);
    }
    candidate.distance = sum / static_cast<float>(std::max<size_t>(candidate.lights, 1));
    return candidate;
}

}  // namespace

std::optional<Lamp> lampForClosedRoom(const Scene& scene, const Camera& camera, float irradiance) {
    if (hasLightInside(scene) || scene.instances.empty()) {
        return std::nullopt;
    }
    const Scene still = scene.nodes.empty() ? Scene{} : frozen(scene, 0.0);
    const Scene& seen = scene.nodes.empty() ? scene : still;
    const RayCaster caster(seen);
    const std::vector<vec3> places = seenPlaces(caster, seen.bounds(), camera.position);
    if (places.empty() || openness(caster, places) > leastOpen) {
        return std::nullopt;
    }
    Aabb box;
    for (const vec3& place : places) {
        box.add(place);
    }
    std::vector<Candidate> candidates;
    size_t most = 0;
    constexpr int steps = 5;  // along each side
    for (int i = 0; i < steps * steps * steps; ++i) {
        const vec3 part(i % steps, i / steps % steps, i / steps / steps);
        candidates.push_back(tried(caster, places, box.min + box.size() * (part + 0.5F) / float(steps)));
        most = std::max(most, candidates.back().lights);
    }
    // Of those that light nearly as much as any, the one that is farthest from what it would burn.
    std::erase_if(candidates, [&](const Candidate& c) { return 10 * c.lights < 8 * most; });
    const Candidate best = *std::ranges::max_element(candidates, {}, &Candidate::clearance);
    Lamp lamp;
    lamp.name = "added";
    lamp.position = best.position;
    lamp.intensity = vec3(irradiance * best.distance * best.distance);
    lamp.radius = 0.02F * glm::length(box.size());
    return lamp;
}

}  // namespace reflet
