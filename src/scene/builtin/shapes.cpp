// Flat, round and turned shapes, and what all meshes need at the end: tangents and bounds.
#include "scene/builtin/shapes.h"

#include <algorithm>
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

/// Sides upright; the lid's image has its upper edge at -z, the underside's at +z.
constexpr std::array<Face, 6> faces{{{{0, 0, -1}, {0, 1, 0}},
                                     {{0, 0, 1}, {0, 1, 0}},
                                     {{1, 0, 0}, {0, 0, -1}},
                                     {{1, 0, 0}, {0, 0, 1}},
                                     {{1, 0, 0}, {0, 1, 0}},
                                     {{-1, 0, 0}, {0, 1, 0}}}};

uint32_t addVertex(Mesh& mesh, const vec3& position, const vec3& normal, const vec2& uv) {
    mesh.positions.push_back(position);
    VertexAttributes attributes;
    attributes.normal = glm::normalize(normal);
    attributes.uv0 = uv;
    attributes.uv1 = uv;
    mesh.attributes.push_back(attributes);
    return static_cast<uint32_t>(mesh.positions.size() - 1);
}

/// Two triangles for each cell of a lattice whose rows of `columns` + 1 vertices run from the image's top down.
void addCells(Mesh& mesh, uint32_t first, unsigned columns, unsigned rows) {
    for (unsigned y = 0; y < rows; ++y) {
        for (unsigned x = 0; x < columns; ++x) {
            const uint32_t a = first + y * (columns + 1) + x;
            const uint32_t b = a + columns + 1;
            mesh.indices.insert(mesh.indices.end(), {a, b, b + 1, a, b + 1, a + 1});
        }
    }
}

vec3 anyPerpendicular(const vec3& n) {
    const vec3 axis = std::abs(n.x) < 0.7F ? vec3(1, 0, 0) : vec3(0, 0, 1);
    return glm::normalize(glm::cross(n, axis));
}

/// In-face coordinates of a rounded box along one axis: dense at the round ends, one step across the flat.
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

/// Normals (in radius, height) at both ends of each piece of an outline.
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

Mesh sphere(float radius, unsigned segments) {
    Mesh mesh;
    const unsigned rings = segments / 2;
    for (unsigned y = 0; y <= rings; ++y) {
        const float v = static_cast<float>(y) / static_cast<float>(rings);
        const bool pole = y == 0 || y == rings;
        for (unsigned x = 0; x <= segments; ++x) {
            // A pole belongs to the middle of its triangle, or its tangent would lean to one side.
            const float u = (static_cast<float>(x) + (pole ? 0.5F : 0.0F)) / static_cast<float>(segments);
            const float phi = glm::two_pi<float>() * (x == segments ? 0.0F : u);  // the seam's ends meet exactly
            const float ringRadius = pole ? 0.0F : std::sin(glm::pi<float>() * v);
            const vec3 normal(ringRadius * std::sin(phi), std::cos(glm::pi<float>() * v), ringRadius * std::cos(phi));
            addVertex(mesh, radius * glm::normalize(normal), normal, {u, v});
        }
    }
    for (unsigned y = 0; y < rings; ++y) {
        for (unsigned x = 0; x < segments; ++x) {
            const uint32_t a = y * (segments + 1) + x;
            const uint32_t b = a + segments + 1;
            if (y + 1 < rings) {
                mesh.indices.insert(mesh.indices.end(), {a, b, b + 1});
            } else {
                mesh.indices.insert(mesh.indices.end(), {a, b, a + 1});
            }
            if (y > 0 && y + 1 < rings) {
                mesh.indices.insert(mesh.indices.end(), {a, b + 1, a + 1});
            }
        }
    }
    finish(mesh);
    return mesh;
}

Mesh lathe(std::span<const vec2> outline, unsigned segments, float uvRepeat) {
    Mesh mesh;
    const auto normals = outlineNormals(outline);
    float total = 0.0F;
    for (size_t i = 0; i + 1 < outline.size(); ++i) {
        total += glm::length(outline[i + 1] - outline[i]);
    }
    float travelled = 0.0F;
    for (size_t i = 0; i + 1 < outline.size(); ++i) {
        const float length = glm::length(outline[i + 1] - outline[i]);
        const auto first = static_cast<uint32_t>(mesh.positions.size());
        for (const int end : {1, 0}) {  // the upper end first: image rows run downwards
            const vec2 point = outline[i + static_cast<size_t>(end)];
            const vec2 n = end == 1 ? normals[i].second : normals[i].first;
            const float v = 1.0F - (travelled + (end == 1 ? length : 0.0F)) / total;
            for (unsigned x = 0; x <= segments; ++x) {
                const float u = static_cast<float>(x) / static_cast<float>(segments);
                const float phi =
                    glm::two_pi<float>() * static_cast<float>(x % segments) / static_cast<float>(segments);
                const vec3 away(std::sin(phi), 0.0F, std::cos(phi));
                addVertex(mesh, point.x * away + vec3(0, point.y, 0), n.x * away + vec3(0, n.y, 0),
                          vec2(u, v) * uvRepeat);
            }
        }
        for (unsigned x = 0; x < segments; ++x) {
            const uint32_t a = first + x;
            const uint32_t b = a + segments + 1;
            if (outline[i].x > 0.0F) {
                mesh.indices.insert(mesh.indices.end(), {a, b, b + 1});
            } else {
                mesh.indices.insert(mesh.indices.end(), {a, b, a + 1});
            }
            if (outline[i].x > 0.0F && outline[i + 1].x > 0.0F) {
                mesh.indices.insert(mesh.indices.end(), {a, b + 1, a + 1});
            }
        }
        travelled += length;
    }
    finish(mesh);
    return mesh;
}

Mesh cylinder(float radius, float height, unsigned segments) {
    const std::array<vec2, 4> outline{vec2(0, 0), vec2(radius, 0), vec2(radius, height), vec2(0, height)};
    return lathe(outline, segments);
}

void append(Mesh& to, const Mesh& from, const mat4& fromToTo) {
    const auto first = static_cast<uint32_t>(to.positions.size());
    const mat3 turn(fromToTo);
    for (size_t i = 0; i < from.positions.size(); ++i) {
        to.positions.emplace_back(fromToTo * vec4(from.positions[i], 1.0F));
        VertexAttributes a = from.attributes[i];
        a.normal = glm::normalize(turn * a.normal);
        a.tangent = vec4(glm::normalize(turn * vec3(a.tangent)), a.tangent.w);
        to.attributes.push_back(a);
    }
    for (const uint32_t index : from.indices) {
        to.indices.push_back(first + index);
    }
    to.bounds = Aabb{};
    for (const vec3& p : to.positions) {
        to.bounds.add(p);
    }
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

void finish(Mesh& mesh) {
    std::vector<vec3> sums(mesh.positions.size(), vec3(0.0F));
    std::vector<float> handedness(mesh.positions.size(), 0.0F);
    for (size_t i = 0; i < mesh.indices.size(); i += 3) {
        const uint32_t* t = &mesh.indices[i];
        const vec3 p1 = mesh.positions[t[1]] - mesh.positions[t[0]];
        const vec3 p2 = mesh.positions[t[2]] - mesh.positions[t[0]];
        const vec2 uv1 = mesh.attributes[t[1]].uv0 - mesh.attributes[t[0]].uv0;
        const vec2 uv2 = mesh.attributes[t[2]].uv0 - mesh.attributes[t[0]].uv0;
        const float area = uv1.x * uv2.y - uv2.x * uv1.y;
        const vec3 alongU = (p1 * uv2.y - p2 * uv1.y) * (area < 0.0F ? -1.0F : 1.0F);
        for (int k = 0; k < 3; ++k) {
            sums[t[k]] += alongU;
            handedness[t[k]] -= area;  // counter-clockwise with v downwards: negative, an unmirrored image
        }
    }
    mesh.bounds = Aabb{};
    for (size_t i = 0; i < mesh.positions.size(); ++i) {
        const vec3 n = mesh.attributes[i].normal;
        const vec3 t = sums[i] - n * glm::dot(n, sums[i]);
        const float length = glm::length(t);
        mesh.attributes[i].tangent =
            vec4(length > 1e-12F ? t / length : anyPerpendicular(n), handedness[i] < 0.0F ? -1 : 1);
        mesh.bounds.add(mesh.positions[i]);
    }
}

glm::u16vec4 vertexColor(const vec3& color) {
    const vec3 c = glm::clamp(color, 0.0F, 1.0F) * 65535.0F + 0.5F;
    return {static_cast<uint16_t>(c.x), static_cast<uint16_t>(c.y), static_cast<uint16_t>(c.z), 65535};
}

}  // namespace reflet::builtin
