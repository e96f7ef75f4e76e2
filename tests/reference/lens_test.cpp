// The thin lens of the path tracer: sizes, shapes and energy of blurred lights against closed forms.
#include "reference/aperture.h"
#include "reference/harness.h"
#include "scene/camera.h"

#include <cmath>

namespace reflet::test::lens_test {
namespace {

constexpr uvec2 size{64, 64};
constexpr float halfLight = 0.12F;  // metres
constexpr float lightDistance = 6.0F;

// A square light at the end of the view axis, before black.
Scene lightScene(float distance = lightDistance, float half = halfLight) {
    Scene scene;
    add(scene, lambertMaterial(vec3(0.0F), vec3(50.0F)), square({0, 0, -distance}, {0, 0, 1}, half));
    return scene;
}

View lensView(float apertureRadius, float focusDistance) {
    View view = darkView(vec3(0.0F), {0, 0, -1}, 40.0F);
    view.camera.apertureRadius = apertureRadius;
    view.camera.focusDistance = focusDistance;
    return view;
}

struct Spot {
    double energy = 0.0;
    double square = 0.0;  // mean square of the distance from the centre, pixels²
};

Spot spotOf(const FloatImage& image) {
    Spot spot;
    glm::dvec2 first(0.0);
    double second = 0.0;
    for (uint32_t y = 0; y < size.y; ++y) {
        for (uint32_t x = 0; x < size.x; ++x) {
            const double light = pixel(image, x, y);
            const glm::dvec2 at = glm::dvec2(x, y) + 0.5 - 0.5 * glm::dvec2(size);
            spot.energy += light;
            first += light * at;
            second += light * glm::dot(at, at);
        }
    }
    spot.square = second / spot.energy - glm::dot(first, first) / (spot.energy * spot.energy);
    return spot;
}

Spot traced(const Scene& scene, const View& view, uint32_t samples = 512) {
    return spotOf(traceReference(scene, view, size, lambert(0, samples)).direct);
}

// The mean square radius of the aperture's image alone: those of the light and of the aperture add up.
double blurOf(const Scene& scene, const View& view) {
    View sharp = view;
    sharp.camera.apertureRadius = 0.0F;
    return traced(scene, view).square - traced(scene, sharp).square;
}

TEST(Lens, MakesADiskOfTheRadiusOfTheCircleOfConfusion) {
    for (const auto& [aperture, focus] : {std::pair(0.16F, 2.0F), std::pair(0.8F, 30.0F)}) {
        const View view = lensView(aperture, focus);
        const double expected = std::abs(circleOfConfusion(view.camera, lightDistance, float(size.y)));
        ASSERT_GT(expected, 4.0);
        EXPECT_NEAR(std::sqrt(2.0 * blurOf(lightScene(), view)), expected, 0.03 * expected) << focus;
    }
}

TEST(Lens, KeepsTheEnergyOfABlurredLight) {
    const Spot sharp = traced(lightScene(), lensView(0.16F, lightDistance));
    for (const float focus : {2.0F, 3.0F, 30.0F}) {
        const Spot blurred = traced(lightScene(), lensView(0.16F, focus));
        EXPECT_NEAR(blurred.energy, sharp.energy, 0.01 * sharp.energy) << focus;
        EXPECT_GT(blurred.square, sharp.square + 1.0);
    }
}

TEST(Lens, OfAnOrthographicCameraBlursLikewise) {
    View view = lensView(0.1F, 2.0F);
    view.camera.orthographicHeight = 2.0F;
    const double expected = circleOfConfusion(view.camera, lightDistance, float(size.y));
    EXPECT_FLOAT_EQ(float(expected), 0.1F / 2.0F * 64.0F / 2.0F * 4.0F);
    EXPECT_NEAR(std::sqrt(2.0 * blurOf(lightScene(), view)), expected, 0.03 * expected);
}

// The mean square radius of a regular polygon is (2 + cos(2 pi / k)) / 6 of its circumradius squared.
TEST(Lens, MakesAPolygonOfItsBlades) {
    for (const uint32_t blades : {3U, 6U}) {
        View view = lensView(0.2F, 2.0F);
        view.camera.blades = blades;
        const double radius = circleOfConfusion(view.camera, lightDistance, float(size.y));
        const double expected = radius * radius * (2.0 + std::cos(2.0 * glm::pi<double>() / blades)) / 6.0;
        EXPECT_NEAR(blurOf(lightScene(), view), expected, 0.06 * expected) << blades;
    }
}

// A triangle is the only shape here that is no mirror image of itself: far lights show it upright, near ones reversed.
TEST(Lens, ShowsTheApertureUprightBehindTheFocusAndReversedBeforeIt) {
    View view = lensView(0.2F, 2.0F);
    view.camera.blades = 3;
    view.camera.bladeRotation = glm::radians(90.0F);  // a corner at the top
    const auto topmost = [&](const View& seen) {
        const FloatImage image = traceReference(lightScene(), seen, size, lambert(0, 256)).direct;
        uint32_t top = 0;
        uint32_t bottom = 0;
        for (uint32_t y = 0; y < size.y; ++y) {
            float row = 0.0F;
            for (uint32_t x = 0; x < size.x; ++x) {
                row += pixel(image, x, y);
            }
            top = row > 0.0F && top == 0 ? y : top;
            bottom = row > 0.0F ? y : bottom;
        }
        return std::pair(int(size.y / 2) - int(top), int(bottom) - int(size.y / 2));
    };
    const auto [farTop, farBottom] = topmost(view);
    EXPECT_GT(farTop, farBottom + 2);
    view.camera.focusDistance = 100.0F;
    view.camera.apertureRadius = 1.0F;
    const auto [nearTop, nearBottom] = topmost(view);
    EXPECT_GT(nearBottom, nearTop + 2);
}

TEST(Aperture, IsUniformOverTheDiskAndOverPolygons) {
    constexpr int steps = 512;
    for (const uint32_t blades : {0U, 3U, 4U, 5U, 7U, 16U}) {
        const double k = blades;
        const double area =
            blades == 0 ? glm::pi<double>() : 0.5 * k * std::sin(2.0 * glm::pi<double>() / k);  // of the whole
        const double inner = blades == 0 ? 0.7 : std::cos(glm::pi<double>() / k);               // of a circle within
        double within = 0.0;
        glm::dvec2 sum(0.0);
        for (int y = 0; y < steps; ++y) {
            for (int x = 0; x < steps; ++x) {
                const vec2 p = onAperture((vec2(x, y) + 0.5F) / float(steps), blades, 0.3F);
                within += glm::length(p) <= inner ? 1.0 : 0.0;
                sum += p;
                ASSERT_LE(glm::length(p), 1.0F + 1e-5F);
            }
        }
        const double count = double(steps) * steps;
        EXPECT_NEAR(within / count, glm::pi<double>() * inner * inner / area, 0.004) << blades;
        EXPECT_NEAR(glm::length(sum / count), 0.0, 0.003) << blades;
    }
}

// A colour that changes over a plane in focus: a pixel's centre shows the same point from all over the aperture.
TEST(Lens, ShowsAPlaneInFocusAsAPinholeDoes) {
    Scene scene;
    TextureImage ramp{"ramp", 2, 2, {0, 40, 200, 255, 250, 80, 10, 255, 90, 250, 60, 255, 20, 0, 250, 255}};
    Material material = lambertMaterial(vec3(0.0F), vec3(2.0F));
    material.emissiveTexture = builtin::addTexture(scene, ramp, {.wrapU = Wrap::clamp, .wrapV = Wrap::clamp});
    add(scene, material, square({0, 0, -3}, {0, 0, 1}, 2.0F));
    ReferenceOptions options = lambert(0, 64);
    options.filter = PixelFilter::center;
    for (const float orthographicHeight : {0.0F, 2.0F}) {
        View view = lensView(0.2F, 3.0F);
        view.camera.orthographicHeight = orthographicHeight;
        const FloatImage lens = traceReference(scene, view, size, options).direct;
        options.pinhole = true;
        const FloatImage pinhole = traceReference(scene, view, size, options).direct;
        options.pinhole = false;
        for (size_t i = 0; i < lens.data.size(); ++i) {
            ASSERT_NEAR(lens.data[i], pinhole.data[i], 2e-4F);
        }
    }
}

// The near plane is a plane, from wherever on the aperture a ray starts.
TEST(Lens, SeesNothingBeforeTheNearPlaneAndEverythingBehindIt) {
    for (const float orthographicHeight : {0.0F, 1.0F}) {
        View view = lensView(0.5F, 4.0F);
        view.camera.near = 1.0F;
        view.camera.orthographicHeight = orthographicHeight;
        const auto coverage = [&](float distance) {
            return mean(traceReference(lightScene(distance, 5.0F), view, size, lambert(0, 16)).coverage).x;
        };
        EXPECT_EQ(coverage(0.999F), 0.0F);
        EXPECT_EQ(coverage(1.001F), 1.0F);
    }
}

TEST(Lens, LeavesDepthAndNormalsSharpAndIsIgnoredAsAPinhole) {
    const Scene scene = lightScene();
    View view = lensView(0.16F, 2.0F);
    ReferenceOptions options = lambert(2, 16);
    const ReferencePicture lens = traceReference(scene, view, size, options);
    options.pinhole = true;
    const ReferencePicture ignored = traceReference(scene, view, size, options);
    view.camera.apertureRadius = 0.0F;
    options.pinhole = false;
    const ReferencePicture pinhole = traceReference(scene, view, size, options);
    EXPECT_EQ(ignored.final.data, pinhole.final.data);
    EXPECT_EQ(lens.depth.data, pinhole.depth.data);
    EXPECT_EQ(lens.normal.data, pinhole.normal.data);
    EXPECT_NE(lens.final.data, pinhole.final.data);
}

}  // namespace
}  // namespace reflet::test::lens_test
