// Surfaces of revolution about the y axis: spheres, cylinders, outlines.
#include "base/error.h"
#include "scene/builtin/shapes.h"

#include <array>
#include <cmath>
#include <numeric>
#include <utility>
#include <vector>

namespace reflet::builtin {
namespace {

struct Ring {
    vec2 point;   ///< radius, height
    vec2 normal;  ///< likewise
    float v;
    float uvRepeat;
};

void addRing(Mesh& mesh, unsigned segments, const Ring& ring) {
    // On the axis a vertex gets the u of its triangle's middle, or its tangent would lean to one side.
    const float shift = ring.point.x > 0.0F ? 0.0F : 0.5F;
    for (unsigned x = 0; x <= segments; ++x) {
        const float u = (static_cast<float>(x) + shift) / static_cast<float>(segments);
        const float phi = glm::two_pi<float>() * (u == 1.0F ? 0.0F : u);  // the seam closes exactly
        const vec3 away(std::sin(phi), 0.0F, std::cos(phi));
        addVertex(mesh, ring.point.x * away + vec3(0, ring.point.y, 0),
                  ring.normal.x * away + vec3(0, ring.normal.y, 0), vec2(u, ring.v) * ring.uvRepeat);
    }
}

struct Width {
    bool above;  ///< the upper ring is not a point on the axis
    bool below;
};

/// Triangles between the ring that starts at vertex `first` and the next ring below it.
void addBand(Mesh& mesh, uint32_t first, unsigned segments, const Width& width) {
    for (unsigned x = 0; x < segments; ++x) {
        const uint32_t a = first + x;
        const uint32_t b = a + segments + 1;
        if (width.below) {
            mesh.indices.insert(mesh.indices.end(), {a, b, b + 1});
        }
        if (width.above) {
            mesh.indices.insert(mesh.indices.end(), {a, width.below ? b + 1 : b, a + 1});
        }
    }
}

/// Normals (in radius, height) at both ends of each segment of an outline.
std::vector<std::pair<vec2, vec2>> outlineNormals(std::span<const vec2> outline) {
    const size_t pieces = outline.size() - 1;
    std::vector<vec2> flat(pieces);
    for (size_t i = 0; i < pieces; ++i) {
        const vec2 d = outline[i + 1] - outline[i];
        flat[i] = glm::normalize(vec2(d.y, -d.x));
    }
    const float smoothest = std::cos(glm::radians(35.0F));
    const auto blend = [&](const vec2& own, const vec2& other) {
        return glm::dot(own, other) > smoothest ? glm::normalize(own + other) : own;
    };
    std::vector<std::pair<vec2, vec2>> normals(pieces);
    for (size_t i = 0; i < pieces; ++i) {
        normals[i].first = i > 0 ? blend(flat[i], flat[i - 1]) : flat[i];
        normals[i].second = i + 1 < pieces ? blend(flat[i], flat[i + 1]) : flat[i];
    }
    return normals;
}

}  // namespace

Mesh sphere(float radius, unsigned segments) {
    REFLET_CHECK(segments >= 6, "{} segments", segments);
    Mesh mesh;
    const unsigned rings = segments / 2;
    for (unsigned y = 0; y <= rings; ++y) {
        const float v = static_cast<float>(y) / static_cast<float>(rings);
        const bool pole = y == 0 || y == rings;
        const vec2 n(pole ? 0.0F : std::sin(glm::pi<float>() * v), std::cos(glm::pi<float>() * v));
        addRing(mesh, segments, {radius * n, n, v, 1.0F});
    }
    for (unsigned y = 0; y < rings; ++y) {
        addBand(mesh, y * (segments + 1), segments, {y > 0, y + 1 < rings});
    }
    finish(mesh);
    return mesh;
}

Mesh lathe(std::span<const vec2> outline, unsigned segments, float uvRepeat) {
    REFLET_CHECK(outline.size() >= 2 && segments >= 3, "{} points, {} segments", outline.size(), segments);
    Mesh mesh;
    const auto normals = outlineNormals(outline);
    std::vector<float> lengths;
    for (size_t i = 0; i + 1 < outline.size(); ++i) {
        lengths.push_back(glm::length(outline[i + 1] - outline[i]));
    }
    const float total = std::accumulate(lengths.begin(), lengths.end(), 0.0F);
    float travelled = 0.0F;
    for (size_t i = 0; i + 1 < outline.size(); ++i) {
        const auto first = static_cast<uint32_t>(mesh.positions.size());
        const float below = 1.0F - travelled / total;
        travelled += lengths[i];
        addRing(mesh, segments, {outline[i + 1], normals[i].second, 1.0F - travelled / total, uvRepeat});
        addRing(mesh, segments, {outline[i], normals[i].first, below, uvRepeat});
        addBand(mesh, first, segments, {outline[i + 1].x > 0.0F, outline[i].x > 0.0F});
    }
    finish(mesh);
    return mesh;
}

Mesh cylinder(float radius, float height, unsigned segments) {
    const std::array<vec2, 4> outline{vec2(0, 0), vec2(radius, 0), vec2(radius, height), vec2(0, height)};
    return lathe(outline, segments);
}

}  // namespace reflet::builtin
