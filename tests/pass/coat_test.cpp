// Clear coats (KHR_materials_clearcoat): against the path tracer, their textures, and no cost without them.
#include "compare/compare.h"
#include "pass/harness.h"
#include "reference/reference.h"

#include <fmt/format.h>

#include <array>
#include <cmath>

namespace reflet::test::coat_test {
namespace {

using builtin::at;

constexpr uvec2 size(66, 48);

TextureImage texels(const std::vector<std::array<uint8_t, 4>>& row) {
    TextureImage image{"row", static_cast<uint32_t>(row.size()), 1, {}};
    for (const auto& texel : row) {
        image.rgba.insert(image.rgba.end(), texel.begin(), texel.end());
    }
    return image;
}

constexpr Sampler sharp{.magLinear = false, .minLinear = false, .mips = false};

Material wood() {
    Material m;
    m.baseColor = {0.4F, 0.1F, 0.05F, 1};
    m.metallic = 0.0F;
    m.roughness = 0.7F;
    m.emissive = vec3(0.05F);
    m.clearcoat.factor = 1.0F;
    m.clearcoat.roughness = 0.1F;
    return m;
}

View outdoors() {
    View view;
    view.camera.position = {0, 0.5F, 4};
    view.camera.target = vec3(0.0F);
    view.sun.direction = glm::normalize(vec3(0.4F, -0.8F, -0.5F));
    view.sun.irradiance = vec3(2);
    view.environment.radiance = {0.5F, 0.6F, 0.8F};
    return view;
}

// A glossy and a rougher coat of half the surface, on wood, on metal and on glass, above a floor.
Scene coatedBalls() {
    Scene scene;
    const auto ball = [&](Material m, float x) {
        m.clearcoat.factor = x < 0.0F ? 1.0F : 0.5F;
        m.clearcoat.roughness = x < 0.0F ? 0.05F : 0.4F;
        builtin::place(scene, std::to_string(x), builtin::addMaterial(scene, m), builtin::sphere(0.6F, 48),
                       at({x, 0, 0}));
    };
    Material metal = wood();
    metal.metallic = 1.0F;
    metal.baseColor = {0.7F, 0.5F, 0.2F, 1};
    Material glass = wood();
    glass.emissive = vec3(0.0F);
    glass.baseColor = {0.7F, 0.9F, 1.0F, 1};
    glass.roughness = 0.0F;
    glass.transmission = {.factor = 1.0F, .thickness = 1.2F};
    ball(wood(), -1.4F);
    ball(metal, 1.4F);
    ball(glass, -0.01F);
    builtin::place(scene, "floor", builtin::addMaterial(scene, lambertMaterial({0.3F, 0.5F, 0.3F})),
                   builtin::ground({4, 4}, {1, 1}, {1, 1}), at({0, -0.6F, 0}));
    return scene;
}

TEST(Coat, CoatedBallsAreThoseOfTheReference) {
    const Scene scene = coatedBalls();
    ReferenceOptions options;
    options.samples = 128;
    options.filter = PixelFilter::center;
    const FloatImage truth = traceReference(scene, outdoors(), size, options).final;
    const Pictures opaque = render(scene, outdoors(), size, settingsOf({"transmission.layers=0"}), {"depth"});
    CompareOptions opaqueBalls;
    CompareOptions glassBall;
    for (unsigned i = 0; i < size.x * size.y; ++i) {
        const unsigned x = i % size.x;
        const unsigned y = i / size.x;
        const bool ball = opaque.hasSurface(x, y) && opaque.position(x, y).y > -0.55F;
        const bool glass = ball && std::abs(opaque.position(x, y).x) < 0.65F;
        opaqueBalls.mask.push_back(ball && !glass);
        glassBall.mask.push_back(glass);
    }
    const auto error = [&](const char* coats, const CompareOptions& balls) {
        const Pictures p =
            render(scene, outdoors(), size, settingsOf({"diffuse.rays=16", "specular.rays=4", coats}), {"final"});
        expectSilentValidation(coats);
        return compareImages(p.images.at("final"), truth, balls).difference.relativeMse;
    };
    const double drawn = error("materials.coats=true", opaqueBalls);
    const double bare = error("materials.coats=false", opaqueBalls);
    const double drawnGlass = error("materials.coats=true", glassBall);
    const double bareGlass = error("materials.coats=false", glassBall);
    RecordProperty("drawn", fmt::format("{} {}", drawn, drawnGlass));
    RecordProperty("bare", fmt::format("{} {}", bare, bareGlass));
    EXPECT_LT(drawn, 0.01);
    EXPECT_GT(bare, 1.7 * drawn);
    EXPECT_GT(bareGlass, drawnGlass);
}

// A wall that fills the picture.
Scene wall(const Material& material) {
    return sceneOf(material, builtin::patch({.right = {4, 0, 0}, .up = {0, 4, 0}}));
}

View whiteRoom() {
    View view;
    view.camera.position = {0, 0, 3};
    view.camera.target = vec3(0.0F);
    view.environment.radiance = vec3(1);
    return view;
}

TEST(Coat, ItReflectsWhatTheBaseDoesNotReceive) {
    Material white;
    white.metallic = 0.0F;
    white.clearcoat = {.factor = 0.75F, .roughness = 0.3F};
    const Pictures p = render(wall(white), whiteRoom(), size, settingsOf({"diffuse.rays=16", "specular.rays=4"}),
                              {"final", "direct", "indirect_diffuse", "indirect_specular"});
    EXPECT_NEAR(p.value("final", 33, 24), 1.0F, 0.01F) << "a white furnace";
    for (unsigned x = 0; x < size.x; x += 9) {
        const vec3 sum =
            p.color("direct", x, 20) + p.color("indirect_diffuse", x, 20) + p.color("indirect_specular", x, 20);
        EXPECT_LT(glm::distance(sum, p.color("final", x, 20)), 0.01F) << x;
    }
}

// The left half of the wall has a coat, the right half none.
TEST(Coat, ItsTextureSaysWhereItIs) {
    const auto shown = [](bool textured, float factor) {
        Material black = lambertMaterial(vec3(0.0F));
        black.roughness = 1.0F;
        black.specular = 0.0F;
        black.clearcoat = {.factor = factor};
        Scene scene = wall(black);
        if (textured) {
            scene.materials.back().clearcoat.texture =
                builtin::addTexture(scene, texels({{255, 0, 0, 255}, {0, 255, 255, 255}}), sharp);
        }
        return render(scene, whiteRoom(), size, settingsOf({"diffuse.rays=0"}), {"final"});
    };
    EXPECT_NEAR(shown(false, 1.0F).value("final", 24, 24), 0.04F, 0.002F);
    EXPECT_NEAR(shown(false, 0.5F).value("final", 24, 24), 0.02F, 0.001F);
    const Pictures halves = shown(true, 1.0F);
    EXPECT_NEAR(halves.value("final", 24, 24), 0.04F, 0.002F);
    EXPECT_NEAR(halves.value("final", 40, 24), 0.0F, 1e-4F);
}

// Coverage scales the coat with the rest of the surface; where it is whole, the coat is that of an opaque surface.
TEST(Coat, OfABlendedSurfaceCoversWithIt) {
    const auto shown = [](float alpha, const char* coats) {
        Material black = lambertMaterial(vec3(0.0F));
        black.roughness = 1.0F;
        black.specular = 0.0F;
        black.blended = true;
        black.alphaCutoff = blendCutoff;
        black.baseColor.a = alpha;
        black.clearcoat = {.factor = 1.0F};
        View view = whiteRoom();
        return render(wall(black), view, size, settingsOf({"diffuse.rays=0", coats}), {"final"}).value("final", 24, 24);
    };
    EXPECT_NEAR(shown(1.0F, "materials.coats=true"), 0.04F, 0.002F);
    const float behind = shown(0.5F, "materials.coats=false");
    EXPECT_NEAR(shown(0.5F, "materials.coats=true"), behind + 0.5F * 0.04F, 0.002F);
}

// A bright panel that a mirror-like coat shows, and a rough or tilted one does not.
TEST(Coat, ItHasARoughnessAndANormalOfItsOwn) {
    const auto shown = [](const TextureImage* roughness, const TextureImage* normal) {
        Material black = lambertMaterial(vec3(0.0F));
        black.specular = 0.0F;
        black.roughness = 1.0F;
        black.clearcoat = {.factor = 1.0F, .roughness = roughness != nullptr ? 1.0F : 0.3F};
        Scene scene = wall(black);
        if (roughness != nullptr) {
            scene.materials.back().clearcoat.roughnessTexture = builtin::addTexture(scene, *roughness, sharp);
        }
        if (normal != nullptr) {
            scene.materials.back().clearcoat.normalTexture = builtin::addTexture(scene, *normal, sharp);
        }
        View view = whiteRoom();
        view.environment.radiance = vec3(0.0F);
        view.sun.direction = {0, 0, -1};
        view.sun.irradiance = vec3(1);
        return render(scene, view, size, settingsOf({"diffuse.rays=0"}), {"final"});
    };
    const TextureImage halves = texels({{0, 77, 0, 255}, {0, 255, 0, 255}});
    const TextureImage tilted = texels({{128, 128, 255, 255}, {255, 128, 128, 255}});
    const float bright = shown(nullptr, nullptr).value("final", 33, 24);
    EXPECT_GT(bright, 0.2F) << "the sun's highlight";
    const Pictures rough = shown(&halves, nullptr);
    EXPECT_NEAR(rough.value("final", 32, 24), bright, 0.1F * bright);
    EXPECT_LT(rough.value("final", 33, 24), 0.1F * bright);
    const Pictures bent = shown(nullptr, &tilted);
    EXPECT_NEAR(bent.value("final", 32, 24), bright, 0.1F * bright);
    EXPECT_LT(bent.value("final", 33, 24), 0.05F * bright);
}

TEST(Coat, ScenesWithoutCoatsRecordNothingOfThem) {
    const auto passes = [](const Scene& scene, const char* coats) {
        return passNames(scene, whiteRoom(), size, settingsOf({"diffuse.rays=0", coats}));
    };
    Material bare = wood();
    bare.clearcoat = {};
    const auto without = passes(wall(bare), "materials.coats=true");
    EXPECT_EQ(passes(wall(wood()), "materials.coats=false"), without);
    Scene behind = wall(bare);
    builtin::place(behind, "behind", builtin::addMaterial(behind, wood()), builtin::sphere(0.5F, 16), at({0, 0, 9}));
    EXPECT_EQ(passes(behind, "materials.coats=true"), without) << "behind the camera";
    EXPECT_GT(passes(wall(wood()), "materials.coats=true").size(), without.size());
}

}  // namespace
}  // namespace reflet::test::coat_test
