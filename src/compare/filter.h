// Single-channel planes and separable filters.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

namespace reflet {

/// One number per pixel, rows from the top.
struct Plane {
    Plane() = default;
    Plane(uint32_t width_, uint32_t height_) : width(width_), height(height_), data(size_t{width_} * height_) {}

    [[nodiscard]] float* row(uint32_t y) { return data.data() + size_t{width} * y; }
    [[nodiscard]] const float* row(uint32_t y) const { return data.data() + size_t{width} * y; }

    uint32_t width = 0;
    uint32_t height = 0;
    std::vector<float> data;
};

using Planes3 = std::array<Plane, 3>;

Planes3 makePlanes3(uint32_t width, uint32_t height);

/// Weights of a one-dimensional filter; an odd number, centred on the pixel.
using Kernel = std::vector<float>;

/// Calls work(y) once per row, in parallel on all hardware threads. No row may read what another writes, so that the
/// result is deterministic. An exception from `work` terminates the program.
void forEachRow(uint32_t height, const std::function<void(uint32_t y)>& work);

/// out(x) = sum over i of kernel(i) · in(x + i - radius). Borders are clamped.
void filterRows(const Plane& in, const Kernel& kernel, Plane& out);
/// The same along columns.
void filterColumns(const Plane& in, const Kernel& kernel, Plane& out);

}  // namespace reflet
