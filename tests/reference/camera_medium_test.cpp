// A camera inside glass or water, against closed forms.
#include "reference/harness.h"

#include <cmath>

namespace reflet::test::camera_medium_test {
namespace {

const vec3 attenuation(0.5F, 0.25F, 0.9F);  // after a metre

Material water(float ior, const vec3& color = attenuation) {
    Material m = lambertMaterial(vec3(1.0F));
    m.roughness = 0.0F;
    m.ior = ior;
    m.transmission.factor = 1.0F;
    m.transmission.thickness = 1.0F;
    m.transmission.attenuationColor = color;
    m.transmission.attenuationDistance = 1.0F;
    return m;
}

// Without it, light that the surface reflects would find a way out elsewhere.
Material blackGround() {
    Material m = lambertMaterial(vec3(0.0F));
    m.specular = 0.0F;
    return m;
}

vec3 after(double metres) {
    return glm::pow(glm::dvec3(attenuation), glm::dvec3(metres));
}

vec3 seenIn(const Scene& scene, const View& view, uint32_t samples) {
    return mean(traceReference(scene, view, {4, 4}, {.samples = samples}).final);
}

void expectNear(const vec3& got, const vec3& expected, float tolerance, const std::string& what) {
    for (int c = 0; c < 3; ++c) {
        EXPECT_NEAR(got[c], expected[c], tolerance) << what << ", channel " << c;
    }
}

// An emitter in the same water as the camera: Beer's law is all there is, whatever the index of refraction.
TEST(CameraMedium, WhatIsInTheSameWaterIsAttenuatedByItsDistance) {
    for (const float ior : {1.0F, 1.33F}) {
        for (const Mesh& shape : {builtin::sphere(4.0F, 48), builtin::box({4, 4, 4})}) {
            Scene scene;
            add(scene, water(ior), shape);
            add(scene, lambertMaterial(vec3(0.0F), vec3(1.0F)), square({0, 0, -1.5F}, {0, 0, 1}, 1.0F));
            View view = darkView({0, 0, 0.5F}, {0, 0, -1}, 1.0F);
            expectNear(seenIn(scene, view, 16), after(2.0), 1e-3F, std::to_string(ior));
            view.camera.position.z = 6.0F;  // outside: 5.5 metres of it, without the reflection at the front
            const vec3 outside = seenIn(scene, view, 1024);
            if (ior == 1.0F) {
                expectNear(outside, after(5.5), 1e-3F, "from outside");
            }
        }
    }
}

// Out of a block along its axis, toward a sky of 1: what Fresnel lets out at each end after each passage.
TEST(CameraMedium, WhatIsOutsideIsSeenThroughTheBoundary) {
    for (const float ior : {1.0F, 1.33F, 1.8F}) {
        Scene scene;
        add(scene, water(ior), builtin::box({5, 5, 1}));
        View view = darkView({0, 0, 0.25F}, {0, 0, -1}, 0.5F);
        view.environment.radiance = vec3(1.0F);
        const double r = std::pow((ior - 1.0) / (ior + 1.0), 2.0);
        vec3 expected(0.0F);
        for (int k = 0; k < 6; ++k) {
            expected += static_cast<float>((1.0 - r) * std::pow(r, k)) * after(1.25 + 2.0 * k);
        }
        expectNear(seenIn(scene, view, 4096), expected, 2e-3F, std::to_string(ior));
    }
}

TEST(CameraMedium, AClearOneInAWhiteEnvironmentIsInvisible) {
    for (const float roughness : {0.0F, 0.3F}) {
        Scene scene;
        Material clear = water(1.5F, vec3(1.0F));
        clear.roughness = roughness;
        add(scene, clear, builtin::sphere(1.0F, 64));
        View view = darkView({0.5F, 0, 0}, {0, 0, -1}, 60.0F);
        view.environment.radiance = vec3(1.0F);
        expectNear(mean(traceReference(scene, view, {8, 8}, {.samples = 256}).final), vec3(1.0F), 0.01F,
                   std::to_string(roughness));
    }
}

// Looking up from under water: all that is above is within the critical angle, and beyond it is the dark ground.
TEST(CameraMedium, SnellsWindowEndsAtTheCriticalAngle) {
    for (const float ior : {1.33F, 1.6F}) {
        Scene scene;
        add(scene, water(ior, vec3(1.0F)), builtin::box({200, 5, 200}), builtin::at({0, -5, 0}));
        add(scene, lambertMaterial(vec3(0.0F), vec3(1.0F)), square({0, 1, 0}, {0, -1, 0}, 5000.0F));
        add(scene, blackGround(), square({0, -4, 0}, {0, 1, 0}, 190.0F));
        const View view = darkView({0, -2, 0}, {0, 0, 0}, 120.0F);
        constexpr uint32_t side = 64;
        const FloatImage p = traceReference(scene, view, {side, side}, {.samples = 16}).final;
        const double sine = 1.0 / ior;
        const double radius = sine / std::sqrt(1.0 - sine * sine) / std::tan(glm::radians(60.0));  // half pictures
        uint32_t bright = 0;
        for (uint32_t y = 0; y < side; ++y) {
            for (uint32_t x = 0; x < side; ++x) {
                const double at = glm::length((glm::dvec2(x, y) + 0.5) / (0.5 * side) - 1.0);
                const float value = pixel(p, x, y);
                bright += value > 0.3F ? 1 : 0;
                if (at > radius + 0.05) {
                    EXPECT_EQ(value, 0.0F) << ior << ": " << x << ", " << y;
                }
            }
        }
        const float lit = pixel(p, side / 2, side / 2);
        EXPECT_NEAR(lit, 1.0 - std::pow((ior - 1.0) / (ior + 1.0), 2.0), 0.05) << ior;
        EXPECT_NEAR(bright / double(side * side), 0.25 * glm::pi<double>() * radius * radius, 0.02) << ior;
    }
}

// Air, as a volume of index 1 without attenuation, in water: two metres of air, then one of water.
TEST(CameraMedium, OfNestedVolumesTheInnermostCounts) {
    for (const bool waterFirst : {false, true}) {
        Scene scene;
        const auto addWater = [&] { add(scene, water(1.0F), builtin::box({9, 9, 4})); };
        if (waterFirst) {
            addWater();
        }
        add(scene, water(1.0F, vec3(1.0F)), builtin::box({2, 2, 2}));
        if (!waterFirst) {
            addWater();
        }
        add(scene, lambertMaterial(vec3(0.0F), vec3(1.0F)), square({0, 0, -3}, {0, 0, 1}, 3.0F));
        expectNear(seenIn(scene, darkView({0, 0, 0}, {0, 0, -1}, 1.0F), 16), after(1.0), 1e-3F, "bubble");
    }
}

// Blue is bent more than red: at an angle between the critical ones of both, only red leaves.
TEST(CameraMedium, ADispersiveOneHasACriticalAnglePerColour) {
    Scene scene;
    Material prism = water(1.5F, vec3(1.0F));
    prism.transmission.dispersion = 4.0F;  // indices 1.45, 1.5, 1.55
    prism.specular = 0.0F;
    add(scene, prism, builtin::box({200, 5, 200}), builtin::at({0, -5, 0}));
    add(scene, lambertMaterial(vec3(0.0F), vec3(1.0F)), square({0, 1, 0}, {0, -1, 0}, 5000.0F));
    add(scene, blackGround(), square({0, -4, 0}, {0, 1, 0}, 190.0F));
    const auto at = [&](double ior) {  // just beyond the critical angle of that index
        const double angle = std::asin(1.0 / ior) + glm::radians(0.3);
        const vec3 eye(0, -2, 0);
        return seenIn(scene, darkView(eye, eye + vec3(std::sin(angle), std::cos(angle), 0), 0.1F), 256);
    };
    const vec3 pastBlue = at(1.55);
    EXPECT_GT(pastBlue.r, 0.3F);
    EXPECT_GT(pastBlue.g, 0.3F);
    EXPECT_EQ(pastBlue.b, 0.0F);
    const vec3 pastGreen = at(1.5);
    EXPECT_GT(pastGreen.r, 0.3F);
    EXPECT_EQ(pastGreen.g, 0.0F);
    EXPECT_EQ(at(1.45), vec3(0.0F));
}

}  // namespace
}  // namespace reflet::test::camera_medium_test
