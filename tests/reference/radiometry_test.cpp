// The path tracer against closed forms.
#include "reference/bsdf.h"
#include "reference/harness.h"
#include "support/ggx_reference.h"

#include <cmath>

namespace reflet::test::radiometry_test {
namespace {

constexpr double pi = glm::pi<double>();

// Sees a patch of about 2 cm of the floor around the origin from above, small enough to be a point.
View pointView() {
    return darkView({0, 0.5F, 0}, {0, 0, 0}, 2.0F);
}

// A closed room of 2 m per side with emissive walls.
Scene glowingRoom(const Material& material) {
    Scene scene;
    for (const vec3& side : {vec3(1, 0, 0), vec3(0, 1, 0), vec3(0, 0, 1)}) {
        add(scene, material, square(side, -side, 1.0F));
        add(scene, material, square(-side, side, 1.0F));
    }
    return scene;
}

TEST(Furnace, AGlowingRoomOfHalfAlbedoIsTwiceAsBrightAsItGlows) {
    const Scene scene = glowingRoom(lambertMaterial(vec3(0.5F), vec3(0.5F)));
    const ReferencePicture p = traceReference(scene, darkView({0.3F, 0.2F, 0.1F}, {-1, -0.4F, -1}), {16, 16},
                                              lambert(ReferenceOptions::unlimited, 256));
    EXPECT_NEAR(mean(p.final).x, 1.0F, 0.003F);
    EXPECT_NEAR(mean(p.direct).x, 0.5F, 1e-6F);
    EXPECT_NEAR(mean(p.indirectSpecular).x, 0.0F, 0.0F);
    EXPECT_LT(p.noise, 0.02);
}

TEST(Furnace, EachBounceInAGlowingRoomAddsItsShare) {
    const Scene scene = glowingRoom(lambertMaterial(vec3(0.5F), vec3(0.5F)));
    float expected = 0.5F;
    float share = 0.5F;
    for (uint32_t bounces = 0; bounces < 4; ++bounces) {
        const ReferencePicture p =
            traceReference(scene, darkView({0.3F, 0.2F, 0.1F}, {-1, -0.4F, -1}), {16, 16}, lambert(bounces, 128));
        EXPECT_NEAR(mean(p.final).x, expected, 0.003F) << bounces;
        share *= 0.5F;
        expected += share;
    }
}

TEST(Furnace, AWhiteThingInAWhiteEnvironmentIsInvisible) {
    for (const float metallic : {0.0F, 0.5F, 1.0F}) {
        for (const float roughness : {0.0F, 0.1F, 0.3F, 0.6F, 1.0F}) {
            Scene scene;
            Material material = lambertMaterial(vec3(1.0F));
            material.metallic = metallic;
            material.roughness = roughness;
            add(scene, material, square({0, 0, 0}, {0, 1, 0}, 10.0F));
            View view = darkView({0, 1, 2}, {0, 0, 0}, 60.0F);  // 16 to 80 degrees from the normal
            view.environment.radiance = vec3(1.0F);
            ReferenceOptions options;
            options.samples = 512;
            const ReferencePicture p = traceReference(scene, view, {8, 8}, options);
            EXPECT_NEAR(mean(p.final).x, 1.0F, 0.006F) << metallic << ", " << roughness;
            for (uint32_t y = 0; y < 8; ++y) {
                EXPECT_NEAR(pixel(p.final, 4, y), 1.0F, 0.06F) << metallic << ", " << roughness << ", " << y;
            }
        }
    }
}

// The base gets what the layer's strongest channel leaves: with a grey layer all light returns, with a tinted one that
// channel's.
TEST(Furnace, AWhiteDielectricOfAnyIorAndSpecularReturnsWhatItsTintDoesNotTake) {
    struct Layer {
        float ior;
        float specular;
        vec3 color;
    };
    for (const Layer& layer :
         {Layer{1.0F, 1.0F, vec3(1)}, Layer{2.4F, 1.0F, vec3(1)}, Layer{0.0F, 1.0F, vec3(1)},
          Layer{1.5F, 0.0F, vec3(1)}, Layer{1.8F, 0.5F, vec3(1)}, Layer{2.4F, 1.0F, {1, 0.3, 0}}}) {
        for (const float roughness : {0.0F, 0.5F}) {
            Scene scene;
            Material material = lambertMaterial(vec3(1.0F));
            material.roughness = roughness;
            material.ior = layer.ior;
            material.specular = layer.specular;
            material.specularColor = layer.color;
            add(scene, material, square({0, 0, 0}, {0, 1, 0}, 10.0F));
            View view = darkView({0, 2, 0}, {0, 0, 0}, 10.0F);  // straight from above
            view.environment.radiance = vec3(1.0F);
            const ReferencePicture p = traceReference(scene, view, {8, 8}, {.samples = 512});
            const vec3 got = mean(p.final);
            const double root = (layer.ior - 1.0) / (layer.ior + 1.0);
            const double alpha = double(roughness) * roughness;
            const double black = test::ggxAlbedo(1.0, std::max(alpha, 1e-3), 0.0);
            const double white = test::ggxAlbedo(1.0, std::max(alpha, 1e-3), 1.0);
            const auto reflected = [&](float tint) {
                const double f0 = layer.specular * std::min(root * root * tint, 1.0);
                return (f0 * (white - black) + layer.specular * black) * (1.0 + f0 * (1.0 / white - 1.0));
            };
            for (int c = 0; c < 3; ++c) {
                EXPECT_NEAR(got[c], 1.0 - reflected(1.0F) + reflected(layer.color[c]), 0.01)
                    << layer.ior << ", " << layer.specular << ", " << roughness;
                EXPECT_NEAR(mean(p.indirectSpecular)[c], reflected(layer.color[c]), 0.01);
            }
        }
    }
}

// Irradiance at the origin, facing up, from a rectangle of radiance 1 parallel to the floor at a height, with one
// corner above the origin. (A catalogue of radiation heat transfer configuration factors, J. Howell, B-3)
double cornerFactor(double a, double b, double height) {
    const double x = a / height;
    const double y = b / height;
    const double sx = std::sqrt(1.0 + x * x);
    const double sy = std::sqrt(1.0 + y * y);
    return (x / sx * std::atan(y / sx) + y / sy * std::atan(x / sy)) / (2.0 * pi);
}

TEST(DirectLight, OfAGlowingRectangleIsItsFormFactor) {
    Scene scene;
    add(scene, lambertMaterial(vec3(0.6F)), square({0, 0, 0}, {0, 1, 0}, 20.0F));
    // x from -0.5 to 1.5, z from -1 to 1, at 2 m.
    add(scene, lambertMaterial(vec3(0.0F), {2, 1, 4}), square({0.5F, 2, 0}, {0, -1, 0}, 1.0F));
    const ReferencePicture p = traceReference(scene, pointView(), {4, 4}, lambert(1, 1024));
    const double factor = 2.0 * (cornerFactor(1.5, 1.0, 2.0) + cornerFactor(0.5, 1.0, 2.0));
    const vec3 expected = vec3(2, 1, 4) * static_cast<float>(0.6 * factor);
    for (int i = 0; i < 3; ++i) {
        EXPECT_NEAR(mean(p.indirectDiffuse)[i], expected[i], 0.003F * expected[i]);
    }
    EXPECT_EQ(mean(p.direct).x, 0.0F) << "light of emissive surfaces takes a bounce";
}

TEST(DirectLight, OfASingleSidedGlowDoesNotLeaveItsBack) {
    Scene scene;
    add(scene, lambertMaterial(vec3(0.6F)), square({0, 0, 0}, {0, 1, 0}, 20.0F));
    Material glow = lambertMaterial(vec3(0.0F), vec3(1.0F));
    add(scene, glow, square({0.5F, 2, 0}, {0, 1, 0}, 1.0F));
    EXPECT_EQ(mean(traceReference(scene, pointView(), {4, 4}, lambert(1, 64)).final).x, 0.0F);
    scene.materials.back().doubleSided = true;
    EXPECT_GT(mean(traceReference(scene, pointView(), {4, 4}, lambert(1, 64)).final).x, 0.05F);
}

TEST(DirectLight, OfASpotIsItsIntensityOverTheSquareOfTheDistance) {
    Scene scene;
    add(scene, lambertMaterial(vec3(0.5F)), square({0, 0, 0}, {0, 1, 0}, 20.0F));
    Lamp lamp;
    lamp.type = Lamp::Type::spot;
    lamp.position = {1, 2, -1};
    lamp.direction = glm::normalize(vec3(-1, -2, 1));
    lamp.intensity = {30, 20, 10};
    lamp.innerAngle = glm::radians(10.0F);
    lamp.outerAngle = glm::radians(30.0F);
    scene.lamps.push_back(lamp);
    const ReferencePicture p = traceReference(scene, pointView(), {4, 4}, lambert(0, 4));
    const double cosine = 2.0 / std::sqrt(6.0);
    EXPECT_NEAR(mean(p.direct).x, 0.5 / pi * 30.0 / 6.0 * cosine, 1e-3);
    EXPECT_NEAR(mean(p.direct).z, 0.5 / pi * 10.0 / 6.0 * cosine, 1e-3);

    scene.lamps.front().direction = glm::normalize(vec3(-1, -2, 1) + vec3(0.8F, 0, 0.8F));
    const double angle =
        std::acos(glm::dot(glm::normalize(glm::dvec3(-0.2, -2, 1.8)), glm::dvec3(-1, -2, 1) / std::sqrt(6.0)));
    const double cone = (std::cos(angle) - std::cos(pi / 6)) / (std::cos(pi / 18) - std::cos(pi / 6));
    ASSERT_GT(cone, 0.1);
    ASSERT_LT(cone, 0.9);
    const ReferencePicture edge = traceReference(scene, pointView(), {4, 4}, lambert(0, 4));
    EXPECT_NEAR(mean(edge.direct).x, mean(p.direct).x * cone * cone, 1e-2 * mean(p.direct).x);
}

TEST(DirectLight, OfSeveralLampsIsTheirSum) {
    Scene scene;
    add(scene, lambertMaterial(vec3(0.5F)), square({0, 0, 0}, {0, 1, 0}, 20.0F));
    double expected = 0.0;
    for (int i = 0; i < 5; ++i) {
        Lamp lamp;
        lamp.position = {static_cast<float>(i) - 2.0F, 1, 0.5F};
        lamp.intensity = vec3(static_cast<float>(1 + i));
        scene.lamps.push_back(lamp);
        const double square = glm::dot(lamp.position, lamp.position);
        expected += 0.5 / pi * (1 + i) / square / std::sqrt(square);
    }
    Lamp moon;
    moon.type = Lamp::Type::directional;
    moon.intensity = vec3(0.7F);
    scene.lamps.push_back(moon);
    expected += 0.5 / pi * 0.7;
    EXPECT_NEAR(mean(traceReference(scene, pointView(), {4, 4}, lambert(0, 1024)).direct).x, expected,
                0.005 * expected);
}

TEST(DirectLight, OfTheSunIsAlbedoOverPiTimesIrradianceTimesCosineWhateverItsSize) {
    Scene scene;
    add(scene, lambertMaterial(vec3(0.5F)), square({0, 0, 0}, {0, 1, 0}, 20.0F));
    View view = pointView();
    view.sun.direction = glm::normalize(vec3(0.5F, -1, 0.2F));
    view.sun.irradiance = {3, 2, 1};
    for (const float degrees : {0.0F, 0.53F, 10.0F, 60.0F}) {
        view.sun.angularDiameter = glm::radians(degrees);
        const ReferencePicture p = traceReference(scene, view, {4, 4}, lambert(0, 256));
        const float expected = 0.5F * 3.0F * -view.sun.direction.y / static_cast<float>(pi);
        EXPECT_NEAR(mean(p.direct).x, expected, 0.002F * expected) << degrees;
        EXPECT_NEAR(mean(p.direct).y, expected * 2 / 3, 0.002F * expected) << degrees;
        EXPECT_EQ(mean(p.sunVisibility).x, 1.0F) << degrees;
    }
}

// Form factor of parallel squares of side 1 at distance 1: 0.19982. (Howell, C-11)
double parallelSquares() {
    return 2.0 / pi *
           (std::log(2.0 / std::sqrt(3.0)) + 2.0 * std::sqrt(2.0) * std::atan(1.0 / std::sqrt(2.0)) - pi / 2.0);
}

TEST(FormFactor, OfTwoParallelSquaresIsWithinHalfAPercent) {
    ASSERT_NEAR(parallelSquares(), 0.19982, 1e-4);
    Scene scene;
    add(scene, lambertMaterial(vec3(1.0F)), square({0, 0, 0}, {0, 1, 0}, 0.5F));
    add(scene, lambertMaterial(vec3(0.0F), vec3(1.0F)), square({0, 1, 0}, {0, -1, 0}, 0.5F));
    // Sees exactly the other square from below the emissive one: its mean radiosity is the form factor.
    View view = darkView({0, 0.9F, 0}, {0, 0, 0});
    view.camera.orthographicHeight = 1.0F;
    const ReferencePicture p = traceReference(scene, view, {32, 32}, lambert(1, 64));
    EXPECT_NEAR(mean(p.indirectDiffuse).x, parallelSquares(), 0.005 * parallelSquares());
}

TEST(GgxAlbedo, EqualsAnIndependentQuadratureAndNeverExceedsOne) {
    for (const float roughness : {0.1F, 0.2F, 0.4F, 0.6F, 0.8F, 1.0F}) {
        for (const float cosine : {0.1F, 0.3F, 0.55F, 0.8F, 1.0F}) {
            const LobeAlbedo table = reflet::ggxAlbedo(cosine, roughness);
            for (const double f0 : {0.04, 1.0}) {
                const double albedo = table.scale * f0 + table.bias;
                EXPECT_LE(albedo, 1.0 + 1e-6);
                EXPECT_NEAR(albedo, test::ggxAlbedo(cosine, double(roughness) * roughness, f0), 0.003)
                    << roughness << ", " << cosine;
            }
        }
    }
}

TEST(GgxAlbedo, IsWhatAPathTracedMetalReflectsOfUniformLight) {
    constexpr double f0 = 0.5;
    for (const float roughness : {0.1F, 0.3F, 0.6F, 1.0F}) {
        for (const float degrees : {0.0F, 60.0F, 80.0F}) {
            Scene scene;
            Material metal = lambertMaterial(vec3(f0));
            metal.metallic = 1.0F;
            metal.roughness = roughness;
            add(scene, metal, square({0, 0, 0}, {0, 1, 0}, 20.0F));
            const float angle = glm::radians(degrees);
            View view = darkView(vec3(std::sin(angle), std::cos(angle), 0), {0, 0, 0}, 0.5F);
            view.environment.radiance = vec3(1.0F);
            ReferenceOptions options;
            options.samples = 4096;
            const float traced = mean(traceReference(scene, view, {4, 4}, options).indirectSpecular).x;
            const double alpha = double(roughness) * roughness;
            const double single = test::ggxAlbedo(std::cos(angle), alpha, f0);
            const double all = test::ggxAlbedo(std::cos(angle), alpha, 1.0);
            EXPECT_NEAR(traced, single * (1.0 + f0 * (1.0 / all - 1.0)), 0.004) << roughness << ", " << degrees;
            EXPECT_LE(traced, 1.0F);
        }
    }
}

}  // namespace
}  // namespace reflet::test::radiometry_test
