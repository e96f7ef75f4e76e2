// The sequence of subpixel jitter.
#include "effects/jitter.h"

#include <gtest/gtest.h>

#include <set>
#include <utility>

namespace reflet::test::jitter_test {
namespace {

TEST(Jitter, StartsInTheMiddleAndStaysInThePixel) {
    EXPECT_EQ(subpixelJitter(0), vec2(0.0F));
    for (uint32_t i = 1; i < 4096; ++i) {
        const vec2 at = subpixelJitter(i);
        ASSERT_TRUE(at.x >= -0.5F && at.x <= 0.5F && at.y >= -0.5F && at.y <= 0.5F) << i;
    }
}

// So that with temporal upscaling by 2, four frames have a sample in each pixel.
TEST(Jitter, EachGridOfSoManyCellsHasASampleInEachCell) {
    for (uint32_t first = 0; first < 256; first += 64) {
        for (uint32_t count = 4; count <= 64; count *= 2) {
            for (uint32_t columns = 1; columns <= count; columns *= 2) {
                const vec2 grid(columns, count / columns);
                std::set<std::pair<int, int>> cells;
                for (uint32_t i = 0; i < count; ++i) {
                    const vec2 cell = (subpixelJitter(first + i) + 0.5F) * grid;
                    cells.emplace(static_cast<int>(cell.x), static_cast<int>(cell.y));
                }
                ASSERT_EQ(cells.size(), count) << columns << " columns from " << first;
            }
        }
    }
}

}  // namespace
}  // namespace reflet::test::jitter_test
