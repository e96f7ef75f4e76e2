// Places probes automatically, by casting a few rays from each against all triangles.
#include "renderer/probe/place_probes.h"

#include "scene/ray_caster.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace reflet {

namespace {

using Hit = RayCaster::Hit;

constexpr float never = std::numeric_limits<float>::infinity();

// The scene's instances: rays, and which of them are things.
struct Bodies {
    const Scene& scene;
    RayCaster rays;
    std::vector<bool> solid;  ///< whoever sees back faces of this instance is inside

    explicit Bodies(const Scene& s) : scene(s), rays(s), solid(s.instances.size(), true) {}

    [[nodiscard]] uint32_t count() const { return static_cast<uint32_t>(solid.size()); }
    [[nodiscard]] bool doubleSided(uint32_t i) const {
        return scene.materials[scene.meshes[scene.instances[i].mesh].material].doubleSided;
    }
    [[nodiscard]] Hit trace(const vec3& from, const vec3& direction) const { return rays.cast(from, direction); }
    /// Whether this is a back face of a thing.
    [[nodiscard]] bool inside(const Hit& hit) const { return hit && hit.back && solid[hit.instance]; }
};

// Direction along axis side / 2, tilted by the tangents `aside`. Never exactly along the axis, to avoid parallel
// surfaces.
vec3 axisRay(int side, const vec2& aside) {
    const int axis = side / 2;
    vec3 direction(0.0F);
    direction[axis] = side % 2 == 0 ? 1.0F : -1.0F;
    direction[(axis + 1) % 3] = aside.x + 1.3e-4F;
    direction[(axis + 2) % 3] = aside.y + 1.7e-4F;
    return direction;
}

constexpr int sides = 6;
constexpr float leastSurrounded = 0.2F;  // below, the sky lights nearly all that is seen, and a probe would hide it
constexpr float clearance = 0.1F;  // smallest distance of surfaces to a probe, relative to the cell's shortest side

using Surroundings = std::array<Hit, sides>;

Surroundings castAxisRays(const Bodies& bodies, const vec3& from) {
    Surroundings around;
    for (int side = 0; side < sides; ++side) {
        around.at(side) = bodies.trace(from, axisRay(side, vec2(0.0F)));
    }
    return around;
}

// By majority of the hits.
bool isInside(const Bodies& bodies, const Surroundings& around) {
    const auto met = std::ranges::count_if(around, [](const Hit& h) { return bool(h); });
    return 2 * std::ranges::count_if(around, [&](const Hit& h) { return bodies.inside(h); }) > met;
}

bool encloses(const Bodies& bodies, uint32_t body, const vec3& p) {
    const Aabb& box = bodies.rays.bounds(body);
    if (glm::any(glm::lessThan(p, box.min)) || glm::any(glm::greaterThan(p, box.max))) {
        return false;
    }
    for (int side = 0; side < sides; ++side) {
        if (!bodies.rays.castAt(body, p, axisRay(side, vec2(0.0F))).back) {
            return false;
        }
    }
    return true;
}

// A closed mesh that is drawn from both sides may be a thing or a room. It is a room if the camera is in it.
void findSolids(Bodies& bodies, const vec3& p, const vec3& eye) {
    for (uint32_t i = 0; i < bodies.count(); ++i) {
        bodies.solid[i] = !bodies.doubleSided(i) || (encloses(bodies, i, p) && !encloses(bodies, i, eye));
    }
}

// Moves a point out of solid bodies through the nearest side; if there is none, it stays.
vec3 leaveBodies(const Bodies& bodies, const vec3& from, float clear) {
    const Surroundings around = castAxisRays(bodies, from);
    if (!isInside(bodies, around)) {
        return from;
    }
    vec3 best = from;
    float shortest = never;
    for (int side = 0; side < sides; ++side) {
        const Hit& hit = around.at(side);
        const vec3 out = from + axisRay(side, vec2(0.0F)) * (hit.distance + clear);
        if (bodies.inside(hit) && hit.distance < shortest && !isInside(bodies, castAxisRays(bodies, out))) {
            best = out;
            shortest = hit.distance;
        }
    }
    return best;
}

// Moves away from surfaces closer than `clear`, or to the middle between two such walls.
vec3 keepClear(const Bodies& bodies, vec3 p, float clear) {
    for (int axis = 0; axis < 3; ++axis) {
        const float ahead = bodies.trace(p, axisRay(2 * axis, vec2(0.0F))).distance;
        const float behind = bodies.trace(p, axisRay(2 * axis + 1, vec2(0.0F))).distance;
        if (ahead < clear || behind < clear) {
            const float room = 0.5F * (ahead + behind);
            p[axis] += std::min(clear, room) > behind ? std::min(clear, room) - behind : ahead - std::min(clear, room);
        }
    }
    return p;
}

// The i-th of `count` directions, evenly over the sphere (a Fibonacci lattice).
vec3 spread(int i, int count) {
    const float height = 1.0F - (2.0F * static_cast<float>(i) + 1.0F) / static_cast<float>(count);
    const float turn = static_cast<float>(i) * glm::pi<float>() * (3.0F - std::sqrt(5.0F));
    const float radius = std::sqrt(1.0F - height * height);
    return {radius * std::cos(turn), height, radius * std::sin(turn)};
}

// Share of the directions in which nothing is.
float openness(const Bodies& bodies, const vec3& p) {
    constexpr int count = 64;
    int open = 0;
    for (int i = 0; i < count; ++i) {
        open += bodies.trace(p, spread(i, count)) ? 0 : 1;
    }
    return static_cast<float>(open) / static_cast<float>(count);
}

// A place that lights others.
struct Lighting {
    vec3 point;  ///< just in front of the surface
    vec3 normal;
    float weight;
};

// What lights the surfaces that the camera sees.
struct Walks {
    std::vector<Lighting> lights;  ///< ends of their rays, and of rays from there
    std::vector<vec3> between;     ///< places in free space: middles of the rays
    float met = 1.0F;              ///< share of the rays that meet a surface, 0 of a single convex object
};

constexpr int views = 256;

vec3 aroundNormal(const vec3& normal, int i, int k) {
    return normal + 0.999F * spread((i * 7 + k * 31) % views, views);  // distributed by the cosine
}

// Cosine-distributed rays from what the camera sees, in all directions, so that the camera's own does not matter.
Walks walkFrom(const Bodies& bodies, const Aabb& bounds, const vec3& eye) {
    constexpr int each = 8;
    constexpr int kept = 2;  // of them, of every other view
    const float least = 1e-4F * glm::length(bounds.size());
    Walks walks;
    int rays = 0;
    int met = 0;
    const auto keep = [&](const vec3& from, const vec3& direction, const Hit& hit, float weight) {
        const vec3 end = from + direction * hit.distance + hit.normal * least;
        walks.lights.push_back({end, hit.normal, weight});
        walks.between.push_back(0.5F * (from + end));
        return end;
    };
    for (int i = 0; i < views; ++i) {
        const vec3 place =
            bounds.center() + 0.5F * bounds.size() * spread(i, views) * (static_cast<float>(i % 4) + 0.5F) / 4.0F;
        const vec3 direction = place - eye;
        const Hit seen = bodies.rays.cast(eye, direction, RayCaster::Faces::drawn);
        if (!seen || !(glm::length(direction) > 0.0F)) {
            continue;
        }
        const vec3 at = eye + direction * seen.distance + seen.normal * least;
        for (int k = 0; k < each; ++k) {
            const vec3 away = aroundNormal(seen.normal, i, k);
            const Hit hit = bodies.trace(at, away);
            rays += 1;
            met += hit ? 1 : 0;
            if (hit && k < kept && i % 2 == 0) {
                const vec3 end = keep(at, away, hit, 1.0F);
                const vec3 further = aroundNormal(hit.normal, i, k + each);
                if (const Hit next = bodies.trace(end, further)) {
                    keep(end, further, next, 0.5F);
                }
            }
        }
    }
    walks.met = rays > 0 ? static_cast<float>(met) / static_cast<float>(rays) : 1.0F;
    return walks;
}

// How well a probe at p shows the place, 0 to 1: near to it and from the front. nearby: a distance that is near [m].
float shown(const Bodies& bodies, const vec3& p, const Lighting& light, float nearby) {
    const vec3 direction = light.point - p;
    const float distance = glm::length(direction);
    const float cosine = -glm::dot(direction, light.normal) / std::max(distance, 1e-20F);
    if (!(cosine > 0.0F) || bodies.trace(p, direction).distance < 1.0F) {
        return 0.0F;
    }
    const float far = distance / nearby;
    return cosine / (cosine + far * far);
}

// The camera sees nothing of the closed space that it is in: that is in a thing, or behind its walls.
bool isHidden(const Bodies& bodies, const vec3& p, const vec3& eye) {
    constexpr float closed = 0.1F;
    constexpr int count = 64;
    if (openness(bodies, p) > closed || openness(bodies, eye) < 0.5F) {
        return false;
    }
    for (int i = 0; i < count; ++i) {
        const vec3 direction = spread(i, count);
        const Hit wall = bodies.trace(p, direction);
        const vec3 place = p + direction * (wall ? 0.98F * wall.distance : 0.0F);
        if (!(bodies.rays.cast(eye, place - eye, RayCaster::Faces::drawn).distance < 1.0F)) {
            return false;
        }
    }
    return true;
}

Aabb boxAround(const Bodies& bodies, const vec3& p, const Aabb& sceneBounds) {
    constexpr std::array<vec2, 5> asides{vec2(0, 0), vec2(0.25F, 0.25F), vec2(-0.25F, 0.25F), vec2(0.25F, -0.25F),
                                         vec2(-0.25F, -0.25F)};
    Aabb box;
    for (int side = 0; side < sides; ++side) {
        std::array<float, asides.size()> reach{};  // distances along the axis, as a ray's component there is 1
        std::ranges::transform(asides, reach.begin(),
                               [&](const vec2& aside) { return bodies.trace(p, axisRay(side, aside)).distance; });
        std::ranges::nth_element(reach, reach.begin() + reach.size() / 2);
        const float median = reach[reach.size() / 2];
        const int axis = side / 2;
        const float limit = side % 2 == 0 ? sceneBounds.max[axis] : sceneBounds.min[axis];
        const float wall = p[axis] + (side % 2 == 0 ? median : -median);
        (side % 2 == 0 ? box.max : box.min)[axis] = median < never ? wall : limit;
    }
    // Keeps the box from being empty for probes outside of the scene's bounds and for flat scenes.
    const float least = std::min(0.01F, 1e-3F * glm::length(sceneBounds.size()));
    box.min = glm::min(box.min, p - least);
    box.max = glm::max(box.max, p + least);
    return box;
}

// Cells along each axis: split where cells are longest, as long as there are at most `count`.
glm::uvec3 cellsOf(const vec3& size, uint32_t count) {
    glm::uvec3 cells(1);
    for (;;) {
        const vec3 cell = size / vec3(cells);
        const int longest = cell.x >= cell.y ? (cell.x >= cell.z ? 0 : 2) : (cell.y >= cell.z ? 1 : 2);
        ++cells[longest];
        if (cells.x * cells.y * cells.z > count) {
            --cells[longest];
            return cells;
        }
    }
}

// Probes' places among the sites: each the one that shows most of what lights the scene and is not shown yet (greedy
// maximum coverage). Earlier sites win where others are hardly better.
std::vector<vec3> chooseSites(const Bodies& bodies, const std::vector<vec3>& sites, const Walks& walks, uint32_t count,
                              float nearby) {
    constexpr float hardlyBetter = 1.05F;
    constexpr float worthwhile = 0.005F;  // least share of all light that a further probe shows better
    const size_t lights = walks.lights.size();
    std::vector<float> shows(sites.size() * lights);
    float all = 0.0F;
    for (size_t i = 0; i < lights; ++i) {
        all += walks.lights[i].weight;
        for (size_t site = 0; site < sites.size(); ++site) {
            shows[site * lights + i] = shown(bodies, sites[site], walks.lights[i], nearby);
        }
    }
    std::vector<vec3> chosen;
    std::vector<float> best(lights, 0.0F);
    while (chosen.size() < count) {
        float most = 0.0F;
        size_t next = sites.size();
        for (size_t site = 0; site < sites.size(); ++site) {
            float gain = 0.0F;
            for (size_t i = 0; i < lights; ++i) {
                gain += walks.lights[i].weight * std::max(shows[site * lights + i] - best[i], 0.0F);
            }
            if (gain > hardlyBetter * most) {
                most = gain;
                next = site;
            }
        }
        if (next == sites.size() || most < worthwhile * all) {
            return chosen;
        }
        for (size_t i = 0; i < lights; ++i) {
            best[i] = std::max(best[i], shows[next * lights + i]);
        }
        chosen.push_back(sites[next]);
    }
    return chosen;
}

// Places to choose from: middles of cells, coarse ones first, and of the walks' rays.
std::vector<vec3> findSites(Bodies& bodies, const Aabb& bounds, const Walks& walks, const vec3& eye) {
    constexpr uint32_t mostCells = 16;
    constexpr size_t mostBetween = 32;
    std::vector<vec3> sites;
    float clear = 0.0F;  // of the finest cells, in the end
    const auto add = [&](const vec3& middle) {
        const vec3 p = keepClear(bodies, leaveBodies(bodies, middle, clear), clear);
        if (!isInside(bodies, castAxisRays(bodies, p)) && !isHidden(bodies, p, eye)) {
            sites.push_back(p);
        }
    };
    for (uint32_t split = 1; split <= mostCells; split *= 2) {
        const glm::uvec3 cells = cellsOf(bounds.size(), split);
        const vec3 cell = bounds.size() / vec3(cells);
        clear = clearance * std::min({cell.x, cell.y, cell.z});
        for (uint32_t i = 0; i < cells.x * cells.y * cells.z; ++i) {
            const glm::uvec3 at(i % cells.x, i / cells.x % cells.y, i / cells.x / cells.y);
            const vec3 middle = bounds.min + (vec3(at) + 0.5F) * cell;
            findSolids(bodies, middle, eye);
            add(middle);
        }
    }
    const size_t step = std::max<size_t>(1, walks.between.size() / mostBetween);
    for (size_t i = 0; i < walks.between.size(); i += step) {
        findSolids(bodies, walks.between[i], eye);
        add(walks.between[i]);
    }
    return sites;
}

}  // namespace

std::vector<Probe> placeProbes(const Scene& scene, uint32_t count, const vec3& eye) {
    constexpr float nearPart = 0.25F;
    const Aabb bounds = scene.bounds();
    std::vector<Probe> probes;
    if (bounds.empty() || count == 0) {
        return probes;
    }
    Bodies bodies(scene);
    const Walks walks = walkFrom(bodies, bounds, eye);
    if (walks.met < leastSurrounded) {
        return probes;
    }
    const std::vector<vec3> sites = findSites(bodies, bounds, walks, eye);
    const float nearby = nearPart * glm::length(bounds.size());
    for (const vec3& p : chooseSites(bodies, sites, walks, std::min(count, View::maxProbes), nearby)) {
        probes.push_back({p, boxAround(bodies, p, bounds)});
    }
    return probes;
}

}  // namespace reflet
