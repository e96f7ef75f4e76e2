// Material extensions in the renderer: unlit surfaces, index of refraction, specular colour; against exact values and
// the path tracer.
#include "compare/compare.h"
#include "pass/harness.h"
#include "reference/reference.h"

#include <algorithm>
#include <array>

namespace reflet::test::materials_test {
namespace {

constexpr uvec2 size(96, 64);

View viewFrom(const vec3& position, const vec3& target) {
    View view = test::viewFrom(position, target);
    view.camera.fovY = glm::radians(35.0F);
    return view;
}

vec3 meanOver(const FloatImage& image, const std::vector<bool>& mask) {
    glm::dvec3 sum(0.0);
    double count = 0.0;
    for (size_t i = 0; i < mask.size(); ++i) {
        if (mask[i]) {
            sum += glm::dvec3(image.data[3 * i], image.data[3 * i + 1], image.data[3 * i + 2]);
            count += 1.0;
        }
    }
    return sum / std::max(count, 1.0);
}

/// The pixels whose albedo, and that of their neighbours, is this: edges are not compared.
std::vector<bool> pixelsOf(const FloatImage& albedo, const vec3& color) {
    const auto isColor = [&](size_t i) {
        const vec3 here(albedo.data[3 * i], albedo.data[3 * i + 1], albedo.data[3 * i + 2]);
        return glm::length(here - color) < 0.01F;
    };
    std::vector<bool> mask(size_t(albedo.width) * albedo.height);
    for (unsigned y = 1; y + 1 < albedo.height; ++y) {
        for (unsigned x = 1; x + 1 < albedo.width; ++x) {
            const size_t i = size_t(y) * albedo.width + x;
            mask[i] = isColor(i) && isColor(i - 1) && isColor(i + 1) && isColor(i - albedo.width) &&
                      isColor(i + albedo.width);
        }
    }
    return mask;
}

TextureImage oneColor(std::array<uint8_t, 4> rgba) {
    return {.name = "color", .width = 1, .height = 1, .rgba = {rgba.begin(), rgba.end()}};
}

/// A texture of the colour beside black, of which its transform shows the colour alone.
TextureSlot colorBesideBlack(Scene& scene, std::array<uint8_t, 4> rgba) {
    TextureImage image{.name = "half", .width = 2, .height = 1, .rgba = {0, 0, 0, 0}};
    image.rgba.insert(image.rgba.end(), rgba.begin(), rgba.end());
    TextureSlot slot = builtin::addTexture(scene, std::move(image));
    slot.uvTransform = {vec3(0.001F, 0, 0.75F), vec3(0, 0.001F, 0.5F)};
    return slot;
}

/// Its base colour tells it from others.
Material glossy(float grey) {
    Material m = lambertMaterial(vec3(grey));
    m.roughness = 0.4F;
    return m;
}

/// Six spheres, of base colours 0.05, 0.1 …: without the extensions, and with them.
std::vector<Material> unusual(Scene& scene) {
    std::vector<Material> all;
    for (int i = 0; i < 6; ++i) {
        all.push_back(glossy(0.05F * static_cast<float>(i + 1)));
    }
    all[1].ior = 1.0F;
    all[2].ior = 2.4F;
    all[3].specular = 0.0F;
    all[4].ior = 1.8F;
    all[4].specularColor = {1.0F, 0.2F, 3.0F};
    all[5].ior = 2.4F;
    all[5].specularTexture = colorBesideBlack(scene, {255, 255, 255, 128});
    all[5].specularColorTexture = colorBesideBlack(scene, {188, 255, 0, 255});
    return all;
}

Scene spheres() {
    Scene scene;
    float x = -2.5F;
    for (const Material& m : unusual(scene)) {
        builtin::place(scene, "sphere", builtin::addMaterial(scene, m), builtin::sphere(0.45F, 48),
                       builtin::at({x, 0, 0}));
        x += 1.0F;
    }
    return scene;
}

View litSpheres() {
    View view = viewFrom({0, 0, 7}, {0, 0, 0});
    view.sun = builtin::sun(glm::normalize(vec3(-0.4F, -0.5F, -1.0F)), vec3(2.0F));
    view.environment.radiance = vec3(0.8F, 0.9F, 1.0F);
    return view;
}

// All of the light but what spheres reflect of one another.
void expectTheSpheresOfTheReference(const Scene& scene, const View& view, const Pictures& p, double tolerance) {
    const ReferencePicture truth = traceReference(scene, view, size, {.bounces = 1, .samples = 32});
    for (int i = 0; i < 6; ++i) {
        const std::vector<bool> mask = pixelsOf(truth.albedo, vec3(0.05F * static_cast<float>(i + 1)));
        EXPECT_GT(std::ranges::count(mask, true), 40) << i;
        for (const auto& [name, expected] :
             {std::pair("direct", &truth.direct), std::pair("indirect_diffuse", &truth.indirectDiffuse),
              std::pair("indirect_specular", &truth.indirectSpecular)}) {
            const vec3 here = meanOver(p.images.at(name), mask);
            const vec3 there = meanOver(*expected, mask);
            for (int c = 0; c < 3; ++c) {
                EXPECT_NEAR(here[c], there[c], tolerance * (there[c] + 0.01)) << name << " of sphere " << i;
            }
        }
    }
}

TEST(Materials, ReflectByTheirIorAndSpecularAsInThePathTracer) {
    const Scene scene = spheres();
    const View view = litSpheres();
    const Pictures p = render(
        scene, view, size,
        settingsOf({"diffuse.rays=32", "specular.rays=32", "specular.max_roughness=1", "materials.anisotropy=1"}),
        {"direct", "indirect_diffuse", "indirect_specular"});
    expectTheSpheresOfTheReference(scene, view, p, 0.05);
    expectSilentValidation("ior and specular");
}

// The mirror shows what only rays through the scene's triangles find.
TEST(Materials, LookInAMirrorAsTheyAre) {
    Scene scene = spheres();
    Material mirror = lambertMaterial(vec3(1.0F));
    mirror.metallic = 1.0F;
    mirror.roughness = 0.0F;
    builtin::place(scene, "mirror", builtin::addMaterial(scene, mirror),
                   builtin::patch({{0, 0, 10}, {-8, 0, 0}, {0, 5, 0}}));
    View view = litSpheres();
    view.sun.direction = glm::normalize(vec3(0.4F, -0.5F, -1.0F));
    view.camera.position = {0, 0, 3};
    view.camera.target = {0, 0, 10};
    const Settings settings =
        settingsOf({"trace_scene.enabled=on", "trace_scene.light=path", "trace_scene.bounces=1",
                    "trace_screen.enabled=off", "diffuse.rays=0", "specular.rays=32", "materials.mips=off"});
    const Pictures p = render(scene, view, size, settings, {"indirect_specular"});
    const ReferencePicture truth = traceReference(scene, view, size, {.bounces = 2, .samples = 32});
    // In the picture of the mirror, spheres are columns of a sixth of their row's width.
    const std::vector<bool> all(size_t(size.x) * size.y, true);
    for (int c = 0; c < 3; ++c) {
        EXPECT_NEAR(meanOver(p.images.at("indirect_specular"), all)[c], meanOver(truth.indirectSpecular, all)[c],
                    0.01F);
    }
    for (unsigned column = 0; column < size.x; column += 4) {
        std::vector<bool> mask(all.size(), false);
        for (unsigned i = 0; i < 4 * 8; ++i) {
            mask[size_t(size.y / 2 - 4 + i / 4) * size.x + column + i % 4] = true;
        }
        const vec3 here = meanOver(p.images.at("indirect_specular"), mask);
        const vec3 there = meanOver(truth.indirectSpecular, mask);
        for (int c = 0; c < 3; ++c) {
            EXPECT_NEAR(here[c], there[c], 0.05F * there[c] + 0.03F) << "column " << column;
        }
    }
    expectSilentValidation("a mirror of ior and specular");
}

TEST(Materials, AtReducedResolutionReflectByTheirIorAndSpecular) {
    const Scene scene = spheres();
    const View view = litSpheres();
    const Pictures p = render(scene, view, size,
                              settingsOf({"diffuse.rays=16", "specular.rays=32", "specular.max_roughness=1",
                                          "materials.anisotropy=1", "diffuse.downsample=2", "specular.downsample=2"}),
                              {"direct", "indirect_diffuse", "indirect_specular"});
    expectTheSpheresOfTheReference(scene, view, p, 0.08);
    expectSilentValidation("ior and specular at reduced resolution");
}

// What a material reflects does not depend on whether another one needs the G-buffer's reflectance. The shaders differ,
// so a compiler may fuse other operations: llvmpipe draws the same bytes, a GPU differed in the last bit of half
// floats.
TEST(Materials, WithoutTheExtensionsStayTheSameBesideOthersThatUseThem) {
    Scene plain = sceneOf(glossy(0.5F), builtin::sphere(1.0F, 32));
    Scene beside = plain;
    Material other = glossy(0.5F);
    other.ior = 2.0F;
    Material glow = glossy(0.5F);
    glow.unlit = true;
    for (const Material& m : {other, glow}) {
        builtin::place(beside, "behind the camera", builtin::addMaterial(beside, m), builtin::sphere(0.1F, 8),
                       builtin::at({0, 0, 20}));
    }
    const Settings settings = settingsOf({"diffuse.rays=2", "specular.rays=2", "specular.downsample=2"});
    const View view = viewFrom({0, 0, 4}, {0, 0, 0});
    const std::string shown = "final";
    View lit = view;
    lit.environment.radiance = vec3(0.5F, 0.7F, 0.9F);
    lit.sun = builtin::sun(glm::normalize(vec3(-0.4F, -0.5F, -1.0F)), vec3(2.0F));
    const FloatImage alone = render(plain, lit, size, settings, {shown}).images.at(shown);
    const FloatImage together = render(beside, lit, size, settings, {shown}).images.at(shown);
    EXPECT_LT(compareImages(together, alone, {}).difference.relativeMse, 1e-6);
}

/// A wall with a textured, vertex-coloured unlit material, and a white floor in front of it that may be left out.
Scene unlitWall(bool floor) {
    Scene scene;
    Material wall = lambertMaterial(vec3(0.5F, 0.8F, 1.0F));
    wall.unlit = true;
    wall.emissive = vec3(7.0F);  // ignored
    wall.baseColorTexture = builtin::addTexture(scene, oneColor({188, 255, 255, 255}));
    Mesh mesh = builtin::patch({{0, 1, 0}, {3, 0, 0}, {0, 1, 0}});
    for (VertexAttributes& v : mesh.attributes) {
        v.color = builtin::vertexColor({1.0F, 0.5F, 1.0F});
    }
    builtin::place(scene, "wall", builtin::addMaterial(scene, wall), std::move(mesh));
    if (floor) {
        builtin::place(scene, "floor", builtin::addMaterial(scene, lambertMaterial(vec3(0.7F))),
                       builtin::patch({{0, 0, 1}, {3, 0, 0}, {0, 0, -1}}));
    }
    return scene;
}

const vec3 wallColor(0.5F * 0.5029F, 0.4F, 1.0F);  // 188 of 255 is 0.5029, linear

TEST(Materials, UnlitOnesShowTheirBaseColourWhateverTheLight) {
    for (const bool floor : {true, false}) {
        const Scene scene = unlitWall(floor);
        View view = viewFrom({0, 1, 3}, {0, 1, 0});
        view.sun = builtin::sun(glm::normalize(vec3(-0.4F, -0.5F, -1.0F)), vec3(3.0F));
        view.environment.radiance = vec3(1.0F);
        for (const char* shadow : {"shadow.filter=pcf", "shadow.filter=traced"}) {
            const Pictures p =
                render(scene, view, size, settingsOf({shadow, "diffuse.rays=1", "specular.rays=1"}), {"final"});
            for (int c = 0; c < 3; ++c) {
                EXPECT_NEAR(p.color("final", size.x / 2, size.y / 2)[c], wallColor[c], 0.004F) << shadow;
            }
        }
        const ReferencePicture truth = traceReference(scene, view, size, {.samples = 4});
        const size_t center = (size_t(size.y / 2) * size.x + size.x / 2) * 3;
        for (int c = 0; c < 3; ++c) {
            EXPECT_NEAR(truth.final.data[center + static_cast<size_t>(c)], wallColor[c], 1e-3F);
        }
    }
    expectSilentValidation("unlit");
}

TEST(Materials, UnlitOnesLightOthersAsEmissiveSurfacesDo) {
    const Scene scene = unlitWall(true);
    Scene emissive = scene;
    Material& wall = emissive.materials.at(0);
    wall.unlit = false;
    wall.emissive = wallColor;
    wall.baseColorTexture = {};
    wall.baseColor = vec4(0, 0, 0, 1);
    wall.specular = 0.0F;  // reflects nothing, either
    constexpr uvec2 small(48, 30);
    const View view = viewFrom({0, 2, 4}, {0, 0.5F, 0});
    const auto floorOf = [&](const FloatImage& albedo) { return pixelsOf(albedo, vec3(0.7F)); };
    const auto floorInTruth = [&](const Scene& s) {
        const ReferencePicture truth = traceReference(s, view, small, {.bounces = 1, .samples = 32});
        return meanOver(truth.final, floorOf(truth.albedo));
    };
    const vec3 traced = floorInTruth(scene);
    const vec3 tracedEmissive = floorInTruth(emissive);
    for (const char* screen : {"trace_screen.enabled=on", "trace_screen.enabled=off"}) {
        const Settings settings = settingsOf({"diffuse.rays=16", "specular.rays=4", "trace_scene.enabled=on", screen});
        const auto floorIn = [&](const Scene& s) {
            const Pictures p = render(s, view, small, settings, {"final", "albedo"});
            return meanOver(p.images.at("final"), floorOf(p.images.at("albedo")));
        };
        const vec3 rendered = floorIn(scene);
        const vec3 renderedEmissive = floorIn(emissive);
        for (int c = 0; c < 3; ++c) {
            EXPECT_GT(traced[c], 0.02F);
            EXPECT_NEAR(rendered[c], renderedEmissive[c], 0.02F * renderedEmissive[c]) << screen;
            EXPECT_NEAR(traced[c], tracedEmissive[c], 0.02F * tracedEmissive[c]);
            // 6 % too bright with any noise: pixel centres against areas, at 48x32.
            EXPECT_NEAR(rendered[c], traced[c], 0.07F * traced[c]) << screen;
        }
    }
    expectSilentValidation("light of unlit surfaces");
}

}  // namespace
}  // namespace reflet::test::materials_test
