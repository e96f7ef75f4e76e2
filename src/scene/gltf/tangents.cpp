// Tangents for normal maps, after: Morten S. Mikkelsen, "Simulation of Wrinkled Surfaces Revisited", 2008.
#include "scene/gltf/normals.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

namespace reflet {

namespace {

constexpr uint8_t noSide = 2;

/// Texture frame of a triangle. side 0: the image is mirrored, w = -1; 1: it is not, w = 1.
struct UvFrame {
    glm::dvec3 tangent{0.0};  ///< direction in which u grows, any length
    uint8_t side = noSide;    ///< noSide: degenerate uvs
};

class TangentMaker {
public:
    TangentMaker(Mesh& mesh, const TextureSlot& slot) : mesh_(mesh), slot_(slot) {}

    void run() {
        weld();
        sumUp();
        split();
        write();
    }

private:
    [[nodiscard]] glm::dvec2 uv(uint32_t v) const {
        const VertexAttributes& vertex = mesh_.attributes[v];
        const vec3 raw(slot_.uvSet == 0 ? vertex.uv0 : vertex.uv1, 1.0F);
        return {glm::dot(glm::dvec3(slot_.uvTransform[0]), glm::dvec3(raw)),
                glm::dot(glm::dvec3(slot_.uvTransform[1]), glm::dvec3(raw))};
    }

    [[nodiscard]] std::array<double, 8> key(uint32_t v) const {
        const vec3& p = mesh_.positions[v];
        const vec3& n = mesh_.attributes[v].normal;
        const glm::dvec2 t = uv(v);
        return {p.x, p.y, p.z, n.x, n.y, n.z, t.x, t.y};
    }

    /// Groups equal vertices, so that triangles without a common index still share a tangent.
    void weld() {
        std::vector<uint32_t> order(mesh_.positions.size());
        std::iota(order.begin(), order.end(), 0U);
        std::vector<std::array<double, 8>> keys(order.size());
        for (const uint32_t v : order) {
            keys[v] = key(v);
        }
        std::sort(order.begin(), order.end(), [&](uint32_t a, uint32_t b) { return keys[a] < keys[b]; });
        group_.resize(order.size());
        for (size_t i = 0; i < order.size(); ++i) {
            const bool alike = i > 0 && keys[order[i]] == keys[order[i - 1]];
            group_[order[i]] = alike ? group_[order[i - 1]] : order[i];
        }
    }

    [[nodiscard]] UvFrame frame(size_t triangle) const {
        const uint32_t* corner = &mesh_.indices[3 * triangle];
        const glm::dvec3 origin(mesh_.positions[corner[0]]);
        const glm::dvec3 edge1 = glm::dvec3(mesh_.positions[corner[1]]) - origin;
        const glm::dvec3 edge2 = glm::dvec3(mesh_.positions[corner[2]]) - origin;
        const glm::dvec2 uv1 = uv(corner[1]) - uv(corner[0]);
        const glm::dvec2 uv2 = uv(corner[2]) - uv(corner[0]);
        const double area = uv1.x * uv2.y - uv2.x * uv1.y;
        const glm::dvec3 tangent = (edge1 * uv2.y - edge2 * uv1.y) * (area < 0.0 ? -1.0 : 1.0);
        const double length = glm::length(tangent);
        if (area == 0.0 || !std::isfinite(area) || length == 0.0 || !std::isfinite(length)) {
            return {};
        }
        // v grows downwards in the image: where u, v and the front are right-handed, up in the image is -cross(n, t).
        return {.tangent = tangent / length, .side = static_cast<uint8_t>(area > 0.0 ? 0 : 1)};
    }

    static glm::dvec3 inPlane(const glm::dvec3& v, const glm::dvec3& normal) {
        const glm::dvec3 projected = v - normal * glm::dot(normal, v);
        const double length = glm::length(projected);
        return length > 0.0 && std::isfinite(length) ? projected / length : glm::dvec3(0.0);
    }

    void sumUp() {
        sums_.assign(mesh_.positions.size(), {glm::dvec3(0.0), glm::dvec3(0.0)});
        frames_.resize(mesh_.indices.size() / 3);
        for (size_t t = 0; t < frames_.size(); ++t) {
            frames_[t] = frame(t);
            for (size_t c = 0; c < 3 && frames_[t].side != noSide; ++c) {
                const uint32_t v = mesh_.indices[3 * t + c];
                const glm::dvec3 normal(mesh_.attributes[v].normal);
                const glm::dvec3 here(mesh_.positions[v]);
                const glm::dvec3 next(mesh_.positions[mesh_.indices[3 * t + (c + 1) % 3]]);
                const glm::dvec3 previous(mesh_.positions[mesh_.indices[3 * t + (c + 2) % 3]]);
                const double cosine = glm::dot(inPlane(next - here, normal), inPlane(previous - here, normal));
                const double angle = std::acos(std::clamp(cosine, -1.0, 1.0));
                sums_[group_[v]].at(frames_[t].side) += angle * inPlane(frames_[t].tangent, normal);
            }
        }
    }

    /// The first side that uses a vertex keeps it, the other one gets a copy. Triangles with degenerate uvs use either.
    void split() {
        side_.assign(mesh_.positions.size(), noSide);
        std::vector<uint32_t> copy(mesh_.positions.size(), 0);
        for (size_t i = 0; i < mesh_.indices.size(); ++i) {
            const uint8_t side = frames_[i / 3].side;
            const uint32_t v = mesh_.indices[i];
            if (side == noSide || side_[v] == side) {
                continue;
            }
            if (side_[v] == noSide) {
                side_[v] = side;
                continue;
            }
            if (copy[v] == 0) {
                copy[v] = static_cast<uint32_t>(mesh_.positions.size());
                mesh_.positions.push_back(mesh_.positions[v]);
                mesh_.attributes.push_back(mesh_.attributes[v]);
                if (!mesh_.skin.empty()) {
                    mesh_.skin.push_back(mesh_.skin[v]);
                }
                if (!mesh_.morph.vertices.empty()) {
                    mesh_.morph.vertices.push_back(mesh_.morph.vertices[v]);
                }
                group_.push_back(group_[v]);
                side_.push_back(side);
            }
            mesh_.indices[i] = copy[v];
        }
    }

    void write() {
        for (size_t v = 0; v < mesh_.attributes.size(); ++v) {
            VertexAttributes& vertex = mesh_.attributes[v];
            const vec3 fallback = perpendicular(vertex.normal);
            const bool known = side_[v] != noSide;
            const glm::dvec3 sum = known ? sums_[group_[v]].at(side_[v]) : glm::dvec3(0.0);
            vertex.tangent = vec4(unitOr(vec3(sum), fallback), side_[v] == 0 ? -1.0F : 1.0F);
        }
    }

    Mesh& mesh_;
    const TextureSlot& slot_;
    std::vector<uint32_t> group_;                  ///< per vertex: the representative of all equal vertices
    std::vector<UvFrame> frames_;                  ///< per triangle
    std::vector<std::array<glm::dvec3, 2>> sums_;  ///< per group and side
    std::vector<uint8_t> side_;                    ///< per vertex
};

}  // namespace

void makeTangents(Mesh& mesh, const TextureSlot& texture) {
    TangentMaker(mesh, texture).run();
}

}  // namespace reflet
