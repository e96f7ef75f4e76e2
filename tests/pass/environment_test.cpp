// Environment images: background, rays and split sum against the scene's own look-up and the path tracer.
#include "scene/environment.h"
#include "compare/compare.h"
#include "pass/harness.h"
#include "reference/reference.h"

#include <cmath>
#include <functional>
#include <memory>

namespace reflet::test::environment_test {
namespace {

constexpr uvec2 size(96, 96);
constexpr float degree = glm::pi<float>() / 180.0F;

const std::vector<std::string> splitSum{"trace_screen.enabled=false", "specular.max_roughness=0",
                                        "specular.rough_fallback=mips", "diffuse.distribution=normal",
                                        "diffuse.rays=1"};

Environment environmentOf(uvec2 texels, const std::function<vec3(const vec3& direction)>& light) {
    FloatImage image{texels.x, texels.y, {"R", "G", "B"}, {}};
    for (uint32_t row = 0; row < texels.y; ++row) {
        for (uint32_t column = 0; column < texels.x; ++column) {
            const vec3 color = light(environmentDirection((vec2(column, row) + 0.5F) / vec2(texels), 0.0F));
            image.data.insert(image.data.end(), {color.x, color.y, color.z});
        }
    }
    Environment environment;
    environment.image = std::make_shared<FloatImage>(std::move(image));
    return environment;
}

const vec3 toSpot = glm::normalize(vec3(0.5F, 0.6F, 0.6F));

/// Bluer toward the top, brown below, with a bright spot of 6 degrees.
vec3 skyLight(const vec3& d) {
    if (glm::dot(d, toSpot) > std::cos(6.0F * degree)) {
        return {60.0F, 55.0F, 45.0F};
    }
    return d.y > 0.0F ? mix(vec3(0.9F, 0.8F, 0.7F), vec3(0.2F, 0.4F, 0.9F), d.y) : vec3(0.25F, 0.18F, 0.1F);
}

View viewOf(const Environment& environment, const vec3& position = {0, 0, 2.6F}) {
    View view;
    view.camera.position = position;
    view.environment = environment;
    return view;
}

Scene sphereOf(float roughness, float metallic, const vec3& color = vec3(1.0F)) {
    Material material = lambertMaterial(color);
    material.roughness = roughness;
    material.metallic = metallic;
    return sceneOf(material, builtin::sphere(1.0F, 64));
}

std::vector<bool> surfaces(const Pictures& p) {
    std::vector<bool> mask;
    for (const float depth : p.images.at("depth").data) {
        mask.push_back(depth > 0.0F);
    }
    return mask;
}

ReferencePicture trueOneBounce(const Scene& scene, const View& view, uint32_t samples) {
    ReferenceOptions options;
    options.filter = PixelFilter::center;
    options.samples = samples;
    options.bounces = 1;
    return traceReference(scene, view, size, options);
}

// The background against the scene's own look-up. Half floats and texel borders: within a rounding of another texel,
// either is accepted.
void expectBackground(const View& view, const std::function<vec3(unsigned x, unsigned y)>& direction) {
    const Scene scene = sceneOf(lambertMaterial(vec3(1.0F)), builtin::sphere(1e-3F, 6));
    const Pictures p =
        render(scene, view, size, settingsOf({"diffuse.rays=0", "specular.rays=0"}), {"direct", "depth"});
    unsigned wrong = 0;
    for (unsigned y = 0; y < size.y; ++y) {
        for (unsigned x = 0; x < size.x; ++x) {
            if (!p.hasSurface(x, y)) {
                const vec3 expected = radianceFrom(view.environment, direction(x, y));
                wrong += glm::length(p.color("direct", x, y) - expected) > 1e-3F * glm::length(expected) ? 1 : 0;
            }
        }
    }
    EXPECT_LE(wrong, size.x * size.y / 1000);
    expectSilentValidation("the background");
}

/// Every texel has a colour of its own.
Environment coloredTexels(uvec2 texels) {
    return environmentOf(texels, [](const vec3& d) { return 1.0F + d * vec3(0.9F, 0.7F, 0.8F); });
}

TEST(EnvironmentImage, TheBackgroundIsTheImagesTexelInEveryDirection) {
    View view =
        viewOf(coloredTexels({22, 11}), {1000.0F, -300.0F, 2000.0F});  // far off: a small scene's rounding shows
    view.environment.intensity = 3.0F;
    view.camera.fovY = 100.0F * degree;
    const vec3 ahead[] = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}, {0.4F, 0.5F, -0.3F}};
    for (const vec3& d : ahead) {
        for (const float rotation : {0.0F, 40.0F, -200.0F}) {
            view.environment.rotation = rotation * degree;
            view.camera.target = view.camera.position + 1000.0F * d;
            view.camera.up = std::abs(d.y) == 1.0F ? vec3(0, 0, 1) : vec3(0, 1, 0);
            expectBackground(view, [&](unsigned x, unsigned y) { return pixelDirection(view.camera, size, x, y); });
        }
    }
}

TEST(EnvironmentImage, AnOrthographicCameraSeesOneTexelEverywhere) {
    View view = viewOf(coloredTexels({22, 11}), {3, 2, 1});
    view.camera.orthographicHeight = 4.0F;
    const vec3 ahead = glm::normalize(view.camera.target - view.camera.position);
    expectBackground(view, [&](unsigned, unsigned) { return ahead; });
}

TEST(EnvironmentImage, AMirrorShowsEachOfSixColoredDirectionsWhereTheReferenceDoes) {
    const vec3 axes[] = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
    const vec3 colors[] = {{4, 0, 0}, {0, 4, 4}, {0, 4, 0}, {4, 0, 4}, {0, 0, 4}, {4, 4, 0}};
    const Environment environment = environmentOf({128, 64}, [&](const vec3& d) {
        for (size_t i = 0; i < 6; ++i) {
            if (glm::dot(d, axes[i]) > 0.9F) {
                return colors[i];
            }
        }
        return vec3(0.5F);
    });
    View view = viewOf(environment);
    view.environment.rotation = 25.0F * degree;
    const Scene scene = sphereOf(0.0F, 1.0F);
    const ReferencePicture truth = trueOneBounce(scene, view, 1);
    for (const auto& assignments : {std::vector<std::string>{}, splitSum}) {
        const Pictures p = render(scene, view, size, settingsOf(assignments), {"indirect_specular", "depth"});
        unsigned wrong = 0;
        unsigned pixels = 0;
        for (unsigned y = 0; y < size.y; ++y) {
            for (unsigned x = 0; x < size.x; ++x) {
                const float* t = &truth.indirectSpecular.data[3 * (size_t(y) * size.x + x)];
                const bool differs = glm::length(p.color("indirect_specular", x, y) - vec3(t[0], t[1], t[2])) > 0.1F;
                wrong += p.hasSurface(x, y) && differs ? 1 : 0;
                pixels += p.hasSurface(x, y) ? 1 : 0;
            }
        }
        EXPECT_GT(pixels, 3000U);
        EXPECT_LT(wrong, pixels / 40) << "besides the colours' edges";
    }
}

// Many rays, and split sum (exact for a constant environment), at every roughness, metal and not.
TEST(EnvironmentImage, TheFurnaceOfAConstantImageStaysWhite) {
    const View view = viewOf(environmentOf({16, 8}, [](const vec3&) { return vec3(1.0F); }));
    std::vector<std::string> rays{"diffuse.rays=1", "specular.rays=64", "trace_screen.enabled=false"};
    for (const float metallic : {0.0F, 1.0F}) {
        for (const float roughness : {0.0F, 0.1F, 0.25F, 0.5F, 0.75F, 1.0F}) {
            const Scene scene = sphereOf(roughness, metallic);
            for (const auto& assignments : {rays, splitSum}) {
                const Pictures p = render(scene, view, size, settingsOf(assignments), {"final", "depth"});
                const CompareOptions options{.mask = surfaces(p)};
                const FloatImage white{
                    size.x, size.y, {"R", "G", "B"}, std::vector<float>(p.images.at("final").data.size(), 1.0F)};
                const Difference d = compareImages(p.images.at("final"), white, options).difference;
                EXPECT_LT(std::abs(d.bias), 0.01) << "roughness " << roughness << ", metallic " << metallic;
                if (assignments == splitSum) {
                    EXPECT_LT(d.max, 0.01) << "roughness " << roughness << ", metallic " << metallic;
                }
            }
        }
    }
    expectSilentValidation("the furnace");
}

struct Bound {
    float roughness;
    double relativeMse;
    double bias;
};

// A convex body: its rays see only the environment. With 256 rays the spot of 6 degrees is noisy: measured relative MSE
// 0.005, 0.010, 0.016, diffuse 0.016.
// Over 5 s: many rays, so that noise does not hide a bias.
TEST(EnvironmentImage, ManyRaysReflectWhatThePathTracerDoes) {
    View view = viewOf(environmentOf({128, 64}, skyLight));
    view.environment.rotation = 70.0F * degree;
    for (const float roughness : {0.1F, 0.4F, 0.8F}) {
        const Scene scene = sphereOf(roughness, 0.5F, {0.9F, 0.7F, 0.4F});
        const ReferencePicture truth = trueOneBounce(scene, view, 64);
        const Pictures p = renderMean(scene, view, size, settingsOf({"diffuse.rays=64", "specular.rays=64"}),
                                      {"indirect_specular", "indirect_diffuse", "depth"}, 4);
        const CompareOptions options{.mask = surfaces(p)};
        const Difference specular =
            compareImages(p.images.at("indirect_specular"), truth.indirectSpecular, options).difference;
        const Difference diffuse =
            compareImages(p.images.at("indirect_diffuse"), truth.indirectDiffuse, options).difference;
        EXPECT_LT(specular.relativeMse, 0.022) << roughness;
        EXPECT_LT(std::abs(specular.bias), 0.01) << roughness;
        EXPECT_LT(diffuse.relativeMse, 0.02) << roughness;
        EXPECT_LT(std::abs(diffuse.bias), 0.01) << roughness;
    }
}

// Measured, including the noise of the reference: relative MSE 0.008, 0.022, 0.013, 0.004; bias 0.004, -0.009, 0.019,
// 0.014; diffuse 0.003 and -0.003.
TEST(EnvironmentImage, SplitSumReflectsNearlyWhatThePathTracerDoes) {
    const View view = viewOf(environmentOf({128, 64}, skyLight));
    for (const auto& [roughness, relativeMse, bias] :
         {Bound{0.1F, 0.012, 0.01}, Bound{0.3F, 0.03, 0.015}, Bound{0.6F, 0.02, 0.025}, Bound{1.0F, 0.006, 0.02}}) {
        const Scene scene = sphereOf(roughness, 1.0F);
        const ReferencePicture truth = trueOneBounce(scene, view, 64);
        const Pictures p = render(scene, view, size, settingsOf(splitSum), {"indirect_specular", "depth"});
        const Difference d =
            compareImages(p.images.at("indirect_specular"), truth.indirectSpecular, {.mask = surfaces(p)}).difference;
        EXPECT_LT(d.relativeMse, relativeMse) << roughness;
        EXPECT_LT(std::abs(d.bias), bias) << roughness;
    }
    const Scene matt = sphereOf(1.0F, 0.0F);
    std::vector<std::string> lambert = splitSum;
    lambert.emplace_back("materials.lambert_only=true");
    ReferenceOptions options;
    options.filter = PixelFilter::center;
    options.samples = 64;
    options.bounces = 1;
    options.lambertOnly = true;
    const ReferencePicture truth = traceReference(matt, view, size, options);
    const Pictures p = render(matt, view, size, settingsOf(lambert), {"indirect_diffuse", "depth"});
    const Difference d =
        compareImages(p.images.at("indirect_diffuse"), truth.indirectDiffuse, {.mask = surfaces(p)}).difference;
    EXPECT_LT(d.relativeMse, 0.01);
    EXPECT_LT(std::abs(d.bias), 0.01);
}

TEST(EnvironmentImage, SplitSumHasNoNoise) {
    const View view = viewOf(environmentOf({128, 64}, skyLight));
    Scene scene = sphereOf(0.4F, 1.0F);
    builtin::place(scene, "box", 0, builtin::box(vec3(0.5F)), builtin::at({-1, 0, 0}));
    const Pictures one = render(scene, view, size, settingsOf(splitSum), {"final"}, 1);
    const Pictures another = render(scene, view, size, settingsOf(splitSum), {"final"}, 4);
    EXPECT_EQ(one.images.at("final").data, another.images.at("final").data);
}

TEST(EnvironmentImage, WhatIsBrighterThanHalfFloatsHoldKeepsItsEnergy) {
    // A spot of 9e6 W/(m² sr) in the dark: as much irradiance as one of 90 with an intensity of 1e5.
    const auto spot = [](float bright) {
        return environmentOf({128, 64},
                             [&](const vec3& d) { return vec3(glm::dot(d, toSpot) > 0.995F ? bright : 0.0F); });
    };
    const Scene scene = sphereOf(1.0F, 0.0F, vec3(0.1F));
    std::vector<std::string> lambert = splitSum;
    lambert.emplace_back("materials.lambert_only=true");
    View view = viewOf(spot(9e6F));
    view.environment.intensity = 1e-2F;
    const Pictures bright = render(scene, view, size, settingsOf(lambert), {"indirect_diffuse"});
    view = viewOf(spot(90.0F));
    view.environment.intensity = 1e3F;
    const Pictures dim = render(scene, view, size, settingsOf(lambert), {"indirect_diffuse"});
    EXPECT_GT(rangeOf(dim.images.at("indirect_diffuse")).max, 50.0F);
    const Difference d =
        compareImages(bright.images.at("indirect_diffuse"), dim.images.at("indirect_diffuse"), {}).difference;
    EXPECT_LT(std::abs(d.bias), 0.002);
}

TEST(EnvironmentImage, SwitchedOffItStaysInTheBackgroundAndLeavesRaysBlack) {
    const View view = viewOf(coloredTexels({22, 11}));
    const Scene scene = sphereOf(0.3F, 0.5F);
    const Pictures p = render(scene, view, size, settingsOf({"environment.enabled=false"}),
                              {"direct", "indirect_diffuse", "indirect_specular"});
    EXPECT_GT(p.value("direct", 0, 0), 0.05F);
    EXPECT_EQ(rangeOf(p.images.at("indirect_diffuse")).max, 0.0F);
    EXPECT_EQ(rangeOf(p.images.at("indirect_specular")).max, 0.0F);
}

TEST(EnvironmentImage, ChangingItFromFrameToFrameShowsTheNewOne) {
    const Scene scene = sphereOf(0.5F, 1.0F);
    const View plain = viewOf({});
    const View image = viewOf(coloredTexels({22, 11}));
    View turned = image;
    turned.environment.rotation = 90.0F * degree;
    turned.environment.intensity = 0.5F;
    const std::vector<std::string> shows{"final"};
    const std::vector<View> path{plain, image, turned, plain, viewOf(environmentOf({32, 16}, skyLight)), image};
    const std::vector<Pictures> pictures = renderPath(scene, path, size, settingsOf(splitSum), shows);
    for (size_t i = 0; i < path.size(); ++i) {
        EXPECT_EQ(pictures[i].images.at("final").data,
                  render(scene, path[i], size, settingsOf(splitSum), shows).images.at("final").data)
            << i;
    }
    expectSilentValidation("another environment");
}

}  // namespace
}  // namespace reflet::test::environment_test
