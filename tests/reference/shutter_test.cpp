// The shutter of the path tracer: streaks of lights that move, and of lights before a camera that moves, against the
// closed form of a box.
#include "reference/shutter.h"

#include "reference/harness.h"
#include "scene/builtin/animate.h"

#include <cmath>

namespace reflet::test::shutter_test {
namespace {

constexpr uvec2 size{64, 32};
constexpr float distance = 5.0F;
constexpr float streak = 12.0F;  // pixels

// A square light 8 pixels wide at the end of the view axis, before black.
constexpr float pixelSize = 0.02F;  // metres there
constexpr float halfLight = 4.0F * pixelSize;

View view() {
    return darkView(vec3(0.0F), {0, 0, -1}, glm::degrees(2.0F * std::atan(0.5F * 32.0F * pixelSize / distance)));
}

struct Row {
    double energy = 0.0;
    double mean = 0.0;      // of the place along the picture's width, pixels
    double variance = 0.0;  // of it
};

Row rowOf(const FloatImage& image) {
    Row row;
    double square = 0.0;
    for (uint32_t y = 0; y < size.y; ++y) {
        for (uint32_t x = 0; x < size.x; ++x) {
            const double light = pixel(image, x, y);
            row.energy += light;
            row.mean += light * (x + 0.5);
            square += light * (x + 0.5) * (x + 0.5);
        }
    }
    row.mean /= row.energy;
    row.variance = square / row.energy - row.mean * row.mean;
    return row;
}

void expectStreak(const ReferencePicture& blurred, const ReferencePicture& sharp) {
    const Row before = rowOf(sharp.direct);
    const Row row = rowOf(blurred.direct);
    EXPECT_NEAR(row.energy, before.energy, 0.02 * before.energy);
    EXPECT_NEAR(row.mean, before.mean, 0.15) << "the streak is not around the frame's time";
    EXPECT_NEAR(row.variance - before.variance, streak * streak / 12.0, 0.5) << "not that of a box";
    EXPECT_EQ(blurred.samples, sharp.samples);
    EXPECT_EQ(blurred.depth.data, sharp.depth.data) << "depth is not that of the middle";
    EXPECT_EQ(blurred.normal.data, sharp.normal.data);
}

TEST(Shutter, ALightThatMovesBecomesAStreak) {
    Scene scene;
    add(scene, lambertMaterial(vec3(0.0F), vec3(50.0F)), square({0, 0, -distance}, {0, 0, 1}, halfLight));
    const float half = 0.5F * streak * pixelSize;
    scene.instances.front().node = builtin::addSlidingNode(scene, {-half, 0, 0}, {half, 0, 0}, 1.0F);
    View now = view();
    now.time = 0.5;
    const ReferenceOptions options = lambert(0, 256);
    const auto at = [&](double share) {
        View during = now;
        during.time = 0.999 * share + 0.0005;  // the animation starts again at 1
        return during;
    };
    expectStreak(traceShutter(scene, at, size, options), traceReference(scene, now, size, options));
}

TEST(Shutter, ACameraThatMovesDrawsStreaksOfWhatStandsStill) {
    Scene scene;
    add(scene, lambertMaterial(vec3(0.0F), vec3(50.0F)), square({0, 0, -distance}, {0, 0, 1}, halfLight));
    const ReferenceOptions options = lambert(0, 256);
    const auto at = [&](double share) {
        View during = view();
        const auto x = static_cast<float>((share - 0.5) * streak * pixelSize);
        during.camera.position.x += x;
        during.camera.target.x += x;
        return during;
    };
    const ReferencePicture blurred = traceShutter(scene, at, size, options);
    expectStreak(blurred, traceReference(scene, view(), size, options));
    EXPECT_EQ(traceShutter(scene, at, size, options).final.data, blurred.final.data) << "other times, other picture";
}

TEST(Shutter, AStillPictureIsThatOfTheReference) {
    Scene scene;
    add(scene, lambertMaterial(vec3(0.5F)), square({0, -1, -3}, {0, 1, 0}, 3.0F));
    View still = view();
    still.camera.fovY = glm::radians(50.0F);
    still.environment.radiance = vec3(1.0F);
    ReferenceOptions options = lambert(2, 64);
    const ReferencePicture sharp = traceReference(scene, still, size, options);
    const ReferencePicture mean = traceShutter(
        scene, [&](double) { return still; }, size, options);
    for (size_t i = 0; i < sharp.final.data.size(); ++i) {
        // Equal parts of the same samples, added in another order.
        ASSERT_NEAR(mean.final.data[i], sharp.final.data[i], 1e-4F + 1e-3F * sharp.final.data[i]) << i;
    }
    EXPECT_NEAR(mean.noise, sharp.noise, 0.3 * sharp.noise);
    options.noise = 0.5F * static_cast<float>(sharp.noise);
    options.samples = 4096;
    const ReferencePicture cleaner = traceShutter(
        scene, [&](double) { return still; }, size, options);
    EXPECT_LT(cleaner.noise, 1.2 * options.noise);
    EXPECT_LT(cleaner.samples, 4096U) << "it ends as soon as the noise is low";
}

}  // namespace
}  // namespace reflet::test::shutter_test
