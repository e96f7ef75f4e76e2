// Transmissive surfaces: clear glass is invisible, a slab shifts and absorbs what is behind it by the closed forms,
// cost only where there is any, and glass against the path tracer.
#include "compare/compare.h"
#include "pass/harness.h"
#include "reference/reference.h"

#include <cmath>

namespace reflet::test::glass_test {
namespace {

using builtin::at;
using builtin::turned;

constexpr uvec2 size(64, 48);

Material glass(float thickness, float ior, const vec3& color = vec3(1.0F)) {
    Material m;
    m.baseColor = vec4(color, 1.0F);
    m.metallic = 0.0F;
    m.roughness = 0.0F;
    m.ior = ior;
    m.doubleSided = thickness == 0.0F;
    m.transmission.factor = 1.0F;
    m.transmission.thickness = thickness;
    return m;
}

Material glow(const vec3& emissive) {
    Material m;
    m.baseColor = vec4(0, 0, 0, 1);
    m.metallic = 0.0F;
    m.emissive = emissive;
    m.doubleSided = true;
    return m;
}

void add(Scene& scene, const Material& material, Mesh mesh, const mat4& objectToWorld = mat4(1.0F)) {
    const std::string name = std::to_string(scene.instances.size());
    builtin::place(scene, name, builtin::addMaterial(scene, material), std::move(mesh), objectToWorld);
}

Mesh wall(const vec2& halfSize) {
    return builtin::patch({.right = {halfSize.x, 0, 0}, .up = {0, halfSize.y, 0}});
}

// Straight ahead along -Z, without any light.
View darkView() {
    View view;
    view.camera.position = {0, 0, 5};
    return view;
}

// Only emission and refraction: no other light.
const std::vector<std::string> plainLight{"diffuse.rays=0", "specular.rays=0", "trace_screen.thickness=1"};

Pictures seen(const Scene& scene, const View& view, std::vector<std::string> more = {}) {
    more.insert(more.end(), plainLight.begin(), plainLight.end());
    Pictures p = render(scene, view, size, settingsOf(more), {"final", "direct", "indirect_specular"});
    expectSilentValidation("glass");
    return p;
}

// Stripes of different colours.
Scene stripes() {
    Scene scene;
    for (int i = -4; i <= 4; ++i) {
        const vec3 color(0.25F * static_cast<float>(i + 5), 1.0F, i % 2 == 0 ? 2.0F : 0.5F);
        add(scene, glow(color), wall({0.5F, 9.0F}), at({static_cast<float>(i), 0, -4}));
    }
    return scene;
}

TEST(Glass, ClearGlassOfIndexOneChangesNothing) {
    const Pictures open = seen(stripes(), darkView());
    for (const float thickness : {0.0F, 1.0F}) {
        Scene scene = stripes();
        if (thickness > 0.0F) {
            add(scene, glass(thickness, 1.0F), builtin::box({2, 2, 0.5F}), turned(20));
        } else {
            add(scene, glass(thickness, 1.0F), wall({2, 2}), turned(20));
        }
        const Pictures p = seen(scene, darkView());
        const double error = compareImages(p.images.at("final"), open.images.at("final"), {}).difference.relativeMse;
        EXPECT_LT(error, 1e-6) << thickness;
        const Pictures opaque = seen(scene, darkView(), {"transmission.layers=0"});
        EXPECT_GT(compareImages(opaque.images.at("final"), open.images.at("final"), {}).difference.relativeMse, 0.05);
    }
}

// A lens blurs by the distance of what is seen through the glass: stripes nine metres away, glass at about five.
TEST(Glass, WhatIsBehindAClearPaneIsBlurredByItsOwnDistance) {
    for (const float focus : {5.0F, 9.0F}) {
        View view = darkView();
        view.camera.apertureRadius = 0.1F;
        view.camera.focusDistance = focus;
        const Pictures open = seen(stripes(), view);
        const Pictures sharp = seen(stripes(), darkView());
        const auto difference = [](const Pictures& a, const Pictures& b) {
            return compareImages(a.images.at("final"), b.images.at("final"), {}).difference.relativeMse;
        };
        EXPECT_EQ(difference(open, sharp) > 1e-3, focus == 5.0F) << "out of focus";
        for (const float thickness : {0.0F, 1.0F}) {
            Scene scene = stripes();
            add(scene, glass(thickness, 1.0F), thickness > 0.0F ? builtin::box({9, 9, 0.5F}) : wall({9, 9}));
            EXPECT_LT(difference(seen(scene, view), open), 1e-5) << focus << ", " << thickness;
        }
    }
}

// Where the edge between black and white is in the picture's middle row, in pixels.
float edge(const Pictures& p) {
    for (unsigned x = 1; x < size.x; ++x) {
        const float before = p.value("final", x - 1, size.y / 2);
        const float here = p.value("final", x, size.y / 2);
        if (before > 0.4F && here < 0.4F) {
            return static_cast<float>(x);
        }
    }
    return -1.0F;
}

TEST(Glass, ASlabShiftsWhatIsBehindByTheClosedForm) {
    View view = darkView();
    view.camera.position = {0, 0, 9};
    view.camera.orthographicHeight = 2.4F;
    const float pixelsPerMetre = static_cast<float>(size.y) / 2.4F;
    for (const float ior : {1.2F, 1.5F, 1.9F}) {
        for (const float angle : {-45.0F, 45.0F}) {
            Scene scene;
            add(scene, glow(vec3(1)), wall({4, 4}), at({-4, 0, -8}));  // white left of the middle
            add(scene, glass(1.0F, ior), builtin::box({6, 6, 0.5F}), turned(angle));
            const double outside = glm::radians(double(angle));
            const double inside = std::asin(std::sin(outside) / ior);
            // A ray is displaced by this much toward +x, so it meets the edge that much farther at -x.
            const double shift = std::sin(outside - inside) / std::cos(inside);
            const Pictures p = seen(scene, view);
            const auto expected = static_cast<float>(size.x) / 2.0F + static_cast<float>(shift) * pixelsPerMetre;
            EXPECT_NEAR(edge(p), expected, 1.0F) << ior << ", " << angle;
        }
    }
}

TEST(Glass, ASlabTintsAtBothBoundariesAndAbsorbsByBeersLaw) {
    Scene scene;
    add(scene, glow({1, 2, 4}), wall({9, 9}), at({0, 0, -3}));
    Material slab = glass(1.0F, 1.0F, {0.5F, 0.8F, 1.0F});
    slab.transmission.attenuationColor = {1.0F, 0.5F, 0.25F};
    slab.transmission.attenuationDistance = 2.0F;
    add(scene, slab, builtin::box({4, 4, 0.5F}));
    const vec3 expected = vec3(1, 2, 4) * vec3(0.25F, 0.64F, 1.0F) * vec3(1.0F, std::sqrt(0.5F), 0.5F);
    for (const char* steps : {"transmission.exit_steps=0", "transmission.exit_steps=4"}) {
        const Pictures p = seen(scene, darkView(), {steps});
        const vec3 got = p.color("final", size.x / 2, size.y / 2);
        EXPECT_LT(glm::distance(got, expected), 0.02F) << steps << ' ' << got.x << ' ' << got.y << ' ' << got.z;
        EXPECT_LT(glm::distance(p.color("indirect_specular", size.x / 2, size.y / 2), expected), 0.02F);
    }
}

TEST(Glass, ASheetTintsOnceAndNearerSheetsShowFartherOnes) {
    Scene scene;
    add(scene, glow({1, 1, 1}), wall({9, 9}), at({0, 0, -3}));
    add(scene, glass(0.0F, 1.0F, {0.5F, 1.0F, 1.0F}), wall({9, 9}), at({0, 0, -1}));
    add(scene, glass(0.0F, 1.0F, {1.0F, 0.25F, 1.0F}), wall({9, 9}));
    const auto middle = [&](const std::vector<std::string>& more) {
        return seen(scene, darkView(), more).color("final", size.x / 2, size.y / 2);
    };
    EXPECT_LT(glm::distance(middle({"transmission.layers=2"}), vec3(0.5F, 0.25F, 1.0F)), 0.01F);
    EXPECT_LT(glm::distance(middle({"transmission.layers=1"}), vec3(1.0F, 0.25F, 1.0F)), 0.01F) << "the nearest one";
}

TEST(Glass, BlendedSurfacesAreBehindOrBeforeIt) {
    Material red = glow({1, 0, 0});
    red.blended = true;
    red.alphaCutoff = blendCutoff;
    red.baseColor.a = 0.5F;
    Material blue = red;
    blue.emissive = {0, 0, 1};
    const vec3 tint(0.5F, 0.75F, 0.25F);
    Scene scene;
    add(scene, glow(vec3(1)), wall(vec2(9)), at({0, 0, -3}));
    add(scene, red, wall(vec2(9)), at({0, 0, -1}));
    add(scene, glass(0.0F, 1.0F, tint), wall(vec2(9)));
    add(scene, blue, wall(vec2(9)), at({0, 0, 1}));
    const vec3 behind = 0.5F * vec3(1, 0, 0) + 0.5F * vec3(1);
    const vec3 got = seen(scene, darkView()).color("final", 32, 24);
    EXPECT_LT(glm::distance(got, 0.5F * vec3(0, 0, 1) + 0.5F * tint * behind), 0.01F)
        << got.r << ' ' << got.g << ' ' << got.b;
}

TEST(Glass, MirrorsShowIt) {
    Scene scene;
    add(scene, glow({1, 1, 1}), wall({9, 9}), at({0, 0, -3}));
    add(scene, glass(0.0F, 1.0F, {1.0F, 0.25F, 0.25F}), wall({9, 9}), at({0, 0, -2}));
    Material silver;
    silver.roughness = 0.0F;
    add(scene, silver, builtin::ground({3, 3}, {1, 1}, {1, 1}), at({0, -1, 0}));
    const vec3 tinted(1, 0.25F, 0.25F);
    const auto shown = [&](const View& view, const char* source, unsigned y) {
        const Pictures p = render(scene, view, size, settingsOf({"diffuse.rays=0", source}), {"final"});
        expectSilentValidation(source);
        return p.color("final", 32, y);
    };
    EXPECT_LT(glm::distance(shown(darkView(), "planar.enabled=false", 20), tinted), 0.02F) << "straight";
    EXPECT_LT(glm::distance(shown(darkView(), "planar.enabled=false", 36), tinted), 0.02F) << "on screen";
    View down = darkView();  // sees the mirror alone
    down.camera.position = {0, 2, 0};
    down.camera.target = {0, -1, -1.5F};
    down.camera.fovY = glm::radians(15.0F);
    EXPECT_LT(glm::distance(shown(down, "planar.enabled=true", 24), tinted), 0.02F) << "planar";
}

// Sunlight at the middle of a floor beneath a surface.
float sunBeneath(const Material* material, const Mesh& mesh, const mat4& place, std::vector<std::string> more = {}) {
    Scene scene;
    add(scene, lambertMaterial(vec3(0.5F)), builtin::ground({6, 6}, {1, 1}, {1, 1}), at({0, -1, 0}));
    if (material != nullptr) {
        add(scene, *material, mesh, place);
    }
    View view = darkView();
    view.camera.position = {0, 0, 2};
    view.camera.target = {0, -1, 0};
    view.sun.direction = {0, -1, 0};
    view.sun.irradiance = vec3(3);
    return seen(scene, view, std::move(more)).value("direct", 32, 24);
}

TEST(Glass, ItTakesItsShareOfTheSun) {
    const float open = sunBeneath(nullptr, {}, {});
    const Mesh roof = wall({3, 3});
    const mat4 above = at({0, 3, 0}) * turned(-90, {1, 0, 0});
    const Material pane = glass(0.0F, 1.0F, vec3(0.5F));
    EXPECT_NEAR(sunBeneath(&pane, roof, above), 0.5F * open, 0.01F * open);
    EXPECT_NEAR(sunBeneath(&pane, roof, above, {"transmission.layers=0"}), 0.0F, 0.01F * open);
    EXPECT_NEAR(sunBeneath(&pane, roof, above, {"shadow.filter=traced", "shadow.rays=64"}), 0.5F * open, 0.12F * open);
    Material block = glass(1.0F, 1.0F);
    block.transmission.attenuationColor = vec3(0.5F);
    const mat4 higher = at({0, 4, 0});
    EXPECT_NEAR(sunBeneath(&block, builtin::box({3, 1, 3}), higher), open, 0.01F * open) << "no distance: clear";
    block.transmission.attenuationDistance = 1.0F;
    EXPECT_NEAR(sunBeneath(&block, builtin::box({3, 1, 3}), higher), 0.25F * open, 0.01F * open) << "two metres of it";
}

// The left half of a texture is 1, the right half 0.
TextureSlot leftHalf(Scene& scene) {
    const std::vector<uint8_t> texels{255, 255, 0, 255, 0, 0, 255, 255};
    return builtin::addTexture(scene, {"halves", 2, 1, texels},
                               {.magLinear = false, .minLinear = false, .mips = false});
}

TEST(Glass, TexturesSayWhereItTransmitsAndHowThickItIs) {
    Scene scene;
    add(scene, glow(vec3(1)), wall({9, 9}), at({0, 0, -3}));
    add(scene, glass(0.0F, 1.0F), wall({9, 9}));
    scene.materials.back().transmission.texture = leftHalf(scene);
    const Pictures pane = seen(scene, darkView());
    EXPECT_NEAR(pane.value("final", 20, 24), 1.0F, 0.01F);
    EXPECT_NEAR(pane.value("final", 44, 24), 0.0F, 0.01F) << "opaque";

    Scene shadowed;
    add(shadowed, lambertMaterial(vec3(0.5F)), builtin::ground({6, 6}, {1, 1}, {1, 1}), at({0, -1, 0}));
    add(shadowed, glass(0.0F, 1.0F), wall({6, 6}), at({0, 3, 0}) * turned(-90, {1, 0, 0}));
    shadowed.materials.back().transmission.texture = leftHalf(shadowed);
    View view = darkView();
    view.camera.position = {0, 0, 2};
    view.camera.target = {0, -1, 0};
    view.sun.direction = {0, -1, 0};
    view.sun.irradiance = vec3(3);
    for (const char* filter : {"shadow.filter=pcss", "shadow.filter=traced"}) {
        const Pictures floor = seen(shadowed, view, {filter});
        EXPECT_GT(floor.value("direct", 20, 24), 0.3F) << filter;
        EXPECT_NEAR(floor.value("direct", 44, 24), 0.0F, 0.01F) << filter;
    }

    Material slab = glass(2.0F, 1.0F);
    slab.transmission.attenuationColor = vec3(0.5F);
    slab.transmission.attenuationDistance = 2.0F;
    scene.materials.back() = slab;
    scene.materials.back().transmission.thicknessTexture = leftHalf(scene);
    const Pictures thick = seen(scene, darkView(), {"transmission.exit_steps=0"});
    EXPECT_NEAR(thick.value("final", 31, 24), 0.5F, 0.01F) << "two metres";
    EXPECT_NEAR(thick.value("final", 44, 24), 1.0F, 0.01F) << "none";
}

// A clear and a frosted ball and a pane before stripes, under a white sky.
TEST(Glass, BallsAndAPaneAreThoseOfTheReference) {
    Scene scene = stripes();
    Material frosted = glass(1.0F, 1.5F);
    frosted.roughness = 0.4F;
    add(scene, glass(1.0F, 1.5F), builtin::sphere(0.9F, 48), at({-1.1F, 0.2F, 0}));
    add(scene, frosted, builtin::sphere(0.7F, 48), at({1.0F, -0.6F, 0}));
    add(scene, glass(0.0F, 1.5F, {0.7F, 1.0F, 0.8F}), wall({0.6F, 0.5F}), at({1.1F, 0.9F, 0}));
    View view = darkView();
    view.environment.radiance = vec3(0.5F, 0.6F, 0.7F);
    ReferenceOptions options;
    options.samples = 256;
    options.filter = PixelFilter::center;
    const FloatImage truth = traceReference(scene, view, size, options).final;
    const auto error = [&](const std::vector<std::string>& assignments) {
        const Pictures p = render(scene, view, size, settingsOf(assignments), {"final"});
        return compareImages(p.images.at("final"), truth, {}).difference.relativeMse;
    };
    const double drawn = error({"diffuse.rays=16", "specular.rays=4"});
    const double opaque = error({"diffuse.rays=16", "specular.rays=4", "transmission.layers=0"});
    RecordProperty("drawn", std::to_string(drawn));
    RecordProperty("opaque", std::to_string(opaque));
    EXPECT_LT(drawn, 0.015);
    EXPECT_GT(opaque, 2 * drawn);
}

TEST(Glass, OpaqueScenesRecordNothingOfIt) {
    Scene scene = stripes();
    const auto passes = [](const Scene& s, const char* layers) {
        return passNames(s, darkView(), size, settingsOf({"diffuse.rays=0", layers}));
    };
    const auto opaque = passes(scene, "transmission.layers=0");
    EXPECT_EQ(passes(scene, "transmission.layers=8"), opaque);
    add(scene, glass(1.0F, 1.5F), builtin::sphere(1.0F, 16), at({0, 0, 100}));
    EXPECT_EQ(passes(scene, "transmission.layers=8"), opaque) << "behind the camera";
    add(scene, glass(1.0F, 1.5F), builtin::sphere(1.0F, 16));
    EXPECT_GT(passes(scene, "transmission.layers=1").size(), opaque.size());
}

}  // namespace
}  // namespace reflet::test::glass_test
