// Glass on paths through the scene (trace_scene.enabled), against the path tracer on the CPU: what lies
// behind total reflection, volumes in one another, dispersion, rough boundaries, sheets, and glass in mirrors.
#include "compare/compare.h"
#include "pass/harness.h"
#include "reference/reference.h"
#include "renderer/presets.h"

#include <array>
#include <cmath>
#include <cstdio>

namespace reflet::test::glass_paths_test {
namespace {

using builtin::at;
using builtin::turned;

Material glass(float thickness, float ior, float roughness = 0.0F, const vec3& color = vec3(1.0F)) {
    Material m;
    m.baseColor = vec4(color, 1.0F);
    m.metallic = 0.0F;
    m.roughness = roughness;
    m.ior = ior;
    m.doubleSided = thickness == 0.0F;
    m.transmission.factor = 1.0F;
    m.transmission.thickness = thickness;
    return m;
}

Material tinted(Material m, const vec3& color) {
    m.transmission.attenuationColor = color;
    m.transmission.attenuationDistance = 1.0F;
    return m;
}

void add(Scene& scene, const Material& material, Mesh mesh, const mat4& objectToWorld = mat4(1.0F)) {
    const std::string name = std::to_string(scene.instances.size());
    builtin::place(scene, name, builtin::addMaterial(scene, material), std::move(mesh), objectToWorld);
}

// Upright tiles two metres behind, of different colours, that shine.
void addTiles(Scene& scene) {
    for (int i = 0; i < 96; ++i) {
        Material m;
        m.baseColor = vec4(0, 0, 0, 1);
        m.metallic = 0.0F;
        m.emissive = vec3(i % 3 == 0 ? 1.0F : 0.1F, i % 2 == 0 ? 0.8F : 0.2F, i % 5 == 0 ? 1.0F : 0.15F);
        m.doubleSided = true;
        const float x = -6.0F + static_cast<float>(i % 12) * 1.07F;
        const float y = -3.5F + static_cast<float>(i / 12) * 0.97F;
        add(scene, m, builtin::patch({.right = {0.53F, 0, 0}, .up = {0, 0.48F, 0}}), at({x, y, -2}));
    }
}

constexpr uvec2 size(64, 32);
constexpr unsigned columns = 4;
constexpr unsigned cell = 16;  // pixels

struct Case {
    const char* name;
    void (*add)(Scene&, const mat4& place);
    double most;  // relative MSE of the paths, which is noise
};

void totalReflection(Scene& scene, const mat4& place) {
    add(scene, tinted(glass(1.0F, 1.5F), {0.9F, 0.4F, 0.2F}), builtin::box({0.8F, 0.6F, 0.6F}), place * turned(30));
}

void volumesInOneAnother(Scene& scene, const mat4& place) {
    add(scene, glass(1.0F, 1.5F), builtin::sphere(0.9F, 48), place);
    add(scene, tinted(glass(1.0F, 1.33F), {0.9F, 0.2F, 0.3F}), builtin::sphere(0.7F, 48), place);
}

void dispersion(Scene& scene, const mat4& place) {
    Material flint = glass(1.0F, 1.7F);
    flint.transmission.dispersion = 10.0F;
    add(scene, flint, builtin::box({0.8F, 0.8F, 0.4F}), place * turned(50));
}

void roughBoundaries(Scene& scene, const mat4& place) {
    add(scene, glass(1.0F, 1.5F, 0.2F), builtin::sphere(0.9F, 48), place);
}

// Glass of which parts are metal, or white beneath.
void halfGlass(Scene& scene, const mat4& place) {
    Material metal = glass(1.0F, 1.5F, 0.5F, {0.9F, 0.6F, 0.3F});
    metal.metallic = 1.0F;
    add(scene, metal, builtin::sphere(0.5F, 32), place * at({-0.5F, 0.5F, 0}));
    Material white = glass(0.0F, 1.5F);
    white.transmission.factor = 0.3F;
    add(scene, white, builtin::sphere(0.5F, 32), place * at({0.5F, -0.5F, 0}));
}

// More sheets than layers are drawn.
void manySheets(Scene& scene, const mat4& place) {
    for (int i = 0; i < 5; ++i) {
        add(scene, glass(0.0F, 1.5F, i == 4 ? 0.1F : 0.0F, vec3(0.9F, 1.0F, 0.8F)),
            builtin::patch({.right = {1, 0, 0}, .up = {0, 1, 0}}), place * at({0, 0, 0.2F * static_cast<float>(i)}));
    }
}

// Shows the next case.
void mirror(Scene& scene, const mat4& place) {
    Material silver;
    silver.roughness = 0.0F;
    add(scene, silver, builtin::patch({.right = {1, 0, 0}, .up = {0, 1, 0}}), place * turned(45));
}

void ball(Scene& scene, const mat4& place) {
    add(scene, tinted(glass(1.0F, 1.5F), {0.3F, 0.9F, 0.4F}), builtin::sphere(0.8F, 48), place);
}

// By layers that are refracted in screen space (quality) 0.020, 0.20, 0.10, 0.027, 0.012, 0.026, 0.23, 0.019.
constexpr std::array cases{Case{"total reflection", totalReflection, 0.005},
                           Case{"volumes in one another", volumesInOneAnother, 0.01},
                           Case{"dispersion", dispersion, 0.02},
                           Case{"rough boundaries", roughBoundaries, 0.02},
                           Case{"glass that is partly opaque", halfGlass, 0.01},
                           Case{"many sheets", manySheets, 0.02},
                           Case{"a mirror", mirror, 0.005},
                           Case{"a ball", ball, 0.005}};

// Of a case's part of the picture.
double errorOf(unsigned index, const FloatImage& image, const FloatImage& truth) {
    CompareOptions options;
    for (unsigned y = 0; y < size.y; ++y) {
        for (unsigned x = 0; x < size.x; ++x) {
            options.mask.push_back(y / cell * columns + x / cell == index);
        }
    }
    return compareImages(image, truth, options).difference.relativeMse;
}

// Over 5 s: paths are as noisy as the reference's.
TEST(GlassPaths, AreThoseOfTheReference) {
    Scene scene;
    addTiles(scene);
    for (unsigned i = 0; i < cases.size(); ++i) {
        const float x = 2.4F * (static_cast<float>(i % columns) - 1.5F);
        const float y = 2.4F * (0.5F - static_cast<float>(i / columns));
        cases.at(i).add(scene, at({x, y, 0}));
    }
    View view;
    view.camera.position = {0, 0, 9};
    view.camera.fovY = 2.0F * std::atan(2.4F / 9.0F);
    view.environment.radiance = vec3(0.3F, 0.4F, 0.5F);
    ReferenceOptions options;
    options.samples = 256;
    const FloatImage truth = traceReference(scene, view, size, options).final;
    Settings settings;
    applyPreset(settings, "pathtrace");
    const FloatImage paths = render(scene, view, size, settings, {"final"}, 32).images.at("final");
    for (unsigned i = 0; i < cases.size(); ++i) {
        SCOPED_TRACE(cases.at(i).name);
        std::printf("%s: relative MSE %.5f\n", cases.at(i).name, errorOf(i, paths, truth));
        EXPECT_LT(errorOf(i, paths, truth), cases.at(i).most);
    }
    expectSilentValidation("glass paths");
}

// A rough ball before the tiles: one ray a pixel and frame.
TEST(GlassPaths, OfFrostedGlassAreDenoised) {
    Scene scene;
    addTiles(scene);
    add(scene, glass(1.0F, 1.5F, 0.7F), builtin::sphere(1.5F, 48));
    View view;
    view.camera.position = {0, 0, 6};
    view.environment.radiance = vec3(0.3F, 0.4F, 0.5F);
    constexpr uvec2 square(32, 32);
    CompareOptions middle;  // of the ball
    for (unsigned i = 0; i < square.x * square.y; ++i) {
        middle.mask.push_back(std::hypot(static_cast<float>(i % 32) - 15.5F, static_cast<float>(i / 32) - 15.5F) <
                              4.0F);
    }
    const FloatImage truth = traceReference(scene, view, square, {.samples = 256}).final;
    const auto error = [&](const char* denoise) {
        const Settings settings = settingsOf({"trace_scene.enabled=on", "diffuse.rays=0", denoise});
        const FloatImage picture = render(scene, view, square, settings, {"final"}).images.at("final");
        return compareImages(picture, truth, middle).difference.relativeMse;
    };
    const double noisy = error("denoise.enabled=off");
    const double clean = error("denoise.enabled=on");
    std::printf("frosted: relative MSE %.5f, denoised %.5f\n", noisy, clean);
    EXPECT_LT(clean, 0.6 * noisy);
}

// The mean of a picture that these fill, before a wall of radiance 1.
vec3 meanBefore(void (*fill)(Scene&, const Mesh&)) {
    Scene scene;
    Material wall;
    wall.baseColor = vec4(0, 0, 0, 1);
    wall.emissive = vec3(1.0F);
    wall.metallic = 0.0F;
    wall.specular = 0.0F;
    const Mesh square = builtin::patch({.right = {9, 0, 0}, .up = {0, 9, 0}});
    add(scene, wall, square, at({0, 0, -2}));
    fill(scene, square);
    View view;
    view.camera.position = {0, 0, 5};
    const Settings settings = settingsOf(
        {"trace_scene.enabled=on", "diffuse.rays=0", "specular.rays=0", "temporal.enabled=on", "temporal.scale=1"});
    constexpr unsigned side = 24;
    const Pictures p = render(scene, view, uvec2(side), settings, {"final"}, 16);
    vec3 sum(0.0F);
    for (unsigned i = 0; i < side * side; ++i) {
        sum += p.color("final", i % side, i / side);
    }
    return sum / static_cast<float>(side * side);
}

// A black pane that covers half of what is behind it, behind a sheet of glass that does nothing.
TEST(GlassPaths, MeetBlendedSurfacesOnce) {
    const vec3 mean = meanBefore([](Scene& scene, const Mesh& square) {
        Material black;
        black.baseColor = vec4(0, 0, 0, 0.5F);
        black.blended = true;
        black.alphaCutoff = blendCutoff;
        black.metallic = 0.0F;
        black.specular = 0.0F;
        add(scene, black, square, at({0, 0, -1}));
        add(scene, glass(0.0F, 1.0F), square);
    });
    EXPECT_NEAR(mean.g, 0.5F, 0.03F) << "a quarter if twice";
}

// Green glass of which half is there.
TEST(GlassPaths, OfBlendedGlassAreSeenAsFarAsItCovers) {
    const vec3 mean = meanBefore([](Scene& scene, const Mesh& square) {
        Material half = glass(0.0F, 1.0F, 0.0F, {0, 1, 0});
        half.baseColor.a = 0.5F;
        half.blended = true;
        half.alphaCutoff = blendCutoff;
        add(scene, half, square);
    });
    EXPECT_NEAR(mean.r, 0.5F, 0.02F);
    EXPECT_NEAR(mean.g, 1.0F, 0.02F);
}

}  // namespace
}  // namespace reflet::test::glass_paths_test
