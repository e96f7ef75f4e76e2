// A picked pixel of a frame that is smaller than the picture: everything about it is in pixels of the picture.
#include "renderer/history.h"
#include "renderer/presets.h"
#include "support/device_fixture.h"
#include "view/session.h"

#include <algorithm>

namespace reflet::test::picked_test {
namespace {

TEST(PixelScale, GoesBothWays) {
    const PixelScale half{uvec2(50, 40), uvec2(100, 80)};
    EXPECT_EQ(half.toFrame(uvec2(99, 79)), uvec2(49, 39));
    EXPECT_EQ(half.toPicture(uvec2(49, 0)), uvec2(99, 1));
    EXPECT_EQ(half.placeInPicture(vec2(50, 40)), vec2(100, 80));
    const PixelScale same{uvec2(50, 40), uvec2(50, 40)};
    for (uint32_t x = 0; x < 50; ++x) {
        EXPECT_EQ(half.toFrame(half.toPicture(uvec2(x, 7))), uvec2(x, 7));
        EXPECT_EQ(same.toPicture(uvec2(x, 7)), uvec2(x, 7));
    }
}

class PickedPixel : public DeviceTest {
protected:
    static constexpr uvec2 size{160, 120};
    static constexpr uvec2 pixel{80, 100};  // the ground in front of the cubes, which it mirrors

    // scale: temporal.scale.
    static Picked pick(float scale) {
        ViewerState state;
        state.source.scene = "builtin:cubes";
        applyPreset(state.settings, "plain");
        state.settings.temporal.enabled = 1;
        state.settings.temporal.scale = scale;
        state.settings.traceScreen.jitter = 0;
        EXPECT_EQ(renderSize(state.settings, size), uvec2(glm::round(vec2(size) * scale)));
        Session session(device(), state.source);
        state.view = session.opened().firstView;
        return session.pick(state, size, pixel);
    }

    // Of a point in world space, in pixels of the picture.
    static vec2 placeOf(const Picked& picked, const vec3& point) {
        const vec4 clip = picked.view.worldToClip * vec4(point, 1.0F);
        return (0.5F + 0.5F * vec2(clip) / clip.w) * vec2(size);
    }
};

// Distance of a point from a rectangle.
float distanceTo(const PickedCell& cell, const vec2& point) {
    return glm::distance(point, glm::clamp(point, cell.corner, cell.corner + cell.size));
}

TEST_F(PickedPixel, ItsRayStartsThereAndReadsCellsAlongItsLine) {
    for (const float scale : {1.0F, 0.5F}) {
        const Picked picked = pick(scale);
        ASSERT_TRUE(picked.ray) << scale;
        ASSERT_GT(picked.cells.size(), 4U) << scale;
        const float pixelOfFrame = 1.0F / scale;
        const vec2 start = placeOf(picked, picked.ray->start);
        EXPECT_LT(glm::distance(start, vec2(pixel) + 0.5F), 2.0F * pixelOfFrame) << scale;
        const vec2 end = placeOf(picked, picked.ray->start + picked.ray->distance * picked.ray->direction);
        ASSERT_GT(glm::distance(start, end), 8.0F) << scale;
        for (const PickedCell& cell : picked.cells) {
            float nearest = 1e9F;
            for (int i = 0; i <= 1000; ++i) {
                nearest = std::min(nearest, distanceTo(cell, glm::mix(start, end, static_cast<float>(i) / 1000.0F)));
            }
            EXPECT_LT(nearest, 2.0F * pixelOfFrame) << scale << ": cell at " << cell.corner.x << ' ' << cell.corner.y;
        }
        EXPECT_EQ(std::ranges::find(picked.cells, true, &PickedCell::isPixel)->size, vec2(pixelOfFrame)) << scale;
    }
}

TEST_F(PickedPixel, TheHitIsWhereTheRayEnds) {
    for (const float scale : {1.0F, 0.5F}) {
        const Picked picked = pick(scale);
        ASSERT_TRUE(picked.ray) << scale;
        ASSERT_EQ(picked.ray->outcome, RayOutcome::hit) << scale;
        const vec2 end = placeOf(picked, picked.ray->start + picked.ray->distance * picked.ray->direction);
        EXPECT_LT(glm::distance(vec2(picked.ray->pixel) + 0.5F, end), 3.0F / scale) << scale;
        size_t hits = 0;
        for (const RecordedSample& sample : picked.hemisphere) {
            if (sample.hits) {
                ++hits;
                const vec2 at = placeOf(picked, picked.ray->start + sample.distance * sample.direction);
                EXPECT_LT(glm::distance(vec2(sample.pixel) + 0.5F, at), 4.0F / scale) << scale;
            }
        }
        EXPECT_GT(hits, 4U) << scale;
    }
}

// The two frames sample the same surfaces at places a pixel apart.
TEST_F(PickedPixel, ValuesAreThoseOfItsPlaceInAnyFrame) {
    const auto depthOf = [](const Picked& picked) {
        return std::ranges::find(picked.values, "depth", &PickedValues::name)->values.front();
    };
    const float whole = depthOf(pick(1.0F));
    EXPECT_NEAR(depthOf(pick(0.5F)), whole, 0.03F * whole);
}

}  // namespace
}  // namespace reflet::test::picked_test
