// Materials of public glTF files, against the path tracer: thin films, diffuse transmission, glass that covers a
// surface in part, and its coloured shadow.
#include "compare/compare.h"
#include "pass/harness.h"
#include "reference/reference.h"
#include "reference/thin_film.h"

namespace reflet::test::public_files_test {
namespace {

using builtin::at;

constexpr uvec2 size(48, 27);

View lit(const vec3& sunTravels) {
    View view;
    view.camera.position = {0, 0.6F, 4};
    view.camera.target = {0, 0, 0};
    view.camera.fovY = glm::radians(32.0F);
    view.sun.direction = glm::normalize(sunTravels);
    view.sun.irradiance = vec3(2);
    view.environment.radiance = vec3(0.5F);
    return view;
}

/// A thing over a floor.
Scene overFloor(const Material& material, Mesh mesh) {
    Scene scene;
    builtin::place(scene, "thing", builtin::addMaterial(scene, material), std::move(mesh));
    builtin::place(scene, "floor", builtin::addMaterial(scene, lambertMaterial(vec3(0.6F))),
                   builtin::ground({3, 3}, {1, 1}, {1, 1}), at({0, -0.7F, 0}));
    return scene;
}

/// The material as the reference shows it, and clearly apart from another one. Takes seconds: each material compiles
/// shaders of its own in a CPU driver, and the reference traces 128 samples a pixel.
void expectLikeReference(const Material& material, const Material& otherwise, const Mesh& mesh, const View& view) {
    ReferenceOptions options;
    options.samples = 128;
    options.filter = PixelFilter::center;
    const Settings settings = settingsOf({"diffuse.rays=8", "trace_scene.enabled=true", "shadow.filter=hard"});
    const FloatImage expected = traceReference(overFloor(material, mesh), view, size, options).final;
    const auto errorOf = [&](const Material& m) {
        const Pictures p = renderMean(overFloor(m, mesh), view, size, settings, {"final"}, 8);
        expectSilentValidation("a material of a public file");
        return compareImages(p.images.at("final"), expected, {}).difference.relativeMse;
    };
    const double error = errorOf(material);
    EXPECT_LT(error, 0.02);
    EXPECT_GT(errorOf(otherwise), 3.0 * error);
}

Material matt(const vec3& color) {
    Material m = lambertMaterial(color);
    m.doubleSided = true;
    return m;
}

TEST(PublicFiles, AThinFilmIsThatOfTheReferenceAndVanishesWithItsThickness) {
    const ThinFilm none{1.8F, 0.0F};
    EXPECT_LT(glm::length(none.f0At(0.7F, vec3(0.1F, 0.5F, 0.9F)) - vec3(0.1F, 0.5F, 0.9F)), 0.06F);
    Material film;
    film.baseColor = vec4(0.7F, 0.7F, 0.7F, 1.0F);
    film.roughness = 0.3F;
    Material bare = film;
    film.iridescence = {.factor = 1.0F, .ior = 1.8F, .thickest = 420.0F};
    expectLikeReference(film, bare, builtin::sphere(0.6F, 32), lit({0.3F, -0.8F, -0.6F}));
}

Mesh upright(Mesh mesh) {
    const auto turned = [](const vec3& v) { return vec3(v.x, -v.z, v.y); };
    mesh.bounds = {};
    for (size_t i = 0; i < mesh.positions.size(); ++i) {
        mesh.positions[i] = turned(mesh.positions[i]);
        mesh.attributes[i].normal = turned(mesh.attributes[i].normal);
        mesh.bounds.add(mesh.positions[i]);
    }
    return mesh;
}

TEST(PublicFiles, DiffuseLightPassesASheet) {
    Material sheet = matt(vec3(0.4F, 0.1F, 0.1F));
    const Material opaque = sheet;
    sheet.diffuseTransmission = {.factor = 0.7F, .color = {0.2F, 0.9F, 0.1F}};
    expectLikeReference(sheet, opaque, upright(builtin::ground({0.7F, 0.5F}, {1, 1}, {1, 1})),
                        lit({0.2F, -0.4F, 0.9F}));
}

TEST(PublicFiles, GlassCoversASurfaceInPartAndColoursItsShadow) {
    Material pane = matt(vec3(0.1F, 0.4F, 0.9F));
    pane.roughness = 0.0F;
    pane.transmission.factor = 1.0F;
    Material half = pane;
    half.baseColor.a = 0.5F;
    half.alphaCutoff = blendCutoff;
    half.blended = true;
    const Mesh flat = builtin::ground({0.6F, 0.5F}, {1, 1}, {1, 1});
    expectLikeReference(pane, matt(vec3(0.1F, 0.4F, 0.9F)), flat, lit({0.2F, -1.0F, -0.1F}));
    expectLikeReference(half, pane, flat, lit({0.2F, -1.0F, -0.1F}));
}

}  // namespace
}  // namespace reflet::test::public_files_test
