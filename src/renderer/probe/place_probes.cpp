// Places probes automatically, by casting a few rays from each against all triangles.
#include "renderer/probe/place_probes.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace reflet {

namespace {

constexpr float never = std::numeric_limits<float>::infinity();

struct Triangle {
    vec3 corner, edge1, edge2;
};

// Triangles of one instance in world space.
struct Body {
    Aabb bounds;
    bool doubleSided;
    bool solid;  ///< whoever sees back faces is inside
    std::vector<Triangle> triangles;
};

std::vector<Body> bodiesOf(const Scene& scene) {
    std::vector<Body> bodies;
    for (const Instance& instance : scene.instances) {
        const Mesh& mesh = scene.meshes[instance.mesh];
        const bool mirrored = glm::determinant(mat3(instance.objectToWorld)) < 0.0F;
        const bool doubleSided = scene.materials[mesh.material].doubleSided;
        Body body{{}, doubleSided, !doubleSided, {}};
        const auto corner = [&](size_t i) {
            const vec3 p(instance.objectToWorld * vec4(mesh.positions[mesh.indices[i]], 1.0F));
            body.bounds.add(p);
            return p;
        };
        for (size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
            const vec3 a = corner(i);
            const vec3 b = corner(i + (mirrored ? 2 : 1));
            const vec3 c = corner(i + (mirrored ? 1 : 2));
            body.triangles.push_back({a, b - a, c - a});
        }
        bodies.push_back(std::move(body));
    }
    return bodies;
}

struct Hit {
    float distance = never;
    bool inside = false;  ///< back face of a solid body
    bool back = false;    ///< back face
};

bool meets(const Aabb& box, const vec3& from, const vec3& direction) {
    const vec3 a = (box.min - from) / direction;
    const vec3 b = (box.max - from) / direction;
    const vec3 low = glm::min(a, b);
    const vec3 high = glm::max(a, b);
    return std::max({low.x, low.y, low.z, 0.0F}) <= std::min({high.x, high.y, high.z});
}

// Möller and Trumbore, Fast, Minimum Storage Ray/Triangle Intersection, 1997.
void intersect(const Body& body, const vec3& from, const vec3& direction, Hit& nearest) {
    for (const Triangle& t : body.triangles) {
        const vec3 p = glm::cross(direction, t.edge2);
        const float determinant = glm::dot(t.edge1, p);
        if (std::abs(determinant) < 1e-20F) {
            continue;
        }
        const vec3 s = (from - t.corner) / determinant;
        const float u = glm::dot(s, p);
        const vec3 q = glm::cross(s, t.edge1);
        const float v = glm::dot(direction, q);
        const float distance = glm::dot(t.edge2, q);
        if (u >= 0.0F && v >= 0.0F && u + v <= 1.0F && distance > 0.0F && distance < nearest.distance) {
            nearest = {distance, determinant < 0.0F && body.solid, determinant < 0.0F};
        }
    }
}

// direction: no component may be 0; distances are in units of its length.
Hit trace(const std::vector<Body>& bodies, const vec3& from, const vec3& direction) {
    Hit nearest;
    for (const Body& body : bodies) {
        if (meets(body.bounds, from, direction)) {
            intersect(body, from, direction, nearest);
        }
    }
    return nearest;
}

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
constexpr float clearance = 0.1F;  // smallest distance of surfaces to a probe, relative to the cell's shortest side

struct Surroundings {
    std::array<Hit, sides> hits;
    [[nodiscard]] bool inside() const {  // by majority of the hits
        const auto met = std::ranges::count_if(hits, [](const Hit& h) { return h.distance < never; });
        return 2 * std::ranges::count_if(hits, &Hit::inside) > met;
    }
};

Surroundings castAxisRays(const std::vector<Body>& bodies, const vec3& from) {
    Surroundings around;
    for (int side = 0; side < sides; ++side) {
        around.hits.at(side) = trace(bodies, from, axisRay(side, vec2(0.0F)));
    }
    return around;
}

bool encloses(const Body& body, const vec3& p) {
    if (glm::any(glm::lessThan(p, body.bounds.min)) || glm::any(glm::greaterThan(p, body.bounds.max))) {
        return false;
    }
    for (int side = 0; side < sides; ++side) {
        Hit hit;
        intersect(body, p, axisRay(side, vec2(0.0F)), hit);
        if (!hit.back) {
            return false;
        }
    }
    return true;
}

// A closed mesh that is drawn from both sides may be a thing or a room. It is a room if the camera is in it.
void findSolids(std::vector<Body>& bodies, const vec3& p, const vec3& eye) {
    for (Body& body : bodies) {
        body.solid = !body.doubleSided || (encloses(body, p) && !encloses(body, eye));
    }
}

// Moves a point out of solid bodies through the nearest side; if there is none, it stays.
vec3 leaveBodies(const std::vector<Body>& bodies, const vec3& from, float clear) {
    const Surroundings around = castAxisRays(bodies, from);
    if (!around.inside()) {
        return from;
    }
    vec3 best = from;
    float shortest = never;
    for (int side = 0; side < sides; ++side) {
        const Hit& hit = around.hits.at(side);
        const vec3 out = from + axisRay(side, vec2(0.0F)) * (hit.distance + clear);
        if (hit.inside && hit.distance < shortest && !castAxisRays(bodies, out).inside()) {
            best = out;
            shortest = hit.distance;
        }
    }
    return best;
}

// Moves away from surfaces closer than `clear`, or to the middle between two such walls.
vec3 keepClear(const std::vector<Body>& bodies, vec3 p, float clear) {
    for (int axis = 0; axis < 3; ++axis) {
        const float ahead = trace(bodies, p, axisRay(2 * axis, vec2(0.0F))).distance;
        const float behind = trace(bodies, p, axisRay(2 * axis + 1, vec2(0.0F))).distance;
        if (ahead < clear || behind < clear) {
            const float room = 0.5F * (ahead + behind);
            p[axis] += std::min(clear, room) > behind ? std::min(clear, room) - behind : ahead - std::min(clear, room);
        }
    }
    return p;
}

Aabb boxAround(const std::vector<Body>& bodies, const vec3& p, const Aabb& sceneBounds) {
    constexpr std::array<vec2, 5> asides{vec2(0, 0), vec2(0.5F, 0.5F), vec2(-0.5F, 0.5F), vec2(0.5F, -0.5F),
                                         vec2(-0.5F, -0.5F)};
    Aabb box;
    for (int side = 0; side < sides; ++side) {
        std::array<float, asides.size()> reach{};  // distances along the axis, as a ray's component there is 1
        std::ranges::transform(asides, reach.begin(),
                               [&](const vec2& aside) { return trace(bodies, p, axisRay(side, aside)).distance; });
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

}  // namespace

std::vector<Probe> placeProbes(const Scene& scene, uint32_t count, const vec3& eye) {
    std::vector<Body> bodies = bodiesOf(scene);
    const Aabb bounds = scene.bounds();
    std::vector<Probe> probes;
    if (bounds.empty() || count == 0) {
        return probes;
    }
    const glm::uvec3 cells = cellsOf(bounds.size(), std::min(count, View::maxProbes));
    const vec3 cell = bounds.size() / vec3(cells);
    const float clear = clearance * std::min({cell.x, cell.y, cell.z});
    for (uint32_t i = 0; i < cells.x * cells.y * cells.z; ++i) {
        const glm::uvec3 at(i % cells.x, i / cells.x % cells.y, i / cells.x / cells.y);
        const vec3 middle = bounds.min + (vec3(at) + 0.5F) * cell;
        findSolids(bodies, middle, eye);
        const vec3 p = keepClear(bodies, leaveBodies(bodies, middle, clear), clear);
        probes.push_back({p, boxAround(bodies, p, bounds)});
    }
    return probes;
}

}  // namespace reflet
