// Separable filters. The inner loops run along rows over plain arrays, so that compilers can vectorize them.
#include "compare/filter.h"

#include <algorithm>
#include <atomic>
#include <thread>

namespace reflet {

Planes3 makePlanes3(uint32_t width, uint32_t height) {
    return {Plane(width, height), Plane(width, height), Plane(width, height)};
}

void forEachRow(uint32_t height, const std::function<void(uint32_t y)>& work) {
    std::atomic<uint32_t> next = 0;
    const auto takeRows = [&] {
        for (uint32_t y = next++; y < height; y = next++) {
            work(y);
        }
    };
    constexpr uint32_t rowsWorthAThread = 16;
    const uint32_t count = std::clamp(std::thread::hardware_concurrency(), 1U, height / rowsWorthAThread + 1);
    std::vector<std::jthread> helpers;
    for (uint32_t i = 1; i < count; ++i) {
        helpers.emplace_back(takeRows);
    }
    takeRows();
}

void filterRows(const Plane& in, const Kernel& kernel, Plane& out) {
    const size_t radius = kernel.size() / 2;
    forEachRow(in.height, [&](uint32_t y) {
        const float* source = in.row(y);
        std::vector<float> padded(in.width + 2 * radius);
        std::fill_n(padded.begin(), radius, source[0]);
        std::copy_n(source, in.width, padded.begin() + static_cast<ptrdiff_t>(radius));
        std::fill_n(padded.end() - static_cast<ptrdiff_t>(radius), radius, source[in.width - 1]);
        float* target = out.row(y);
        std::fill_n(target, in.width, 0.0F);
        for (size_t i = 0; i < kernel.size(); ++i) {
            const float weight = kernel[i];
            const float* shifted = padded.data() + i;
            for (uint32_t x = 0; x < in.width; ++x) {
                target[x] += weight * shifted[x];
            }
        }
    });
}

void filterColumns(const Plane& in, const Kernel& kernel, Plane& out) {
    const auto radius = static_cast<int64_t>(kernel.size() / 2);
    forEachRow(in.height, [&](uint32_t y) {
        float* target = out.row(y);
        std::fill_n(target, in.width, 0.0F);
        for (int64_t i = -radius; i <= radius; ++i) {
            const auto sourceY = static_cast<uint32_t>(std::clamp<int64_t>(y + i, 0, in.height - 1));
            const float weight = kernel[static_cast<size_t>(i + radius)];
            const float* source = in.row(sourceY);
            for (uint32_t x = 0; x < in.width; ++x) {
                target[x] += weight * source[x];
            }
        }
    });
}

}  // namespace reflet
