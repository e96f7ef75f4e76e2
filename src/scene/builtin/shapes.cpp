// Flat-sided shapes, and box mapping of uvs.
#include "scene/builtin/shapes.h"

#include <array>
#include <cmath>
#include <map>
#include <utility>
#include <vector>

namespace reflet::builtin {
namespace {

struct Face {
    vec3 right;
    vec3 up;
};

/// Orientation of the image on each side; its upper edge is at -z on top and at +z on the underside.
constexpr std::array<Face, 6> faces{{{{0, 0, -1}, {0, 1, 0}},
                                     {{0, 0, 1}, {0, 1, 0}},
                                     {{1, 0, 0}, {0, 0, -1}},
                                     {{1, 0, 0}, {0, 0, 1}},
                                     {{1, 0, 0}, {0, 1, 0}},
                                     {{-1, 0, 0}, {0, 1, 0}}}};

/// Two triangles per cell of a grid whose rows of `columns` + 1 vertices run from the image's top down.
void addCells(Mesh& mesh, uint32_t first, unsigned columns, unsigned rows) {
    for (unsigned y = 0; y < rows; ++y) {
        for (unsigned x = 0; x < columns; ++x) {
            const uint32_t a = first + y * (columns + 1) + x;
            const uint32_t b = a + columns + 1;
            mesh.indices.insert(mesh.indices.end(), {a, b, b + 1, a, b + 1, a + 1});
        }
    }
}

/// Vertex coordinates of a rounded box along one axis: dense at the rounded ends, one step across the flat part.
std::vector<float> roundedSteps(float half, float radius, unsigned steps) {
    std::vector<float> upper;
    for (unsigned i = 0; i <= steps; ++i) {
        const float angle = glm::quarter_pi<float>() * static_cast<float>(i) / static_cast<float>(steps);
        upper.push_back(half - radius + radius * std::tan(angle));
    }
    std::vector<float> all;
    for (unsigned i = 0; i <= steps; ++i) {
        all.push_back(-upper[steps - i]);
    }
    all.insert(all.end(), upper.begin(), upper.end());
    return all;
}

}  // namespace

Mesh patch(const Patch& p) {
    Mesh mesh;
    const vec3 normal = glm::cross(p.right, p.up);
    for (unsigned y = 0; y <= p.cells.y; ++y) {
        for (unsigned x = 0; x <= p.cells.x; ++x) {
            const vec2 t(static_cast<float>(x) / static_cast<float>(p.cells.x),
                         static_cast<float>(y) / static_cast<float>(p.cells.y));
            const vec3 position = p.center + (2.0F * t.x - 1.0F) * p.right + (1.0F - 2.0F * t.y) * p.up;
            addVertex(mesh, position, normal, t * p.uvSize);
        }
    }
    addCells(mesh, 0, p.cells.x, p.cells.y);
    finish(mesh);
    return mesh;
}

Mesh ground(const vec2& halfSize, const glm::uvec2& cells, const vec2& uvSize) {
    return patch({{}, vec3(halfSize.x, 0, 0), vec3(0, 0, -halfSize.y), cells, uvSize});
}

Mesh box(const vec3& halfSize, float uvPerMetre) {
    Mesh mesh;
    for (const Face& face : faces) {
        const vec3 right = face.right * halfSize;
        const vec3 up = face.up * halfSize;
        const vec3 outwards = glm::cross(face.right, face.up) * halfSize;
        const vec2 size = 2.0F * vec2(glm::length(right), glm::length(up));
        append(mesh, patch({outwards, right, up, {1, 1}, uvPerMetre > 0.0F ? size * uvPerMetre : vec2(1.0F)}),
               mat4(1.0F));
    }
    finish(mesh);
    return mesh;
}

Mesh roundedBox(const vec3& halfSize, float radius, unsigned steps) {
    Mesh mesh;
    for (const Face& face : faces) {
        const vec3 outwards = glm::cross(face.right, face.up);
        const float halfRight = glm::dot(glm::abs(face.right), halfSize);
        const float halfUp = glm::dot(glm::abs(face.up), halfSize);
        const auto columns = roundedSteps(halfRight, radius, steps);
        const auto rows = roundedSteps(halfUp, radius, steps);
        const auto first = static_cast<uint32_t>(mesh.positions.size());
        for (const float y : rows) {
            for (const float x : columns) {
                const vec3 onBox = outwards * halfSize + face.right * x - face.up * y;
                const vec3 core = glm::clamp(onBox, vec3(radius) - halfSize, halfSize - vec3(radius));
                const vec3 normal = glm::normalize(onBox - core);
                addVertex(mesh, core + radius * normal, normal, 0.5F + 0.5F * vec2(x / halfRight, y / halfUp));
            }
        }
        addCells(mesh, first, static_cast<unsigned>(columns.size() - 1), static_cast<unsigned>(rows.size() - 1));
    }
    finish(mesh);
    return mesh;
}

Mesh boxMapped(const Mesh& mesh, float uvPerMetre) {
    Mesh result;
    result.name = mesh.name;
    std::map<std::pair<uint32_t, int>, uint32_t> known;
    const auto vertex = [&](uint32_t index, int side) {
        const auto [entry, isNew] = known.try_emplace({index, side}, static_cast<uint32_t>(result.positions.size()));
        if (isNew) {
            const Face& face = faces[static_cast<size_t>(side)];
            const vec3 p = mesh.positions[index];
            addVertex(result, p, mesh.attributes[index].normal,
                      vec2(glm::dot(p, face.right), -glm::dot(p, face.up)) * uvPerMetre);
            result.attributes.back().color = mesh.attributes[index].color;
        }
        return entry->second;
    };
    for (size_t i = 0; i < mesh.indices.size(); i += 3) {
        const uint32_t* t = &mesh.indices[i];
        const vec3 n =
            glm::cross(mesh.positions[t[1]] - mesh.positions[t[0]], mesh.positions[t[2]] - mesh.positions[t[0]]);
        const vec3 a = glm::abs(n);
        const int axis = a.x >= a.y && a.x >= a.z ? 0 : (a.y >= a.z ? 1 : 2);
        const int side = 2 * axis + (n[axis] < 0.0F ? 1 : 0);
        for (int k = 0; k < 3; ++k) {
            result.indices.push_back(vertex(t[k], side));
        }
    }
    finish(result);
    return result;
}

}  // namespace reflet::builtin
