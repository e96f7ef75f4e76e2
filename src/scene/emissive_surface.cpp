// Cuts emissive surfaces into pieces, and measures what is around a point.
#include "scene/emissive_surface.h"

#include "base/color.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>

namespace reflet {

namespace {

// Of the light; the rest goes farther. A lamp shade may catch most of it.
constexpr float reached = 0.8F;

constexpr float mostPieces = 8192.0F;  // of an instance

float textureCoordinate(float u, Wrap wrap) {
    const float cycle = u - 2.0F * std::floor(0.5F * u);
    switch (wrap) {
        case Wrap::clamp:
            return std::clamp(u, 0.0F, 1.0F);
        case Wrap::mirror:
            return cycle > 1.0F ? 2.0F - cycle : cycle;
        default:
            return u - std::floor(u);
    }
}

// Nearest texel, linear.
vec3 emissiveTexel(const Scene& scene, const TextureSlot& slot, const vec2& uv) {
    const TextureImage& image = scene.images[static_cast<size_t>(slot.image)];
    const Sampler sampler = slot.sampler < 0 ? Sampler{} : scene.samplers[static_cast<size_t>(slot.sampler)];
    const vec3 at(uv, 1.0F);
    const vec2 placed(textureCoordinate(glm::dot(slot.uvTransform[0], at), sampler.wrapU),
                      textureCoordinate(glm::dot(slot.uvTransform[1], at), sampler.wrapV));
    const uint32_t x = std::min(static_cast<uint32_t>(placed.x * static_cast<float>(image.width)), image.width - 1);
    const uint32_t y = std::min(static_cast<uint32_t>(placed.y * static_cast<float>(image.height)), image.height - 1);
    const uint8_t* texel = &image.rgba[(size_t(y) * image.width + x) * 4];
    vec3 linear;
    for (int i = 0; i < 3; ++i) {
        linear[i] = static_cast<float>(decodeSrgb(texel[i] / 255.0));
    }
    return linear;
}

// Cuts one triangle.
class Cutter {
public:
    Cutter(const Scene& scene, const SceneTriangle& t, uint32_t firstIndex, uint32_t cuts)
        : scene_(scene),
          mesh_(scene.meshes[scene.instances[t.instance].mesh]),
          material_(scene.materials[mesh_.material]),
          triangle_(t),
          firstIndex_(firstIndex),
          cuts_(cuts) {
        const vec3 normal = glm::cross(t.b - t.a, t.c - t.a);
        const float length = glm::length(normal);
        normal_ = length > 0.0F ? normal / length : vec3(0, 1, 0);
        normal_ = (t.flags & triangleMirrored) != 0 ? -normal_ : normal_;
        area_ = 0.5F * length / static_cast<float>(cuts * cuts);
    }

    void appendTo(std::vector<EmissiveSum>& pieces) const {
        for (uint32_t i = 0; i < cuts_; ++i) {
            for (uint32_t k = 0; k + i < cuts_; ++k) {
                append(pieces, vec2(i, k) + 1.0F / 3.0F);
                if (k + i + 1 < cuts_) {
                    append(pieces, vec2(i, k) + 2.0F / 3.0F);
                }
            }
        }
    }

private:
    [[nodiscard]] vec3 radianceAt(const vec3& weights) const {
        const TextureSlot& slot = material_.emissiveTexture;
        if (slot.image < 0) {
            return material_.emissive;
        }
        vec2 uv(0.0F);
        for (uint32_t i = 0; i < 3; ++i) {
            const VertexAttributes& vertex = mesh_.attributes[mesh_.indices[firstIndex_ + i]];
            uv += weights[static_cast<int>(i)] * (slot.uvSet == 1 ? vertex.uv1 : vertex.uv0);
        }
        return material_.emissive * emissiveTexel(scene_, slot, uv);
    }

    void append(std::vector<EmissiveSum>& pieces, const vec2& cut) const {
        const vec2 at = cut / static_cast<float>(cuts_);
        const vec3 weights(1.0F - at.x - at.y, at);
        const vec3 radiance = radianceAt(weights);
        const float bright = area_ * luminance(radiance);
        if (!(bright > 0.0F)) {
            return;
        }
        const bool both = (triangle_.flags & triangleDoubleSided) != 0;
        EmissiveSum piece;
        piece.area = both ? 2.0F * area_ : area_;
        piece.power = radiance * piece.area;
        piece.weight = both ? 2.0F * bright : bright;
        piece.normals = both ? vec3(0.0F) : bright * normal_;
        piece.spread = piece.weight * glm::outerProduct(normal_, normal_);
        piece.origin = weights.x * triangle_.a + weights.y * triangle_.b + weights.z * triangle_.c;
        piece.positions = piece.weight * piece.origin;
        const vec3 middle = (triangle_.a + triangle_.b + triangle_.c) / 3.0F;
        for (const vec3& corner : {triangle_.a, triangle_.b, triangle_.c}) {
            const vec3 away = (corner - middle) / static_cast<float>(cuts_);
            piece.extents += piece.weight / 12.0F * glm::outerProduct(away, away);
        }
        piece.reach = std::max({glm::distance(middle, triangle_.a), glm::distance(middle, triangle_.b),
                                glm::distance(middle, triangle_.c)}) /
                      static_cast<float>(cuts_);
        pieces.push_back(piece);
    }

    const Scene& scene_;
    const Mesh& mesh_;
    const Material& material_;
    const SceneTriangle& triangle_;
    uint32_t firstIndex_;  // of the mesh
    uint32_t cuts_;        // of each side
    vec3 normal_;
    float area_;  // of a piece
};

float trace(const mat3& m) {
    return m[0][0] + m[1][1] + m[2][2];
}

float longestSide(const SceneTriangle& t) {
    return std::max({glm::distance(t.a, t.b), glm::distance(t.b, t.c), glm::distance(t.c, t.a)});
}

struct Seen {
    float distance;
    float angle;  // solid angle [sr]
};

// Cuts triangles that are large as seen from the point.
void addSeen(std::vector<Seen>& seen, const vec3& a, const vec3& b, const vec3& c, const vec3& from, int depth) {
    const vec3 middle = (a + b + c) / 3.0F - from;
    const float square = glm::dot(middle, middle);
    const float side = std::max({glm::distance(a, b), glm::distance(b, c), glm::distance(c, a)});
    if (depth > 0 && side * side > square) {
        const vec3 ab = 0.5F * (a + b);
        const vec3 bc = 0.5F * (b + c);
        const vec3 ca = 0.5F * (c + a);
        addSeen(seen, a, ab, ca, from, depth - 1);
        addSeen(seen, ab, b, bc, from, depth - 1);
        addSeen(seen, ca, bc, c, from, depth - 1);
        addSeen(seen, ab, bc, ca, from, depth - 1);
        return;
    }
    const float distance = std::sqrt(square);
    const float facing = 0.5F * std::abs(glm::dot(glm::cross(b - a, c - a), middle)) / std::max(distance, 1e-20F);
    seen.push_back({distance, std::min(facing / std::max(square, 1e-20F), 2.0F * pi)});
}

}  // namespace

float EmissiveSum::variance() const {
    const vec3 mean = centre() - origin;
    return std::max(trace(moments) / weight - glm::dot(mean, mean), 0.0F);
}

mat3 EmissiveSum::covariance() const {
    const vec3 mean = centre() - origin;
    return (moments + extents) / weight - glm::outerProduct(mean, mean);
}

EmissiveSum sumOf(std::span<const EmissiveSum> parts) {
    EmissiveSum sum;
    sum.origin = parts.front().origin;
    for (const EmissiveSum& part : parts) {
        const vec3 moved = part.origin - sum.origin;
        const vec3 offset = part.positions - part.weight * part.origin;
        sum.moments += part.moments + glm::outerProduct(moved, offset) + glm::outerProduct(offset, moved) +
                       part.weight * glm::outerProduct(moved, moved);
        sum.extents += part.extents;
        sum.area += part.area;
        sum.power += part.power;
        sum.weight += part.weight;
        sum.normals += part.normals;
        sum.spread += part.spread;
        sum.positions += part.positions;
    }
    const vec3 centre = sum.centre();
    for (const EmissiveSum& part : parts) {
        const float away = glm::distance(part.centre(), centre);
        // A single piece of a round surface lies across the way to the centre.
        const float farthest = trace(part.moments) == 0.0F ? std::hypot(away, part.reach) : away + part.reach;
        sum.reach = std::max(sum.reach, farthest);
    }
    return sum;
}

std::vector<EmissiveSum> emissivePieces(const Scene& scene, std::span<const SceneTriangle> triangles, float finest) {
    std::vector<EmissiveSum> pieces;
    if (triangles.empty()) {
        return pieces;
    }
    const size_t mesh = scene.instances[triangles.front().instance].mesh;
    size_t before = 0;  // indices of the meshes before this one
    for (size_t i = 0; i < mesh; ++i) {
        before += scene.meshes[i].indices.size();
    }
    const bool textured = scene.materials[scene.meshes[mesh].material].emissiveTexture.image >= 0;
    const float most = std::sqrt(mostPieces / static_cast<float>(triangles.size()));
    for (const SceneTriangle& t : triangles) {
        const float wanted = textured ? most : longestSide(t) / std::max(finest, 1e-12F);
        const auto cuts = static_cast<uint32_t>(std::clamp(std::ceil(wanted), 1.0F, std::max(most, 1.0F)));
        Cutter(scene, t, static_cast<uint32_t>(t.firstIndex - before), cuts).appendTo(pieces);
    }
    return pieces;
}

std::vector<Sampled> sampled(std::vector<SceneTriangle> triangles, size_t most) {
    const size_t large = std::min(triangles.size(), most / 2);
    std::ranges::nth_element(triangles, triangles.begin() + static_cast<ptrdiff_t>(large), std::greater<>(),
                             longestSide);
    const size_t stride = (triangles.size() - large) / std::max<size_t>(most - large, 1) + 1;
    std::vector<Sampled> kept;
    for (size_t i = 0; i < triangles.size(); i += i < large ? 1 : stride) {
        kept.push_back({triangles[i], i < large ? 1.0F : static_cast<float>(stride)});
    }
    return kept;
}

float litDistance(std::span<const Sampled> around, const vec3& from, uint32_t skip) {
    std::vector<Seen> seen;
    for (const Sampled& s : around) {
        if (s.triangle.instance != skip) {
            const size_t first = seen.size();
            addSeen(seen, s.triangle.a, s.triangle.b, s.triangle.c, from, 6);
            std::for_each(seen.begin() + static_cast<ptrdiff_t>(first), seen.end(),
                          [&](Seen& part) { part.angle *= s.weight; });
        }
    }
    std::ranges::sort(seen, {}, &Seen::distance);
    const float all =
        std::transform_reduce(seen.begin(), seen.end(), 0.0F, std::plus<>(), [](const Seen& s) { return s.angle; });
    const float most = reached * std::min(all, 4.0F * pi);
    float sum = 0.0F;
    for (const Seen& s : seen) {
        sum += s.angle;
        if (sum >= most) {
            return s.distance;
        }
    }
    return 0.0F;
}

}  // namespace reflet
