// Naive surface nets: one vertex per lattice cell that the surface crosses, one quad per lattice edge that it crosses.
#include "scene/builtin/surface_nets.h"

#include <utility>
#include <vector>

namespace reflet::builtin {
namespace {

constexpr uint32_t none = ~0U;

class Nets {
public:
    Nets(const Lattice& lattice, const std::function<float(const vec3&)>& field)
        : l(lattice),
          points(lattice.cells + 1U),
          values(size_t{points.x} * points.y * points.z),
          vertexOfCell(values.size(), none) {
        each(points, [&](const glm::uvec3& p) { values[at(p)] = field(l.origin + l.cell * vec3(p)); });
    }

    Mesh make() {
        each(l.cells, [&](const glm::uvec3& cell) { addVertex(cell); });
        each(l.cells, [&](const glm::uvec3& p) {
            for (unsigned axis = 0; axis < 3; ++axis) {
                addQuad(p, axis);
            }
        });
        return std::move(mesh);
    }

private:
    template <class Do>
    static void each(const glm::uvec3& size, const Do& act) {
        for (unsigned z = 0; z < size.z; ++z) {
            for (unsigned y = 0; y < size.y; ++y) {
                for (unsigned x = 0; x < size.x; ++x) {
                    act(glm::uvec3(x, y, z));
                }
            }
        }
    }

    [[nodiscard]] size_t at(const glm::uvec3& p) const { return (size_t{p.z} * points.y + p.y) * points.x + p.x; }

    [[nodiscard]] float corner(const glm::uvec3& cell, unsigned i) const {
        return values[at(cell + glm::uvec3(i & 1U, (i >> 1U) & 1U, i >> 2U))];
    }

    /// The mean of the points where the surface crosses the cell's twelve edges.
    void addVertex(const glm::uvec3& cell) {
        vec3 sum(0.0F);
        float crossings = 0.0F;
        for (unsigned i = 0; i < 8; ++i) {
            for (unsigned axis = 0; axis < 3; ++axis) {
                const unsigned j = i | (1U << axis);
                const float a = corner(cell, i);
                const float b = corner(cell, j);
                if (j == i || (a < 0.0F) == (b < 0.0F)) {
                    continue;
                }
                vec3 p(i & 1U, (i >> 1U) & 1U, i >> 2U);
                p[static_cast<int>(axis)] = a / (a - b);
                sum += p;
                crossings += 1.0F;
            }
        }
        if (crossings == 0.0F) {
            return;
        }
        const vec3 inCell = sum / crossings;
        vertexOfCell[at(cell)] = static_cast<uint32_t>(mesh.positions.size());
        mesh.positions.push_back(l.origin + l.cell * (vec3(cell) + inCell));
        VertexAttributes attributes;
        attributes.normal = slope(cell, inCell);
        mesh.attributes.push_back(attributes);
    }

    /// Direction of the gradient of the trilinearly interpolated field.
    [[nodiscard]] vec3 slope(const glm::uvec3& cell, const vec3& t) const {
        vec3 g(0.0F);
        for (unsigned i = 0; i < 8; ++i) {
            const vec3 high(i & 1U, (i >> 1U) & 1U, i >> 2U);
            const vec3 w = glm::mix(1.0F - t, t, high);
            const vec3 sign = 2.0F * high - 1.0F;
            g += corner(cell, i) * sign * vec3(w.y * w.z, w.x * w.z, w.x * w.y);
        }
        const float length = glm::length(g);
        return length > 1e-8F ? g / length : vec3(0, 1, 0);
    }

    /// The quad of the four cells around the edge from p along the axis, if the surface crosses that edge.
    void addQuad(const glm::uvec3& p, unsigned axis) {
        const unsigned u = (axis + 1) % 3;
        const unsigned v = (axis + 2) % 3;
        glm::uvec3 q = p;
        q[static_cast<int>(axis)] += 1;
        const bool solidHere = values[at(p)] < 0.0F;
        if (p[static_cast<int>(u)] == 0 || p[static_cast<int>(v)] == 0 || solidHere == (values[at(q)] < 0.0F)) {
            return;
        }
        glm::uvec3 lessU = p, lessV = p;
        lessU[static_cast<int>(u)] -= 1;
        lessV[static_cast<int>(v)] -= 1;
        glm::uvec3 lessBoth = lessU;
        lessBoth[static_cast<int>(v)] -= 1;
        const uint32_t a = vertexOfCell[at(lessBoth)], b = vertexOfCell[at(lessV)];
        const uint32_t c = vertexOfCell[at(p)], d = vertexOfCell[at(lessU)];
        if (solidHere) {
            mesh.indices.insert(mesh.indices.end(), {a, b, c, a, c, d});
        } else {
            mesh.indices.insert(mesh.indices.end(), {a, c, b, a, d, c});
        }
    }

    Lattice l;
    glm::uvec3 points;
    std::vector<float> values;
    std::vector<uint32_t> vertexOfCell;
    Mesh mesh;
};

}  // namespace

Mesh surfaceNets(const Lattice& lattice, const std::function<float(const vec3&)>& field) {
    return Nets(lattice, field).make();
}

}  // namespace reflet::builtin
