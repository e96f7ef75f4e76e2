// Filling and reading of a table of directional albedos.
#include "reference/albedo_table.h"

#include "reference/parallel.h"

#include <tbb/task_arena.h>

#include <algorithm>

namespace reflet {

namespace {

constexpr int side = 48;

size_t indexOf(int column, int row) {
    return static_cast<size_t>(row) * side + static_cast<size_t>(column);
}

}  // namespace

// Isolated: a waiting thread must not start tracing a path, which would need this very table.
AlbedoTable::AlbedoTable(vec2 (*integrate)(float cosine, float roughness)) : entries_(size_t(side) * side) {
    const auto fillRow = [&](uint32_t row) {
        for (int column = 0; column < side; ++column) {
            const float cosine = static_cast<float>(column) / (side - 1);
            entries_[indexOf(column, static_cast<int>(row))] = integrate(cosine, static_cast<float>(row) / (side - 1));
        }
    };
    tbb::this_task_arena::isolate([&] { parallelFor(side, fillRow); });
}

vec2 AlbedoTable::at(float cosine, float roughness) const {
    const auto unit = [](float v) { return v > 0.0F ? std::min(v, 1.0F) : 0.0F; };  // NaN is 0
    const float x = unit(cosine) * (side - 1);
    const float y = unit(roughness) * (side - 1);
    const int column = std::min(static_cast<int>(x), side - 2);
    const int row = std::min(static_cast<int>(y), side - 2);
    const auto entry = [&](int c, int r) { return entries_[indexOf(c, r)]; };
    return glm::mix(glm::mix(entry(column, row), entry(column + 1, row), x - column),
                    glm::mix(entry(column, row + 1), entry(column + 1, row + 1), x - column), y - row);
}

}  // namespace reflet
