// specular.rough_fallback: reflections of surfaces above specular.max_roughness, without stochastic rays.
#include "compare/compare.h"
#include "pass/harness.h"
#include "scene/builtin.h"

#include <cmath>

namespace reflet::test::rough_reflections_test {
namespace {

constexpr uvec2 size(160, 90);

const std::vector<std::string> mips{"specular.max_roughness=0.5", "specular.rough_fallback=mips"};

Settings reflectionsOnly(const std::vector<std::string>& more) {
    std::vector<std::string> all{"diffuse.rays=0"};
    all.insert(all.end(), more.begin(), more.end());
    return settingsOf(all);
}

std::vector<bool> rougherThan(const Pictures& p, float roughness) {
    const std::vector<float>& values = p.images.at("roughness").data;
    std::vector<bool> mask;
    for (size_t i = 0; i < values.size(); ++i) {
        mask.push_back(values[i] > roughness && p.images.at("depth").data[i] > 0.0F);
    }
    return mask;
}

TEST(RoughReflections, OneBlurredHitIsNearerToManyRaysThanOneRayIs) {
    const Scene scene = findBuiltinScene("gloss")->make();
    const auto reflected = [&](const std::vector<std::string>& assignments) {
        return render(scene, defaultView(scene), size, reflectionsOnly(assignments),
                      {"indirect_specular", "roughness", "depth"});
    };
    const Pictures many = reflected({"specular.rays=256"});
    const CompareOptions rough{.mask = rougherThan(many, 0.55F)};
    const auto difference = [&](const std::vector<std::string>& assignments) {
        return compareImages(reflected(assignments).images.at("indirect_specular"), many.images.at("indirect_specular"),
                             rough)
            .difference;
    };
    const Difference one = difference({"specular.rays=1"});
    const Difference blurred = difference(mips);
    EXPECT_GT(one.pixels, 3000U);
    EXPECT_LT(blurred.relativeMse, 0.4 * one.relativeMse);
    EXPECT_LT(std::abs(blurred.bias), 0.05);
    RecordProperty("oneRay", std::to_string(one.relativeMse));
    RecordProperty("mips", std::to_string(blurred.relativeMse));
    RecordProperty("bias", std::to_string(blurred.bias));
    expectSilentValidation("mips");
}

TEST(RoughReflections, SurfacesUpToTheLimitKeepTheirRays) {
    const Scene scene = findBuiltinScene("gloss")->make();
    const std::vector<std::string> shows{"indirect_specular", "roughness", "depth"};
    const Pictures rays = render(scene, defaultView(scene), size, reflectionsOnly({}), shows);
    const Pictures both = render(scene, defaultView(scene), size, reflectionsOnly(mips), shows);
    const std::vector<bool> rough = rougherThan(rays, 0.5F);
    size_t kept = 0;
    size_t changed = 0;
    for (size_t i = 0; i < rough.size(); ++i) {
        const unsigned x = i % size.x;
        const unsigned y = i / size.x;
        const bool same = both.color("indirect_specular", x, y) == rays.color("indirect_specular", x, y);
        kept += !rough[i] && same ? 1 : 0;
        changed += rough[i] && !same ? 1 : 0;
        EXPECT_TRUE(rough[i] || same) << x << ", " << y;
    }
    EXPECT_GT(kept, 5000U);
    EXPECT_GT(changed, 2000U);
}

TEST(RoughReflections, NextLeavesThemEntirelyToTheEnvironment) {
    const Scene scene = findBuiltinScene("gloss")->make();
    const std::vector<std::string> shows{"specular_confidence", "roughness", "depth"};
    const Pictures p = render(scene, defaultView(scene), size, reflectionsOnly({"specular.max_roughness=0.5"}), shows);
    const std::vector<bool> rough = rougherThan(p, 0.5F);
    unsigned smoothHits = 0;
    for (size_t i = 0; i < rough.size(); ++i) {
        const float confidence = p.images.at("specular_confidence").data[i];
        EXPECT_TRUE(!rough[i] || confidence == 0.0F) << i;
        smoothHits += confidence > 0.0F ? 1 : 0;
    }
    EXPECT_GT(smoothHits, 1000U);
}

TEST(RoughReflections, AWhiteSphereInAWhiteEnvironmentIsWhiteInEveryPixel) {
    for (const float roughness : {0.0F, 0.3F, 0.6F, 1.0F}) {
        for (const float metallic : {0.0F, 1.0F}) {
            Material material = lambertMaterial(vec3(1.0F));
            material.roughness = roughness;
            material.metallic = metallic;
            View view;
            view.camera.position = {0, 0, 4};
            view.camera.target = {0, 0, 0};
            view.environment.radiance = vec3(1.0F);
            const Pictures p = render(
                sceneOf(material, builtin::sphere(1.0F, 96)), view, size,
                settingsOf({"diffuse.rays=1", "specular.max_roughness=0", "specular.rough_fallback=mips"}), {"final"});
            const Range range = rangeOf(p.images.at("final"));
            EXPECT_NEAR(range.min, 1.0F, 0.01F) << roughness << ", metallic " << metallic;
            EXPECT_NEAR(range.max, 1.0F, 0.01F) << roughness << ", metallic " << metallic;
        }
    }
}

/// A rough floor of dark metal before a board that glows, the right half less.
Scene boardOnFloor() {
    Material metal = lambertMaterial(vec3(0.1F));
    metal.metallic = 1.0F;
    metal.roughness = 0.4F;
    Scene scene = sceneOf(metal, builtin::ground({6, 4}, {1, 1}, {1, 1}));
    for (const float side : {-1.0F, 1.0F}) {
        Material board = lambertMaterial(vec3(0.0F));
        board.emissive = vec3(side < 0.0F ? 4.0F : 1.0F);
        builtin::place(scene, "board", builtin::addMaterial(scene, board),
                       builtin::patch({{0.7F * side, 0.8F, 0}, {0.7F, 0, 0}, {0, 0.75F, 0}, {1, 1}, {1, 1}}));
    }
    return scene;
}

TEST(RoughReflections, TheLastFramesMipsAreFoundByTheHitsMotion) {
    const Scene scene = boardOnFloor();
    View before;
    before.camera.position = {0.7F, 1.5F, 5};
    before.camera.target = {0.7F, 0.7F, 0};
    View now = before;
    now.camera.position.x = -0.7F;
    now.camera.target.x = -0.7F;
    const std::vector<std::string> shows{"indirect_specular", "roughness", "depth"};
    const auto settings = [](const std::string& light) {
        return reflectionsOnly(
            {"specular.max_roughness=0.2", "specular.rough_fallback=mips", "trace_screen.light=" + light});
    };
    const Pictures expected = render(scene, now, size, settings("direct"), shows);
    const Pictures moved = renderMoved(scene, before, now, size, settings("previous"), shows);
    const Difference d = compareImages(moved.images.at("indirect_specular"), expected.images.at("indirect_specular"),
                                       {.mask = rougherThan(expected, 0.3F)})
                             .difference;
    EXPECT_GT(rangeOf(expected.images.at("indirect_specular")).max, 0.2F);
    EXPECT_LT(d.relativeMse, 0.03);
    RecordProperty("relativeMse", std::to_string(d.relativeMse));
    expectSilentValidation("the last frame's mips");
}

TEST(RoughReflections, MipsAreSoundAtEverySizeWithEveryLight) {
    const Scene scene = findBuiltinScene("gloss")->make();
    for (const char* light : {"direct", "lit", "previous"}) {
        for (const uvec2 odd : {uvec2(1, 1), uvec2(1, 33), uvec2(37, 1), uvec2(13, 7), uvec2(60, 34)}) {
            const Settings settings = settingsOf({"specular.max_roughness=0", "specular.rough_fallback=mips",
                                                  "specular.rays=5", std::string("trace_screen.light=") + light});
            const Pictures p = render(scene, defaultView(scene), odd, settings, {"final"}, 3);
            const Range range = rangeOf(p.images.at("final"));
            EXPECT_TRUE(range.finite) << light;
            EXPECT_GE(range.min, 0.0F) << light;
            expectSilentValidation(light);
        }
    }
}

TEST(RoughReflections, AnOrthographicCameraBlursAsMuchAsADistantOne) {
    const Scene scene = boardOnFloor();
    View orthographic;
    orthographic.camera.position = {0, 4, 8};
    orthographic.camera.target = {0, 0.5F, 0};
    orthographic.camera.orthographicHeight = 3.0F;
    orthographic.camera.far = 2000.0F;
    View distant = orthographic;
    const vec3 back = orthographic.camera.position - orthographic.camera.target;
    distant.camera.position = orthographic.camera.target + 10.0F * back;
    distant.camera.fovY = 2.0F * std::atan(1.5F / glm::length(10.0F * back));
    distant.camera.orthographicHeight = 0.0F;
    const std::vector<std::string> shows{"indirect_specular", "roughness", "depth"};
    const Settings settings = reflectionsOnly({"specular.max_roughness=0.2", "specular.rough_fallback=mips"});
    const Pictures parallel = render(scene, orthographic, size, settings, shows);
    const Pictures far = render(scene, distant, size, settings, shows);
    const Difference d = compareImages(parallel.images.at("indirect_specular"), far.images.at("indirect_specular"),
                                       {.mask = rougherThan(far, 0.3F)})
                             .difference;
    EXPECT_GT(rangeOf(far.images.at("indirect_specular")).max, 0.1F);
    EXPECT_LT(d.relativeMse, 0.01);
    RecordProperty("relativeMse", std::to_string(d.relativeMse));
}

// A pixel's footprint in what a flat mirror shows grows with the distance from the camera, so that of the far sky is as
// wide as the lobe: a blur that is wider smears the edge of what stands before it.
TEST(RoughReflections, OfTheSkyInAnAlmostSmoothFloorAreNotBlurredByTheDenoiser) {
    Scene scene;
    Material floor = lambertMaterial(vec3(1.0F));
    floor.metallic = 1.0F;
    floor.roughness = 0.03F;
    builtin::place(scene, "floor", builtin::addMaterial(scene, floor), builtin::ground({40, 40}, {1, 1}, {1, 1}));
    builtin::place(scene, "panel", builtin::addMaterial(scene, lambertMaterial(vec3(0.0F))),
                   builtin::patch({{0, 1, -12}, {6, 0, 0}, {0, 3, 0}}));
    scene.environment.radiance = vec3(1.0F);
    View view = defaultView(scene);
    view.camera = builtin::camera("eye", {0, 2, 6}, {0, 0, -2}, 50.0F);
    view.sun.irradiance = vec3(0.0F);
    const auto reflected = [&](const std::vector<std::string>& more) {
        std::vector<std::string> all{"trace_scene.enabled=on", "diffuse.rays=0"};
        all.insert(all.end(), more.begin(), more.end());
        return render(scene, view, size, settingsOf(all), {"indirect_specular"}).images.at("indirect_specular");
    };
    const Difference blurred =
        compareImages(reflected({"denoise.enabled=on"}), reflected({"specular.rays=64"}), {}).difference;
    EXPECT_LT(blurred.relativeMse, 0.05);  // 0.14 with a footprint that does not grow
    RecordProperty("relativeMse", std::to_string(blurred.relativeMse));
    expectSilentValidation("smooth floor");
}

}  // namespace
}  // namespace reflet::test::rough_reflections_test
