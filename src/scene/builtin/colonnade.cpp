// Columns, thin bars 1, 2 and 5 m above the ground, leaning poles and a perforated panel: penumbras that widen with the
// distance from the caster.
#include "scene/builtin/assemble.h"
#include "scene/builtin/patterns.h"
#include "scene/builtin/scenes.h"

#include <array>

namespace reflet::builtin {
namespace {

/// Plinth, base, shaft with entasis, capital and abacus: 4.6 m.
Mesh column() {
    static constexpr std::array<vec2, 21> outline{
        vec2(0.00F, 0.20F), vec2(0.44F, 0.20F), vec2(0.47F, 0.25F), vec2(0.47F, 0.31F), vec2(0.43F, 0.36F),
        vec2(0.37F, 0.38F), vec2(0.36F, 0.42F), vec2(0.40F, 0.46F), vec2(0.40F, 0.50F), vec2(0.34F, 0.54F),
        vec2(0.34F, 1.60F), vec2(0.325F, 2.7F), vec2(0.30F, 3.6F),  vec2(0.28F, 4.05F), vec2(0.32F, 4.09F),
        vec2(0.32F, 4.15F), vec2(0.29F, 4.18F), vec2(0.31F, 4.24F), vec2(0.40F, 4.34F), vec2(0.44F, 4.40F),
        vec2(0.00F, 4.40F)};
    Mesh mesh = lathe(outline, 32, 2.0F);
    append(mesh, box({0.5F, 0.1F, 0.5F}), at({0, 0.1F, 0}));
    append(mesh, box({0.48F, 0.1F, 0.48F}), at({0, 4.5F, 0}));
    return mesh;
}

void addPaving(Scene& scene) {
    const auto colors = addTexture(scene, pavingColors("paving", 512, 0xD8CBB2, 0xB9A88C, 0x7C7060));
    Material paving = textured("paving", colors, 0.85F);
    paving.normalTexture = addTexture(scene, pavingNormals("paving normals", 512, 3.0F));
    place(scene, "ground", addMaterial(scene, paving), ground({9, 8}, {12, 12}, {6.0F, 5.333F}));
}

void addColumns(Scene& scene) {
    const uint32_t stone = addMaterial(scene, plain("limestone", {0xE2D6C0, 0.8F}));
    const uint32_t shared = addMesh(scene, "column", stone, column());
    for (int i = 0; i < 5; ++i) {
        const float x = -6.0F + 3.0F * static_cast<float>(i);
        place(scene, "column " + std::to_string(i), shared, at({x, 0, -3.2F}));
    }
    place(scene, "architrave", stone, box({6.9F, 0.28F, 0.42F}, 0.5F), at({0, 4.88F, -3.2F}));
    const uint32_t plaster = addMaterial(scene, plain("terracotta plaster", {0xC77B52, 0.9F}));
    place(scene, "back wall", plaster, box({7.4F, 2.3F, 0.15F}, 0.5F), at({0, 2.3F, -6.0F}));
}

/// A bar on two posts, named after its height.
void addBar(Scene& scene, const vec3& middle, const std::array<uint32_t, 2>& paintAndIron) {
    const vec3 half(1.7F, 0, 1.3F);
    const float length = 2.0F * glm::length(half);
    const std::string name = "bar at " + std::to_string(static_cast<int>(middle.y)) + " m";
    place(scene, name, paintAndIron[0], cylinder(0.04F, length, 16), between(middle - half, middle + half));
    const uint32_t post = addMesh(scene, name + " post", paintAndIron[1], cylinder(0.05F, middle.y + 0.06F, 16));
    for (const float end : {-0.95F, 0.95F}) {
        const vec3 p = middle + end * half;
        place(scene, name + " post", post, at({p.x, 0, p.z}));
    }
}

void addBars(Scene& scene) {
    const uint32_t iron = addMaterial(scene, plain("dark iron", {0x53585C, 0.5F}));
    const uint32_t paint = addMaterial(scene, plain("blue paint", {0x2C6E8F, 0.5F}));
    addBar(scene, {-1.6F, 1.0F, 2.4F}, {paint, iron});
    addBar(scene, {1.0F, 2.0F, 1.6F}, {paint, iron});
    addBar(scene, {4.0F, 5.0F, 0.6F}, {paint, iron});
    const uint32_t leaning = addMesh(scene, "leaning pole", iron, cylinder(0.035F, 3.4F, 12));
    place(scene, "leaning pole 1", leaning, between({4.4F, 0, 4.0F}, {5.3F, 3.0F, 2.6F}));
    place(scene, "leaning pole 2", leaning, between({5.1F, 0, 4.2F}, {4.3F, 3.0F, 3.1F}));
    place(scene, "leaning pole 3", leaning, between({5.6F, 0, 3.2F}, {4.6F, 3.0F, 3.8F}));
}

void addPanel(Scene& scene) {
    Material pierced =
        textured("pierced panel", addTexture(scene, piercedPanel("pierced panel", 512, 5, 0xB5874A)), 0.6F);
    pierced.alphaCutoff = 0.5F;
    pierced.doubleSided = true;
    const uint32_t panel = addMaterial(scene, pierced);
    place(scene, "pierced panel", panel, patch({{0, 1.1F, 0}, {1.0F, 0, 0}, {0, 1.0F, 0}, {1, 1}, {1, 1}}),
          at({-3.3F, 0, 0.4F}) * turned(-52));
}

}  // namespace

Scene makeColonnade() {
    Scene scene;
    scene.name = "colonnade";
    addPaving(scene);
    addColumns(scene);
    addBars(scene);
    addPanel(scene);
    scene.cameras.push_back(camera("main", {-3.6F, 3.1F, 9.8F}, {0.2F, 1.5F, -1.0F}, 45));
    scene.cameras.push_back(camera("contact", {-5.6F, 1.5F, 3.6F}, {-2.6F, 0.7F, -1.6F}, 50));
    scene.sun = sun({-0.70F, -0.55F, -0.14F}, {4.2F, 3.7F, 3.0F});
    scene.environment.radiance = {0.28F, 0.38F, 0.55F};
    return scene;
}

}  // namespace reflet::builtin
