// Sampling of visible normals, and the table of directional albedos.
#include "reference/microfacet.h"

#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <vector>

namespace reflet {

vec3 sampleVisibleNormal(const vec3& v, float alpha, const vec2& u) {
    const vec3 stretched = glm::normalize(vec3(alpha * v.x, alpha * v.y, v.z));
    // A disk that faces v, with one axis along the horizon; the hemisphere covers only a part of its lower half.
    const vec3 horizontal(-stretched.y, stretched.x, 0.0F);
    const float length = glm::length(horizontal);
    const vec3 across = length > 1e-6F ? horizontal / length : vec3(1, 0, 0);
    const vec3 up = glm::cross(stretched, across);
    const float radius = std::sqrt(u.x);
    const float angle = 2.0F * pi * u.y;
    const float x = radius * std::cos(angle);
    const float share = 0.5F * (1.0F + stretched.z);
    const float y = glm::mix(std::sqrt(1.0F - x * x), radius * std::sin(angle), share);
    const vec3 n = x * across + y * up + std::sqrt(std::max(1.0F - x * x - y * y, 0.0F)) * stretched;
    return glm::normalize(vec3(alpha * n.x, alpha * n.y, std::max(n.z, 0.0F)));
}

namespace {

// Entries at evenly spaced cosines and roughnesses, both in [0, 1].
class AlbedoTable {
public:
    AlbedoTable() : entries_(size_t(side) * side) {
        // Isolated: a waiting thread must not start tracing a path, which would need this very table.
        tbb::this_task_arena::isolate([this] { tbb::parallel_for(0, side, [this](int row) { integrateRow(row); }); });
    }

    [[nodiscard]] LobeAlbedo at(float cosine, float roughness) const {
        const auto unit = [](float v) { return v > 0.0F ? std::min(v, 1.0F) : 0.0F; };  // NaN is 0
        const float x = unit(cosine) * (side - 1);
        const float y = unit(roughness) * (side - 1);
        const int column = std::min(static_cast<int>(x), side - 2);
        const int row = std::min(static_cast<int>(y), side - 2);
        const vec2 value = glm::mix(glm::mix(entry(column, row), entry(column + 1, row), x - column),
                                    glm::mix(entry(column, row + 1), entry(column + 1, row + 1), x - column), y - row);
        return {value.x, value.y};
    }

private:
    static constexpr int side = 48;
    static constexpr int steps = 64;  // of the quadrature, along each axis

    static size_t index(int column, int row) { return static_cast<size_t>(row) * side + static_cast<size_t>(column); }

    void integrateRow(int row) {
        for (int column = 0; column < side; ++column) {
            entries_[index(column, row)] =
                integrate(static_cast<float>(column) / (side - 1), static_cast<float>(row) / (side - 1));
        }
    }

    [[nodiscard]] vec2 entry(int column, int row) const {
        const LobeAlbedo& a = entries_[index(column, row)];
        return {a.scale, a.bias};
    }

    static LobeAlbedo integrate(float cosine, float roughness) {
        const float z = std::max(cosine, 1e-3F);
        const vec3 v(std::sqrt(1.0F - z * z), 0.0F, z);
        const float alpha = std::max(square(roughness), mirrorAlpha);
        LobeAlbedo sum;
        for (int i = 0; i < steps * steps; ++i) {
            const vec2 u = (vec2(i % steps, i / steps) + 0.5F) / static_cast<float>(steps);
            const vec3 h = sampleVisibleNormal(v, alpha, u);
            const vec3 l = 2.0F * glm::dot(v, h) * h - v;
            if (l.z > 0.0F) {
                const float share = unmasked(v, l, alpha);
                const float fresnel = schlick(glm::dot(v, h));
                sum.scale += share * (1.0F - fresnel);
                sum.bias += share * fresnel;
            }
        }
        return {sum.scale / (steps * steps), sum.bias / (steps * steps)};
    }

    std::vector<LobeAlbedo> entries_;
};

}  // namespace

mat3 frameAround(const vec3& n) {
    const vec3 helper = std::abs(n.x) > 0.7F ? vec3(0, 1, 0) : vec3(1, 0, 0);
    const vec3 t = glm::normalize(glm::cross(helper, n));
    return {t, glm::cross(n, t), n};
}

LobeAlbedo ggxAlbedo(float cosine, float roughness) {
    static const AlbedoTable table;
    return table.at(cosine, roughness);
}

}  // namespace reflet
