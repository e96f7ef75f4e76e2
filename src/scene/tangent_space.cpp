// Triangles around a vertex that are connected by edges, and have the image on the same side, share a tangent: the mean
// of theirs in the plane of the normal, weighted by their angles at the vertex. Vertices are the same if position,
// normal and uv are. In floats, because the result is to be that of others.
#include "scene/tangent_space.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cfloat>
#include <cmath>

namespace reflet {

namespace {

constexpr uint32_t none = 0xFFFFFFFF;
constexpr size_t mostCompared = 64;  // triangles of a group, each with each other

bool isNotZero(float x) {
    return std::abs(x) > FLT_MIN;
}

bool isNotZero(const vec3& v) {
    return isNotZero(v.x) || isNotZero(v.y) || isNotZero(v.z);
}

float lengthOf(const vec3& v) {
    return std::sqrt(v.x * v.x + v.y * v.y + v.z * v.z);
}

vec3 unit(const vec3& v) {
    return 1.0F / lengthOf(v) * v;
}

vec3 inPlane(const vec3& v, const vec3& normal) {
    const vec3 projected = v - glm::dot(normal, v) * normal;
    return isNotZero(projected) ? unit(projected) : projected;
}

/// Per vertex the first one that has the same position, normal and uv.
class Weld {
public:
    explicit Weld(const TangentSpaceInput& mesh)
        : mesh_(mesh), slots_(std::bit_ceil(2 * mesh.positions.size() + 1), none) {}

    std::vector<uint32_t> run() {
        std::vector<uint32_t> firsts(mesh_.positions.size());
        for (uint32_t v = 0; v < firsts.size(); ++v) {
            const Key key = keyOf(v);
            size_t slot = hashOf(key) & (slots_.size() - 1);
            while (slots_[slot] != none && keyOf(slots_[slot]) != key) {
                slot = (slot + 1) & (slots_.size() - 1);
            }
            slots_[slot] = slots_[slot] == none ? v : slots_[slot];
            firsts[v] = slots_[slot];
        }
        return firsts;
    }

private:
    using Key = std::array<uint32_t, 8>;

    [[nodiscard]] Key keyOf(uint32_t v) const {
        const vec3& p = mesh_.positions[v];
        const vec3& n = mesh_.normals[v];
        const vec2& t = mesh_.uvs[v];
        Key key{};
        const float values[] = {p.x, p.y, p.z, n.x, n.y, n.z, t.x, t.y};
        std::ranges::transform(values, key.begin(),
                               [](float x) { return std::bit_cast<uint32_t>(x + 0.0F); });  // -0: 0
        return key;
    }

    static size_t hashOf(const Key& key) {
        uint64_t hash = 0x9e3779b97f4a7c15U;
        for (const uint32_t word : key) {
            hash = (hash ^ word) * 0xff51afd7ed558ccdU;
            hash ^= hash >> 32U;
        }
        return hash;
    }

    const TangentSpaceInput& mesh_;
    std::vector<uint32_t> slots_;
};

struct Face {
    vec3 alongU{0.0F};  ///< unit, or 0
    vec3 alongV{0.0F};
    std::array<uint32_t, 3> neighbor{none, none, none};  ///< beyond the edge from corner i to the next
    std::array<uint32_t, 3> group{none, none, none};     ///< of corner i
    bool preserves = false;                              ///< the image is not mirrored
    bool joinsAny = true;                                ///< no uv frame: whichever group comes first
    bool degenerate = false;                             ///< two corners are at the same place
};

class TangentSpaces {
public:
    explicit TangentSpaces(const TangentSpaceInput& mesh) : mesh_(mesh), firsts_(Weld(mesh).run()) {
        corners_.resize(mesh.indices.size() / 3 * 3);
        std::transform(mesh.indices.begin(), mesh.indices.begin() + static_cast<std::ptrdiff_t>(corners_.size()),
                       corners_.begin(), [&](uint32_t v) { return firsts_[v]; });
        faces_.resize(corners_.size() / 3);
    }

    std::vector<vec4> run() {
        std::vector<vec4> result(mesh_.indices.size(), vec4(0.0F));
        for (uint32_t f = 0; f < faces_.size(); ++f) {
            findFrame(f);
        }
        connect();
        for (uint32_t f = 0; f < faces_.size(); ++f) {
            for (uint32_t c = 0; c < 3 && !faces_[f].degenerate && !faces_[f].joinsAny; ++c) {
                if (faces_[f].group[c] == none) {
                    gather(f, c);
                    average(result);
                }
            }
        }
        fillDegenerate(result);
        return result;
    }

private:
    struct Member {
        uint32_t face;
        uint32_t corner;
    };

    [[nodiscard]] const vec3& position(uint32_t face, uint32_t corner) const {
        return mesh_.positions[corners_[3 * face + corner]];
    }

    /// First-order derivatives of the position by u and v.
    void findFrame(uint32_t f) {
        Face& face = faces_[f];
        const vec3 p[] = {position(f, 0), position(f, 1), position(f, 2)};
        face.degenerate = p[0] == p[1] || p[0] == p[2] || p[1] == p[2];
        const vec2& origin = mesh_.uvs[corners_[3 * f]];
        const vec2 uv1 = mesh_.uvs[corners_[3 * f + 1]] - origin;
        const vec2 uv2 = mesh_.uvs[corners_[3 * f + 2]] - origin;
        const vec3 edge1 = p[1] - p[0];
        const vec3 edge2 = p[2] - p[0];
        const float area = uv1.x * uv2.y - uv1.y * uv2.x;
        face.preserves = area > 0.0F;
        if (!isNotZero(area)) {
            return;
        }
        const vec3 alongU = uv2.y * edge1 - uv1.y * edge2;
        const vec3 alongV = -uv2.x * edge1 + uv1.x * edge2;
        const float lengthU = lengthOf(alongU);
        const float lengthV = lengthOf(alongV);
        const float side = face.preserves ? 1.0F : -1.0F;
        face.alongU = isNotZero(lengthU) ? side / lengthU * alongU : vec3(0.0F);
        face.alongV = isNotZero(lengthV) ? side / lengthV * alongV : vec3(0.0F);
        const bool finite = std::isfinite(lengthU) && std::isfinite(lengthV) && std::isfinite(area);
        const float magnitude = std::abs(area);
        face.joinsAny = !finite || !isNotZero(lengthU / magnitude) || !isNotZero(lengthV / magnitude);
    }

    /// Pairs the edges that two triangles run through in opposite directions, in the order of the triangles.
    void connect() {
        struct Edge {
            uint64_t ends;
            uint32_t place;  ///< 3 · face + corner
        };
        std::vector<Edge> edges;
        edges.reserve(corners_.size());
        for (uint32_t i = 0; i < corners_.size(); ++i) {
            const uint32_t from = corners_[i];
            const uint32_t to = corners_[i % 3 == 2 ? i - 2 : i + 1];
            if (!faces_[i / 3].degenerate) {
                edges.push_back({uint64_t(std::min(from, to)) << 32U | std::max(from, to), i});
            }
        }
        std::ranges::sort(
            edges, [](const Edge& a, const Edge& b) { return a.ends != b.ends ? a.ends < b.ends : a.place < b.place; });
        std::vector<uint32_t> open;
        for (size_t first = 0; first < edges.size();) {
            size_t end = first;
            open.clear();
            size_t next = 0;  // of those that wait for the other direction
            for (; end < edges.size() && edges[end].ends == edges[first].ends; ++end) {
                const uint32_t place = edges[end].place;
                const bool pairs = next < open.size() && corners_[open[next]] != corners_[place];
                if (pairs) {
                    faces_[place / 3].neighbor[place % 3] = open[next] / 3;
                    faces_[open[next] / 3].neighbor[open[next] % 3] = place / 3;
                    ++next;
                } else {
                    open.push_back(place);
                }
            }
            first = end;
        }
    }

    [[nodiscard]] uint32_t cornerAt(uint32_t face, uint32_t vertex) const {
        const uint32_t* corner = &corners_[3 * size_t(face)];
        return corner[0] == vertex ? 0 : corner[1] == vertex ? 1 : corner[2] == vertex ? 2 : 3;
    }

    /// The group of the corner: the triangles that are reached over edges at its vertex.
    void gather(uint32_t f, uint32_t c) {
        const uint32_t vertex = corners_[3 * f + c];
        const bool preserves = faces_[f].preserves;
        const uint32_t group = groups_++;
        members_.clear();
        std::vector<uint32_t>& open = open_;
        open.assign(1, f);
        while (!open.empty()) {
            const uint32_t at = open.back();
            open.pop_back();
            Face& face = faces_[at];
            const uint32_t corner = cornerAt(at, vertex);
            if (corner == 3 || face.group[corner] != none) {
                continue;
            }
            const bool isFree = face.group[0] == none && face.group[1] == none && face.group[2] == none;
            face.preserves = face.joinsAny && isFree ? preserves : face.preserves;
            if (face.preserves != preserves) {
                continue;
            }
            face.group[corner] = group;
            members_.push_back({at, corner});
            for (const uint32_t edge : {(corner + 2) % 3, corner}) {  // the latter is the first to be visited
                if (face.neighbor[edge] != none) {
                    open.push_back(face.neighbor[edge]);
                }
            }
        }
        std::ranges::sort(members_, {}, &Member::face);
    }

    /// The directions of a member in the plane of the normal, and what it adds to the mean.
    struct Part {
        vec3 alongU;
        vec3 alongV;
        vec3 weighted{0.0F};
        bool joinsAny;
    };

    [[nodiscard]] Part partOf(const Member& m, const vec3& normal) const {
        const Face& face = faces_[m.face];
        Part part{
            .alongU = inPlane(face.alongU, normal), .alongV = inPlane(face.alongV, normal), .joinsAny = face.joinsAny};
        if (!face.joinsAny) {
            const vec3& here = position(m.face, m.corner);
            const vec3 previous = inPlane(position(m.face, (m.corner + 2) % 3) - here, normal);
            const vec3 next = inPlane(position(m.face, (m.corner + 1) % 3) - here, normal);
            const float cosine = std::clamp(glm::dot(previous, next), -1.0F, 1.0F);
            part.weighted = static_cast<float>(std::acos(double(cosine))) * part.alongU;
        }
        return part;
    }

    /// False of what points the other way.
    [[nodiscard]] bool joins(size_t one, size_t other) const {
        const Part& a = parts_[one];
        const Part& b = parts_[other];
        return one == other || parts_.size() > mostCompared || a.joinsAny || b.joinsAny ||
               (glm::dot(a.alongU, b.alongU) > -1.0F && glm::dot(a.alongV, b.alongV) > -1.0F);
    }

    [[nodiscard]] vec3 meanFor(size_t member) const {
        vec3 sum(0.0F);
        for (size_t i = 0; i < parts_.size(); ++i) {
            sum += joins(member, i) ? parts_[i].weighted : vec3(0.0F);
        }
        return isNotZero(sum) ? unit(sum) : sum;
    }

    void average(std::vector<vec4>& result) {
        const vec3& normal = mesh_.normals[corners_[3 * members_[0].face + members_[0].corner]];
        parts_.clear();
        for (const Member& m : members_) {
            parts_.push_back(partOf(m, normal));
        }
        bool alike = true;
        for (size_t i = 0; i < parts_.size() && parts_.size() <= mostCompared; ++i) {
            for (size_t k = 0; k < i; ++k) {
                alike = alike && joins(i, k);
            }
        }
        vec3 mean = meanFor(0);
        for (size_t i = 0; i < members_.size(); ++i) {
            mean = alike ? mean : meanFor(i);
            const Member& m = members_[i];
            // v grows downwards in the image: where u, v and the front are right-handed, up is -cross(n, t).
            result[3 * size_t(m.face) + m.corner] = vec4(mean, faces_[m.face].preserves ? -1.0F : 1.0F);
        }
    }

    /// A triangle without an area takes what another one has at the same vertex, the first of them.
    void fillDegenerate(std::vector<vec4>& result) const {
        std::vector<uint32_t> known;  // by vertex: a corner with a tangent
        for (uint32_t i = 0; i < corners_.size(); ++i) {
            if (!faces_[i / 3].degenerate) {
                known.resize(mesh_.positions.size(), none);
                known[corners_[i]] = std::min(known[corners_[i]], i);
            }
        }
        for (uint32_t i = 0; i < corners_.size() && !known.empty(); ++i) {
            if (faces_[i / 3].degenerate && known[corners_[i]] != none) {
                result[i] = result[known[corners_[i]]];
            }
        }
    }

    const TangentSpaceInput& mesh_;
    std::vector<uint32_t> firsts_;   ///< per vertex
    std::vector<uint32_t> corners_;  ///< per index: the welded vertex
    std::vector<Face> faces_;
    uint32_t groups_ = 0;
    std::vector<Member> members_;  ///< of the last group
    std::vector<Part> parts_;      ///< of its members
    std::vector<uint32_t> open_;
};

}  // namespace

std::vector<vec4> tangentSpaces(const TangentSpaceInput& mesh) {
    return TangentSpaces(mesh).run();
}

}  // namespace reflet
