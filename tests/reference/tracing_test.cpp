// Properties of the path tracer besides radiometry: results independent of the number of threads and of the sampling
// strategy, camera visibility, layers, interruption.
#include "base/color.h"
#include "reference/bsdf.h"
#include "reference/harness.h"
#include "reference/sampler.h"
#include "scene/builtin.h"
#include "scene/environment.h"

#include <algorithm>
#include <cmath>
#include <set>

namespace reflet::test::tracing_test {
namespace {

Scene builtinScene(std::string_view name) {
    return findBuiltinScene(name)->make();
}

TEST(Picture, IsTheSameToTheBitOnAnyNumberOfThreads) {
    const Scene scene = builtinScene("gloss");
    ReferenceOptions options;
    options.samples = 8;
    options.threads = 1;
    const ReferencePicture one = traceReference(scene, defaultView(scene), {70, 40}, options);
    options.threads = 3;
    const ReferencePicture three = traceReference(scene, defaultView(scene), {70, 40}, options);
    const auto layers = three.layers();
    for (size_t i = 0; i < layers.size(); ++i) {
        EXPECT_EQ(one.layers()[i].image.data, layers[i].image.data) << layers[i].name;
    }
    EXPECT_EQ(one.rays, three.rays);
    EXPECT_EQ(one.noise, three.noise);
}

TEST(Picture, HasOtherNoiseForAnotherSeed) {
    const Scene scene = builtinScene("cornell");
    ReferenceOptions options;
    options.samples = 2;
    const ReferencePicture a = traceReference(scene, defaultView(scene), {32, 18}, options);
    options.seed = 1;
    EXPECT_NE(a.final.data, traceReference(scene, defaultView(scene), {32, 18}, options).final.data);
}

TEST(Picture, OfUniformAndOfCosineSamplingIsTheSame) {
    const Scene scene = builtinScene("cornell");
    ReferenceOptions options;
    options.samples = 1024;
    options.bounces = 3;
    options.lambertOnly = true;
    const ReferencePicture cosine = traceReference(scene, defaultView(scene), {16, 9}, options);
    options.diffuse = DiffuseSampling::uniform;
    options.samples = 2048;
    const ReferencePicture uniform = traceReference(scene, defaultView(scene), {16, 9}, options);
    for (int i = 0; i < 3; ++i) {
        const float expected = mean(cosine.indirectDiffuse)[i];
        EXPECT_NEAR(mean(uniform.indirectDiffuse)[i], expected, 0.01F * expected);
    }
}

TEST(Picture, LayersAddUpAndAreNamedAsTheRenderersAre) {
    const Scene scene = builtinScene("gloss");
    ReferenceOptions options;
    options.samples = 2;
    const ReferencePicture p = traceReference(scene, defaultView(scene), {32, 18}, options);
    for (size_t i = 0; i < p.final.data.size(); ++i) {
        ASSERT_EQ(p.final.data[i], p.direct.data[i] + p.indirectDiffuse.data[i] + p.indirectSpecular.data[i]);
    }
    std::vector<std::string> names;
    std::ranges::transform(p.layers(), std::back_inserter(names), &ImageLayer::name);
    EXPECT_EQ(names, (std::vector<std::string>{"", "final", "direct", "indirect_diffuse", "indirect_specular", "albedo",
                                               "normal", "depth", "sun_visibility"}));
}

TEST(Picture, EndsEarlyWhenTheNoiseIsLowEnough) {
    const Scene scene = builtinScene("cornell");
    ReferenceOptions options;
    options.bounces = 1;
    options.samples = 4096;
    options.noise = 0.1F;
    const ReferencePicture p = traceReference(scene, defaultView(scene), {32, 18}, options);
    EXPECT_LT(p.noise, 0.1);
    EXPECT_LT(p.samples, 1000U);
    EXPECT_TRUE(p.complete);
}

TEST(Picture, NoiseIsTheErrorThatAnotherRunHas) {
    const Scene scene = builtinScene("cornell");
    ReferenceOptions options;
    options.bounces = 1;
    options.samples = 2048;
    const ReferencePicture converged = traceReference(scene, defaultView(scene), {32, 18}, options);
    options.samples = 16;
    options.seed = 7;
    const ReferencePicture p = traceReference(scene, defaultView(scene), {32, 18}, options);
    double sum = 0.0;
    for (uint32_t y = 0; y < 18; ++y) {
        for (uint32_t x = 0; x < 32; ++x) {
            const double t = luminance(color(converged.final, x, y));
            sum += std::pow(luminance(color(p.final, x, y)) - t, 2.0) / (t * t + 0.01);
        }
    }
    const double error = std::sqrt(sum / (32 * 18));
    // Low-discrepancy samples do better than the estimate, which assumes independent ones.
    EXPECT_LT(error, 1.1 * p.noise);
    EXPECT_GT(error, 0.3 * p.noise);
}

TEST(Picture, OfAnInterruptedRunHoldsAtLeastOneSampleOfEveryPixel) {
    const Scene scene = builtinScene("cubes");
    ReferenceOptions options;
    options.samples = 1000;
    const ReferencePicture p =
        traceReference(scene, defaultView(scene), {64, 36}, options, [](const ReferenceProgress&) { return false; });
    EXPECT_FALSE(p.complete);
    EXPECT_EQ(p.samples, 1U);
    EXPECT_TRUE(std::ranges::all_of(p.final.data, [](float v) { return std::isfinite(v); }));
    EXPECT_GT(mean(p.albedo).x, 0.1F);
}

TEST(Picture, ProgressRisesToItsTotal) {
    const Scene scene = builtinScene("cubes");
    ReferenceOptions options;
    options.samples = 5;
    uint64_t last = 0;
    (void)traceReference(scene, defaultView(scene), {40, 20}, options, [&](const ReferenceProgress& p) {
        EXPECT_GT(p.done, last);
        EXPECT_EQ(p.total, 5U * 40U * 20U);
        last = p.done;
        return true;
    });
    EXPECT_EQ(last, 5U * 40U * 20U);
}

TEST(Camera, SeesThroughTheBacksOfSingleSidedSurfacesButLightDoesNot) {
    Scene scene;
    add(scene, lambertMaterial({1, 0, 0}), square({0, 0, 0}, {0, 1, 0}, 10.0F));
    add(scene, lambertMaterial({0, 1, 0}),
        square({0, 1, 0}, {0, -1, 0}, 5.0F));  // its back faces the camera and the sun
    View view = darkView({0, 3, 0.1F}, {0, 0, 0}, 20.0F);
    view.sun.irradiance = vec3(1.0F);
    const ReferencePicture p = traceReference(scene, view, {4, 4}, lambert(0, 4));
    EXPECT_EQ(mean(p.albedo), vec3(1, 0, 0));
    EXPECT_NEAR(pixel(p.depth, 2, 2), 3.0F, 0.05F);
    EXPECT_EQ(mean(p.sunVisibility).x, 0.0F);
    scene.materials.back().doubleSided = true;
    EXPECT_EQ(mean(traceReference(scene, view, {4, 4}, lambert(0, 4)).albedo), vec3(0, 1, 0));
}

TEST(Camera, SeesMirroredInstancesFromTheirOutside) {
    Scene scene;
    const uint32_t material = builtin::addMaterial(scene, lambertMaterial(vec3(0.5F)));
    builtin::place(scene, "mirrored", material, builtin::box(vec3(1.0F)), glm::scale(mat4(1.0F), vec3(-1, 1, 1)));
    const ReferencePicture p = traceReference(scene, darkView({0, 0, 5}, {0, 0, 0}, 10.0F), {2, 2}, lambert(0, 1));
    EXPECT_NEAR(pixel(p.depth, 0, 0), 4.0F, 1e-3F) << "its near side, not the inside of its far one";
    EXPECT_NEAR(pixel(p.normal, 0, 0, 2), 1.0F, 1e-5F);
}

TEST(Camera, OrthographicAndNearPlaneAreTheViewsOwn) {
    Scene scene;
    add(scene, lambertMaterial({1, 0, 0}), square({0, 0, 0}, {0, 1, 0}, 10.0F));
    add(scene, lambertMaterial({0, 1, 0}), square({0.5F, 2, 0}, {0, 1, 0}, 0.5F));
    View view = darkView({0, 3, 0}, {0, 0, 0});
    view.camera.orthographicHeight = 2.0F;
    const ReferencePicture p = traceReference(scene, view, {4, 2}, lambert(0, 1));
    EXPECT_NEAR(pixel(p.depth, 0, 0), 3.0F, 1e-5F);
    EXPECT_NEAR(pixel(p.depth, 2, 0), 1.0F, 1e-5F);
    view.camera.near = 1.5F;
    EXPECT_NEAR(pixel(traceReference(scene, view, {4, 2}, lambert(0, 1)).depth, 2, 0), 3.0F, 1e-5F);
}

TEST(Materials, CutOutPartsLetLightAndRaysThrough) {
    Scene scene;
    TextureImage half{"half", 2, 1, {255, 255, 255, 255, 255, 255, 255, 0}};
    const TextureSlot slot = builtin::addTexture(scene, half, {.magLinear = false});
    add(scene, lambertMaterial({1, 0, 0}), square({0, 0, 0}, {0, 1, 0}, 10.0F));
    Material cut = lambertMaterial({0, 1, 0});
    cut.doubleSided = true;
    cut.baseColorTexture = slot;
    cut.alphaCutoff = 0.5F;
    // Left half opaque, right half open.
    add(scene, cut, builtin::patch({{0, 1, 0}, {1, 0, 0}, {0, 0, -1}, {1, 1}, {1, 1}}));
    View view = darkView({0, 3, 0}, {0, 0, 0});
    view.camera.orthographicHeight = 1.0F;
    view.sun.irradiance = vec3(1.0F);
    const ReferencePicture p = traceReference(scene, view, {4, 2}, lambert(0, 4));
    EXPECT_EQ(color(p.albedo, 0, 0), vec3(0, 1, 0));
    EXPECT_EQ(color(p.albedo, 3, 0), vec3(1, 0, 0));
    EXPECT_EQ(pixel(p.sunVisibility, 3, 0), 1.0F);
    scene.materials.back().alphaCutoff = 0.0F;
    EXPECT_EQ(color(traceReference(scene, view, {4, 2}, lambert(0, 4)).albedo, 3, 0), vec3(0, 1, 0));
}

// A floor lit by an emissive wall that is off-screen.
TEST(VisibleOnly, LeavesOutLightOfWhatIsOffScreen) {
    Scene scene;
    add(scene, lambertMaterial(vec3(0.5F)), square({0, 0, 0}, {0, 1, 0}, 10.0F));
    add(scene, lambertMaterial(vec3(0.5F), vec3(1.0F)), square({2, 1, 0}, {-1, 0, 0}, 1.0F));
    ReferenceOptions options = lambert(2, 64);
    View view = darkView({0, 3, 0}, {0, 0, 0}, 20.0F);
    EXPECT_GT(mean(traceReference(scene, view, {8, 8}, options).final).x, 0.01F);
    options.visibleOnly = true;
    EXPECT_EQ(mean(traceReference(scene, view, {8, 8}, options).final).x, 0.0F);
}

// All of a corner is visible without occlusion: no light is missing.
TEST(VisibleOnly, ChangesNothingIfEverythingIsVisible) {
    Scene scene;
    add(scene, lambertMaterial(vec3(0.5F)), square({0, 0, 0}, {0, 1, 0}, 1.0F));
    add(scene, lambertMaterial(vec3(0.5F), vec3(1.0F)), square({-1, 1, 0}, {1, 0, 0}, 1.0F));
    const View view = darkView({8, 6, 0}, {0, 0.7F, 0}, 40.0F);
    ReferenceOptions options = lambert(3, 256);
    const ReferencePicture all = traceReference(scene, view, {24, 24}, options);
    options.visibleOnly = true;
    const ReferencePicture visible = traceReference(scene, view, {24, 24}, options);
    EXPECT_GT(mean(all.indirectDiffuse).x, 0.005F);
    EXPECT_EQ(all.indirectDiffuse.data, visible.indirectDiffuse.data);
}

TEST(VisibleOnly, LeavesOutTheSideOfAThingThatTheCameraDoesNotSee) {
    Scene scene;
    add(scene, lambertMaterial(vec3(0.5F)), square({0, 0, 0}, {0, 1, 0}, 3.0F));
    Material screen = lambertMaterial(vec3(0.5F), vec3(1.0F));
    screen.doubleSided = true;
    add(scene, screen, square({0, 1, 0}, {0, 0, 1}, 1.0F));  // stands in the middle, emits on both sides
    const View view = darkView({0, 5, 8}, {0, 0.5F, 0}, 60.0F);
    ReferenceOptions options = lambert(1, 64);
    const ReferencePicture all = traceReference(scene, view, {32, 32}, options);
    options.visibleOnly = true;
    const ReferencePicture visible = traceReference(scene, view, {32, 32}, options);
    unsigned before = 0;
    unsigned behind = 0;
    for (uint32_t y = 0; y < 32; ++y) {
        for (uint32_t x = 0; x < 32; ++x) {
            const float depth = pixel(all.depth, x, y);
            const bool floor = pixel(all.normal, x, y, 1) > 0.9F;
            const float whole = pixel(all.indirectDiffuse, x, y);
            if (floor && depth > 0.0F && depth < 8.5F && whole > 0.01F) {
                EXPECT_NEAR(pixel(visible.indirectDiffuse, x, y), whole, 1e-6F);
                ++before;
            }
            if (floor && depth > 10.2F && whole > 0.01F) {
                EXPECT_EQ(pixel(visible.indirectDiffuse, x, y), 0.0F) << x << ", " << y;
                ++behind;
            }
        }
    }
    EXPECT_GT(before, 20U);
    EXPECT_GT(behind, 10U);
}

// A sky with one small bright region; the expected irradiance is the sum over its texels.
TEST(EnvironmentImage, LightsAsItsTexelsDoWhereverItIsTurned) {
    auto image = std::make_shared<FloatImage>(FloatImage{32, 16, {"R", "G", "B"}, std::vector<float>(1536, 0.1F)});
    constexpr size_t bright = 3 * (3 * 32 + 5);  // row 3, column 5
    for (size_t i = 0; i < 3; ++i) {
        image->data[bright + i] = 200.0F * static_cast<float>(i + 1);
    }
    Scene scene;
    add(scene, lambertMaterial(vec3(0.5F)), square({0, 0, 0}, {0, 1, 0}, 100.0F));
    View view = darkView({0, 0.5F, 0}, {0, 0, 0}, 2.0F);
    view.environment.image = image;
    view.environment.intensity = 2.0F;
    for (const float degrees : {0.0F, 100.0F}) {
        view.environment.rotation = glm::radians(degrees);
        glm::dvec3 irradiance(0.0);
        constexpr int steps = 2000;
        for (int row = 0; row < steps; ++row) {
            const double z = (row + 0.5) / steps;  // uniform in the hemisphere
            for (int column = 0; column < 320; ++column) {
                const double phi = 2.0 * glm::pi<double>() * (column + 0.5) / 320;
                const double r = std::sqrt(1.0 - z * z);
                const vec3 direction(r * std::cos(phi), z, r * std::sin(phi));
                irradiance += glm::dvec3(radianceFrom(view.environment, direction)) * z;
            }
        }
        irradiance *= 2.0 * glm::pi<double>() / (steps * 320.0);
        const ReferencePicture p = traceReference(scene, view, {4, 4}, lambert(1, 1024));
        for (int i = 0; i < 3; ++i) {
            const double expected = 0.5 / glm::pi<double>() * irradiance[i];
            EXPECT_NEAR(mean(p.indirectDiffuse)[i], expected, 0.01 * expected) << degrees;
        }
        EXPECT_LT(p.noise, 0.02) << "importance sampled";
    }
}

TEST(EnvironmentImage, OfOneColourIsTheConstantEnvironment) {
    Scene scene;
    Material material = lambertMaterial(vec3(0.5F));
    material.roughness = 0.3F;
    add(scene, material, builtin::sphere(1.0F, 64));
    View view = darkView({0, 0, 4}, {0, 0, 0}, 30.0F);
    view.environment.radiance = {0.5F, 1, 2};
    ReferenceOptions options;
    options.samples = 256;
    const ReferencePicture constant = traceReference(scene, view, {16, 16}, options);
    auto image = std::make_shared<FloatImage>(FloatImage{8, 4, {"R", "G", "B"}, {}});
    for (int i = 0; i < 32; ++i) {
        image->data.insert(image->data.end(), {0.25F, 0.5F, 1.0F});
    }
    view.environment.image = image;
    view.environment.intensity = 2.0F;
    const ReferencePicture drawn = traceReference(scene, view, {16, 16}, options);
    EXPECT_EQ(color(drawn.final, 0, 0), vec3(0.5F, 1, 2)) << "the background";
    for (int i = 0; i < 3; ++i) {
        EXPECT_NEAR(mean(drawn.final)[i], mean(constant.final)[i], 0.005F * mean(constant.final)[i]);
    }
}

SurfacePoint glossyPoint(float roughness, float degrees) {
    SurfacePoint point;
    point.normal = point.geometricNormal = glm::normalize(vec3(0.3F, 1, -0.2F));
    const mat3 frame = frameAround(point.normal);
    const float angle = glm::radians(degrees);
    point.toOrigin = frame * vec3(std::sin(angle), 0, std::cos(angle));
    point.baseColor = {0.8F, 0.5F, 0.2F};
    point.roughness = roughness;
    point.metallic = 0.3F;
    return point;
}

// The integral of the pdf over the hemisphere, and that of BRDF · cosine by sampled and by regular directions.
TEST(Bsdf, SamplesFollowItsPdfAndItIsReciprocal) {
    for (const float roughness : {0.2F, 0.5F, 1.0F}) {
        for (const float degrees : {5.0F, 50.0F, 75.0F}) {
            const SurfacePoint point = glossyPoint(roughness, degrees);
            const Bsdf bsdf(point, {});
            const mat3 frame = frameAround(point.normal);
            double density = 0.0;
            glm::dvec3 regular(0.0);
            constexpr int steps = 600;
            for (int i = 0; i < steps; ++i) {
                for (int j = 0; j < steps; ++j) {
                    const double z = (i + 0.5) / steps;
                    const double phi = 2.0 * glm::pi<double>() * (j + 0.5) / steps;
                    const double r = std::sqrt(1.0 - z * z);
                    const vec3 l = frame * vec3(r * std::cos(phi), r * std::sin(phi), z);
                    density += bsdf.pdf(l);
                    regular += glm::dvec3(bsdf.reflect(l).sum());
                }
            }
            const double cell = 2.0 * glm::pi<double>() / (steps * steps);
            glm::dvec3 drawn(0.0);
            constexpr uint32_t draws = 1U << 16U;
            for (uint32_t i = 0; i < draws; ++i) {
                const PixelSampler random(0, 0, i);
                drawn += glm::dvec3(bsdf.scatter(random.pair(0).x, random.pair(1)).weight.sum());
            }
            drawn /= draws;
            EXPECT_LE(density * cell, 1.0 + 5e-3) << roughness << ", " << degrees;  // the rest goes below the surface
            EXPECT_GT(density * cell, 0.85) << roughness << ", " << degrees;
            for (int i = 0; i < 3; ++i) {
                EXPECT_NEAR(drawn[i], regular[i] * cell, 4e-3) << roughness << ", " << degrees;
            }
        }
    }
}

TEST(PixelSampler, EveryPairIsANetInBaseTwo) {
    for (const uint32_t pair : {0U, 1U, 7U, 100U}) {
        std::vector<vec2> points;
        for (uint32_t i = 0; i < 256; ++i) {
            points.push_back(PixelSampler(123, 4, i).pair(pair));
        }
        // Of 256 points, each elementary interval of area 1/256 holds exactly one, whatever its shape.
        for (int bits = 0; bits <= 8; ++bits) {
            std::set<std::pair<int, int>> boxes;
            for (const vec2& p : points) {
                boxes.emplace(static_cast<int>(p.x * static_cast<float>(1 << bits)),
                              static_cast<int>(p.y * static_cast<float>(1 << (8 - bits))));
            }
            EXPECT_EQ(boxes.size(), 256U) << pair << ", " << bits;
        }
    }
}

TEST(PixelSampler, PairsAreNotCorrelatedWithOneAnother) {
    constexpr uint32_t count = 4096;
    for (const uint32_t pair : {1U, 2U, 5U}) {
        double product = 0.0;
        for (uint32_t i = 0; i < count; ++i) {
            const PixelSampler random(9, 0, i);
            product += (random.pair(0).x - 0.5) * (random.pair(pair).x - 0.5);
        }
        EXPECT_NEAR(product / count * 12.0, 0.0, 0.06) << pair;
    }
}

}  // namespace
}  // namespace reflet::test::tracing_test
