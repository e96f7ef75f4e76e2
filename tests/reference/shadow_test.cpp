// The path tracer's shadows: widths of penumbras by similar triangles.
#include "reference/harness.h"

#include <algorithm>
#include <cmath>

namespace reflet::test::shadow_test {
namespace {

constexpr double pi = glm::pi<double>();

TEST(Shadow, OfAKnifeEdgeUnderTheSunsDiskIsAsWideAsSimilarTrianglesSay) {
    constexpr uint32_t width = 512;
    for (const float degrees : {0.53F, 2.0F, 10.0F}) {
        for (const float height : {1.0F, 5.0F}) {
            Scene scene;
            add(scene, lambertMaterial(vec3(0.5F)), square({0, 0, 0}, {0, 1, 0}, 50.0F));
            Material blade = lambertMaterial(vec3(0.5F));
            blade.doubleSided = true;
            add(scene, blade, square({20, height, 0}, {0, 1, 0}, 20.0F));  // its edge is at x = 0
            const double penumbra = 2.0 * height * std::tan(glm::radians(degrees) * 0.5);
            View view = darkView({0, 0.5F, 0}, {0, 0, 0});
            view.camera.orthographicHeight = static_cast<float>(2.0 * penumbra * 3.0 / width);
            view.sun.direction = {0, -1, 0};
            view.sun.irradiance = vec3(1.0F);
            view.sun.angularDiameter = glm::radians(degrees);
            const ReferencePicture p = traceReference(scene, view, {width, 3}, lambert(0, 256));
            // The image is twice the penumbra wide. Fraction of a disk not covered by a straight edge at c radii:
            for (uint32_t x = 0; x < width; ++x) {
                const double c = std::clamp(((x + 0.5) / width - 0.5) * 4.0, -1.0, 1.0);
                const double open = (std::acos(c) - c * std::sqrt(1.0 - c * c)) / pi;
                ASSERT_NEAR(pixel(p.sunVisibility, x, 1), open, 0.02) << degrees << ", " << height << ", " << x;
            }
        }
    }
}

TEST(Shadow, OfAKnifeEdgeUnderALampsDiskIsAsWideAsSimilarTrianglesSay) {
    constexpr uint32_t width = 512;
    constexpr float lampHeight = 4.0F;
    for (const float radius : {0.02F, 0.2F}) {
        for (const float height : {0.5F, 2.0F, 3.0F}) {
            Scene scene;
            add(scene, lambertMaterial(vec3(0.5F)), square({0, 0, 0}, {0, 1, 0}, 50.0F));
            const float penumbra = 2.0F * radius * height / (lampHeight - height);
            View view = darkView({0, 0.4F, 0}, {0, 0, 0});
            view.camera.orthographicHeight = 2.0F * penumbra * 3.0F / width;
            Lamp lamp;
            lamp.type = Lamp::Type::spot;
            lamp.position = {0, lampHeight, 0};
            lamp.intensity = vec3(10.0F);
            lamp.radius = radius;
            scene.lamps.push_back(lamp);
            const ReferencePicture open = traceReference(scene, view, {width, 3}, lambert(0, 16));
            Material blade = lambertMaterial(vec3(0.5F));
            blade.doubleSided = true;
            add(scene, blade, square({20, height, 0}, {0, 1, 0}, 20.0F));  // its edge is at x = 0
            const ReferencePicture p = traceReference(scene, view, {width, 3}, lambert(0, 256));
            // As for the sun, but the disk faces each point.
            for (uint32_t x = 0; x < width; ++x) {
                const double at = ((x + 0.5) / width - 0.5) * 2.0 * penumbra;
                const double distance = std::hypot(at, double(lampHeight));
                const double edge = at * (lampHeight - height) / height;  // at the lamp's height, from its centre
                const double c = std::clamp(edge * lampHeight / (distance * radius), -1.0, 1.0);
                const double expected = (std::acos(c) - c * std::sqrt(1.0 - c * c)) / pi;
                ASSERT_NEAR(pixel(p.direct, x, 1) / pixel(open.direct, x, 1), expected, 0.02)
                    << radius << ", " << height << ", " << x;
            }
        }
    }
}

TEST(Shadow, IsCastByNothingNearerToALampThanItsRadius) {
    Scene scene;
    add(scene, lambertMaterial(vec3(0.5F)), square({0, 0, 0}, {0, 1, 0}, 20.0F));
    Lamp lamp;
    lamp.position = {0, 2, 0};
    lamp.intensity = vec3(10.0F);
    lamp.radius = 0.1F;
    scene.lamps.push_back(lamp);
    const View view = darkView({0, 0.5F, 0}, {0, 0, 0}, 2.0F);  // a patch of the floor of about 2 cm
    const float open = mean(traceReference(scene, view, {4, 4}, lambert(0, 64)).direct).x;
    ASSERT_GT(open, 0.1F);
    add(scene, lambertMaterial(vec3(0.5F)), builtin::sphere(0.098F, 32), builtin::at(lamp.position));
    EXPECT_NEAR(mean(traceReference(scene, view, {4, 4}, lambert(0, 64)).direct).x, open, 1e-4F * open);
    scene.lamps.front().radius = 0.05F;
    EXPECT_EQ(mean(traceReference(scene, view, {4, 4}, lambert(0, 64)).direct).x, 0.0F);
}
}  // namespace
}  // namespace reflet::test::shadow_test
