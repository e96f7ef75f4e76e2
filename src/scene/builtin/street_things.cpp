// What stands and hangs about in the built-in scene "street": a railing, cables, pipes, bins, crates, balconies.
#include "scene/builtin/assemble.h"
#include "scene/builtin/noise.h"
#include "scene/builtin/street.h"

#include <array>
#include <cmath>

namespace reflet::builtin::street {
namespace {

// Rods between two rails, 1 m high, along z.
Mesh railingMesh(float length) {
    Mesh mesh;
    const auto rail = [&](float y, float radius) {
        const std::array<vec3, 2> line{vec3(0, y, 0), vec3(0, y, -length)};
        append(mesh, tube(line, radius, 10), mat4(1.0F));
    };
    rail(1.0F, 0.03F);
    rail(0.86F, 0.015F);
    rail(0.14F, 0.018F);
    const int rods = static_cast<int>(length / 0.13F);
    for (int i = 1; i < rods; ++i) {
        append(mesh, cylinder(0.0095F, 0.74F, 8),
               at({0, 0.13F, -length * static_cast<float>(i) / static_cast<float>(rods)}));
    }
    for (const float z : {0.0F, 0.5F * length, length}) {
        append(mesh, cylinder(0.038F, 1.06F, 14), at({0, 0, -z}));
        append(mesh, sphere(0.055F, 14), at({0, 1.09F, -z}));
    }
    return mesh;
}

void addRailings(Scene& scene) {
    const uint32_t iron = addMaterial(scene, plain("railing", {0x1A2226, 0.28F, 0.6F}));
    const uint32_t mesh = addMesh(scene, "railing", iron, railingMesh(3.0F));
    for (const float z : {3.4F, 0.2F, -13.0F, -16.1F, -19.2F}) {
        place(scene, "left railing", mesh, at({-roadHalf - 0.22F, pavementY, z}));
    }
    for (const float z : {-10.5F, -13.6F, -20.5F, -23.6F}) {
        place(scene, "right railing", mesh, at({roadHalf + 0.22F, pavementY, z}));
    }
}

void addCables(Scene& scene) {
    const uint32_t rubber = addMaterial(scene, plain("cable", {0x101113, 0.5F}));
    Mesh mesh;
    for (int i = 0; i < 9; ++i) {
        const auto n = static_cast<float>(i);
        const vec3 from(-frontX, 6.6F + 2.6F * hash01(i, 0, 0, 81U), 2.0F - 4.4F * n);
        const vec3 to(frontX, 6.3F + 3.2F * hash01(i, 1, 0, 81U), 0.5F - 4.4F * n - 3.5F * hash01(i, 2, 0, 81U));
        append(mesh, cable(from, to, 0.5F + 0.6F * hash01(i, 3, 0, 81U), 0.014F), mat4(1.0F));
    }
    for (const float s : {-1.0F, 1.0F}) {  // along the fronts
        for (int i = 0; i < 6; ++i) {
            const float z = 8.0F - 9.0F * static_cast<float>(i);
            append(mesh, cable({s * (frontX - 0.22F), 6.1F, z}, {s * (frontX - 0.22F), 6.3F, z - 9.0F}, 0.25F, 0.012F),
                   mat4(1.0F));
        }
    }
    place(scene, "cables", rubber, mesh);
}

void addPipes(Scene& scene) {
    const uint32_t zinc = addMaterial(scene, plain("pipe", {0x6D7274, 0.4F, 0.7F}));
    Mesh pipe;
    const std::array<vec3, 5> line{vec3(0, 12.8F, 0.1F), vec3(0, 0.7F, 0.1F), vec3(0, 0.35F, 0.13F),
                                   vec3(0, 0.2F, 0.22F), vec3(0, 0.16F, 0.4F)};
    append(pipe, tube(line, 0.055F, 12), mat4(1.0F));
    for (int i = 0; i < 6; ++i) {
        append(pipe, cylinder(0.075F, 0.06F, 14), at({0, 0.9F + 2.1F * static_cast<float>(i), 0.1F}));
    }
    const uint32_t mesh = addMesh(scene, "pipe", zinc, pipe);
    for (const float z : {2.4F, -5.8F, -15.6F, -23.5F, -32.1F}) {
        place(scene, "left pipe", mesh, side(true, z));
    }
    for (const float z : {3.0F, -6.4F, -14.3F, -24.1F, -32.3F}) {
        place(scene, "right pipe", mesh, side(false, z));
    }
}

void addBins(Scene& scene) {
    static constexpr std::array<vec2, 10> outline{
        vec2(0, 0),         vec2(0.25F, 0),   vec2(0.27F, 0.03F), vec2(0.31F, 0.8F),  vec2(0.34F, 0.82F),
        vec2(0.34F, 0.86F), vec2(0.3F, 0.9F), vec2(0.18F, 0.97F), vec2(0.05F, 0.99F), vec2(0, 0.99F)};
    const uint32_t steel = addMaterial(scene, plain("bin", {0x5E6668, 0.32F, 0.9F}));
    Mesh bin;
    append(bin, lathe(outline, 40), mat4(1.0F));
    for (int i = 0; i < 24; ++i) {  // ribs
        const float a = 2.0F * pi * static_cast<float>(i) / 24.0F;
        append(bin, cylinder(0.012F, 0.74F, 6),
               between({0.263F * std::cos(a), 0.04F, 0.263F * std::sin(a)},
                       {0.308F * std::cos(a), 0.78F, 0.308F * std::sin(a)}));
    }
    const std::array<vec3, 5> handle{vec3(-0.08F, 0.98F, 0), vec3(-0.06F, 1.05F, 0), vec3(0, 1.07F, 0),
                                     vec3(0.06F, 1.05F, 0), vec3(0.08F, 0.98F, 0)};
    append(bin, tube(handle, 0.012F, 8), mat4(1.0F));
    const uint32_t mesh = addMesh(scene, "bin", steel, bin);
    for (const vec2 p :
         {vec2(-5.4F, 0.9F), vec2(-5.5F, -8.0F), vec2(4.9F, -0.4F), vec2(5.65F, -0.6F), vec2(5.5F, -16.5F)}) {
        place(scene, "bin", mesh, at({p.x, pavementY, p.y}));
    }
}

void addCrates(Scene& scene) {
    const uint32_t wood = addMaterial(scene, plain("crate", {0x8A6238, 0.7F}));
    Mesh crate;
    for (int side0 = 0; side0 < 4; ++side0) {
        for (int i = 0; i < 3; ++i) {
            append(crate, box({0.29F, 0.045F, 0.01F}),
                   turned(90.0F * static_cast<float>(side0)) * at({0, 0.06F + 0.115F * static_cast<float>(i), 0.29F}));
        }
    }
    append(crate, box({0.28F, 0.01F, 0.28F}), at({0, 0.02F, 0}));
    const uint32_t mesh = addMesh(scene, "crate", wood, crate);
    static constexpr std::array<Hex, 4> fruits{0xD8822A, 0xB82A22, 0x8AA03A, 0xE0C050};
    int number = 0;
    for (const Hex color : fruits) {
        const uint32_t fruit =
            addMesh(scene, "fruit", addMaterial(scene, plain("fruit", {color, 0.35F})), sphere(0.055F, 12));
        const vec3 corner(-5.45F, pavementY + 0.45F, -2.6F - 0.68F * static_cast<float>(number));
        place(scene, "crate", mesh, at(corner - vec3(0, 0.38F, 0)));
        place(scene, "crate", mesh, at(corner));
        for (int i = 0; i < 30; ++i) {
            const vec3 p(hash01(i, number, 0, 84U) - 0.5F, 0.62F + 0.16F * hash01(i, number, 1, 84U),
                         hash01(i, number, 2, 84U) - 0.5F);
            place(scene, "fruit", fruit, at(corner + p * vec3(0.46F, 0.5F, 0.46F)));
        }
        ++number;
    }
}

void addBalconies(Scene& scene) {
    const uint32_t iron = addMaterial(scene, plain("balcony", {0x16191B, 0.35F, 0.4F}));
    Mesh balcony;
    append(balcony, box({0.85F, 0.05F, 0.42F}), at({0, 0, 0.42F}));
    for (int i = 0; i <= 14; ++i) {
        append(balcony, cylinder(0.009F, 0.95F, 6), at({-0.82F + 1.64F * static_cast<float>(i) / 14.0F, 0, 0.81F}));
    }
    for (int i = 0; i < 6; ++i) {
        for (const float x : {-0.82F, 0.82F}) {
            append(balcony, cylinder(0.009F, 0.95F, 6), at({x, 0, 0.08F + 0.13F * static_cast<float>(i)}));
        }
    }
    const std::array<vec3, 4> rail{vec3(-0.82F, 0.95F, 0), vec3(-0.82F, 0.95F, 0.81F), vec3(0.82F, 0.95F, 0.81F),
                                   vec3(0.82F, 0.95F, 0)};
    append(balcony, tube(rail, 0.025F, 8), mat4(1.0F));
    const uint32_t mesh = addMesh(scene, "balcony", iron, balcony);
    for (int i = 0; i < 6; ++i) {
        const float y = 3.7F + 3.1F * static_cast<float>(i % 3) + 0.7F;
        place(scene, "balcony", mesh,
              side(false, -8.0F + 1.975F * static_cast<float>(i / 3) - 0.0F) * at({0.99F, y, 0}));
        place(scene, "balcony", mesh, side(true, -6.8F - 1.975F * static_cast<float>(i / 3)) * at({-0.5F, y, 0}));
    }
}

}  // namespace

void addThings(Scene& scene) {
    addRailings(scene);
    addCables(scene);
    addPipes(scene);
    addBins(scene);
    addCrates(scene);
    addBalconies(scene);
}

}  // namespace reflet::builtin::street
