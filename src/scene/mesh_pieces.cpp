// Splits a mesh's triangles at the median of their centres, as often as the number of groups allows.
#include "scene/mesh_pieces.h"

#include <algorithm>
#include <iterator>
#include <numeric>
#include <span>

namespace reflet {
namespace {

constexpr size_t mostPieces = 1024;
constexpr size_t fewestTriangles = 16;  // of a piece that is split

Aabb boundsOf(const Mesh& mesh, uint32_t triangle) {
    Aabb box;
    for (uint32_t i = 0; i < 3; ++i) {
        box.add(mesh.positions[mesh.indices[3 * size_t{triangle} + i]]);
    }
    return box;
}

void split(std::span<const Aabb> bounds, std::span<uint32_t> triangles, size_t pieces, std::vector<Aabb>& out) {
    Aabb box;
    Aabb centres;
    for (const uint32_t t : triangles) {
        box.add(bounds[t]);
        centres.add(bounds[t].center());
    }
    if (pieces < 2 || triangles.size() < fewestTriangles) {
        out.push_back(box);
        return;
    }
    const vec3 size = centres.size();
    const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
    const size_t middle = triangles.size() / 2;
    std::ranges::nth_element(triangles, triangles.begin() + static_cast<std::ptrdiff_t>(middle), {},
                             [&](uint32_t t) { return bounds[t].min[axis] + bounds[t].max[axis]; });
    split(bounds, triangles.first(middle), pieces / 2, out);
    split(bounds, triangles.subspan(middle), pieces / 2, out);
}

}  // namespace

std::vector<Aabb> meshPieces(const Mesh& mesh) {
    std::vector<uint32_t> triangles(mesh.indices.size() / 3);
    std::iota(triangles.begin(), triangles.end(), 0U);
    std::vector<Aabb> bounds;
    std::ranges::transform(triangles, std::back_inserter(bounds), [&](uint32_t t) { return boundsOf(mesh, t); });
    std::vector<Aabb> pieces;
    if (!triangles.empty()) {
        split(bounds, triangles, mostPieces, pieces);
    }
    return pieces;
}

}  // namespace reflet
