// Makes geometry of points and lines.
#include "scene/thin_meshes.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace reflet {

namespace {

/// Corners of an octahedron around a point.
constexpr std::array<vec3, 6> axes{vec3(1, 0, 0),  vec3(-1, 0, 0), vec3(0, 1, 0),
                                   vec3(0, -1, 0), vec3(0, 0, 1),  vec3(0, 0, -1)};
constexpr std::array<uint32_t, 24> octahedron{0, 2, 4, 2, 1, 4, 1, 3, 4, 3, 0, 4, 2, 0, 5, 1, 2, 5, 3, 1, 5, 0, 3, 5};
/// Sides and ends of a prism; corners 0 to 3 are at its start, counter-clockwise as seen from there, 4 to 7 at its end.
constexpr std::array<uint32_t, 36> prism{0, 1, 5, 0, 5, 4, 1, 2, 6, 1, 6, 5, 2, 3, 7, 2, 7, 6,
                                         3, 0, 4, 3, 4, 7, 0, 2, 1, 0, 3, 2, 4, 5, 6, 4, 6, 7};

/// Vertices of the mesh as it was, copied to those of the geometry.
struct Expanded {
    const Mesh& from;
    Mesh to;

    /// A vertex beside one of the source.
    void add(uint32_t source, const vec3& outward) {
        to.positions.push_back(from.positions[source]);
        to.outward.push_back(outward);
        to.attributes.push_back(from.attributes[source]);
        if (!from.skin.empty()) {
            to.skin.push_back(from.skin[source]);
        }
        if (!from.morph.vertices.empty()) {
            to.morph.vertices.push_back(from.morph.vertices[source]);
        }
    }
    void connect(std::span<const uint32_t> corners, size_t vertices) {
        const auto first = static_cast<uint32_t>(to.positions.size() - vertices);
        for (const uint32_t corner : corners) {
            to.indices.push_back(first + corner);
        }
    }
    void addPoint(uint32_t point) {
        for (const vec3& axis : axes) {
            add(point, axis);
        }
        connect(octahedron, axes.size());
    }
    void addLine(uint32_t start, uint32_t end) {
        const vec3 along = from.positions[end] - from.positions[start];
        const float length = glm::length(along);
        if (!(length > 0.0F)) {
            addPoint(start);
            return;
        }
        const vec3 axis = along / length;
        const vec3 side = glm::normalize(glm::cross(axis, std::abs(axis.y) < 0.9F ? vec3(0, 1, 0) : vec3(1, 0, 0)));
        const vec3 up = glm::cross(axis, side);
        for (const uint32_t at : {start, end}) {
            for (const vec3& outward : {side, up, -side, -up}) {
                add(at, outward);
            }
        }
        connect(prism, 8);
    }
};

float widthAt(const vec3& p, const Camera& camera, uint32_t height) {
    const float pixels = static_cast<float>(std::max(height, 1U));
    if (camera.orthographicHeight > 0.0F) {
        return camera.orthographicHeight / pixels;
    }
    const vec3 axis = camera.target - camera.position;
    const float reach = glm::length(axis);
    const float depth = reach > 0.0F ? glm::dot(p - camera.position, axis / reach) : 0.0F;
    return 2.0F * std::tan(0.5F * camera.fovY) * std::max(depth, camera.near) / pixels;
}

void widen(Mesh& mesh, const mat4& toWorld, const Camera& camera, uint32_t height) {
    constexpr float half = 0.6F;  // of a pixel: an octahedron and a prism are narrower than their circles
    mesh.bounds = {};
    for (size_t i = 0; i < mesh.positions.size(); ++i) {
        const float now = mesh.width;
        const vec3 middle = mesh.positions[i] - now * mesh.outward[i];
        const float scale = glm::length(mat3(toWorld) * mesh.outward[i]);
        const float wanted = half * widthAt(vec3(toWorld * vec4(middle, 1.0F)), camera, height);
        mesh.positions[i] = middle + mesh.outward[i] * (scale > 0.0F ? wanted / scale : 0.0F);
        mesh.bounds.add(mesh.positions[i]);
    }
    mesh.width = 0.0F;
}

}  // namespace

void makeThin(Mesh& mesh, std::span<const uint32_t> elements, size_t corners) {
    constexpr float provisional = 1e-3F;  // of the mesh's size
    Expanded made{mesh, {}};
    made.to.name = mesh.name;
    made.to.material = mesh.material;
    made.to.jointWeights = mesh.jointWeights;
    made.to.morph.deltas = mesh.morph.deltas;
    made.to.morph.targets = mesh.morph.targets;
    for (size_t i = 0; i + corners <= elements.size(); i += corners) {
        if (corners == 1) {
            made.addPoint(elements[i]);
        } else {
            made.addLine(elements[i], elements[i + 1]);
        }
    }
    const float size = mesh.bounds.empty() ? 0.0F : glm::length(mesh.bounds.size());
    made.to.width = size > 0.0F ? provisional * size : provisional;
    for (size_t i = 0; i < made.to.positions.size(); ++i) {
        made.to.positions[i] += made.to.width * made.to.outward[i];
        made.to.bounds.add(made.to.positions[i]);
    }
    mesh = std::move(made.to);
}

void widenThinMeshes(Scene& scene, const Camera& camera, uint32_t height) {
    std::vector<bool> taken(scene.meshes.size(), false);
    for (Instance& instance : scene.instances) {
        const uint32_t mesh = instance.mesh;
        if (scene.meshes[mesh].outward.empty()) {
            continue;
        }
        if (taken[mesh]) {
            scene.meshes.push_back(scene.meshes[mesh]);
            instance.mesh = static_cast<uint32_t>(scene.meshes.size() - 1);
        } else {
            taken[mesh] = true;
        }
    }
    for (const Instance& instance : scene.instances) {
        if (!scene.meshes[instance.mesh].outward.empty()) {
            widen(scene.meshes[instance.mesh], instance.objectToWorld, camera, height);
        }
    }
}

}  // namespace reflet
