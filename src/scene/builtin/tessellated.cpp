// A room that looks the same at any number of triangles, to measure how cost depends on that number.
#include "scene/builtin/assemble.h"
#include "scene/builtin/scenes.h"

#include <array>
#include <charconv>
#include <cmath>

namespace reflet::builtin {
namespace {

// A room of five sides, without a front, and nine boxes of five: fifty flat sides of at least two triangles.
constexpr uint32_t minTriangles = 100;
constexpr uint32_t maxCuts = 100;

void addSide(Scene& scene, uint32_t material, Patch side, uint32_t cuts, const mat4& toWorld = mat4(1.0F)) {
    side.cells = glm::uvec2(cuts);
    place(scene, "side", material, patch(side), toWorld);
}

void addTessellatedRoom(Scene& scene, uint32_t cuts) {
    const uint32_t white = addMaterial(scene, plain("white", {0xD8D4CC}));
    const uint32_t red = addMaterial(scene, plain("red", {0xB8452F}));
    const uint32_t green = addMaterial(scene, plain("green", {0x4F8F4A}));
    const uint32_t floor = addMaterial(scene, plain("polished floor", {0x9A948C, 0.1F, 0.5F}));
    addSide(scene, floor, {{0, 0, 0}, {3, 0, 0}, {0, 0, -3}}, cuts);
    addSide(scene, white, {{0, 4, 0}, {3, 0, 0}, {0, 0, 3}}, cuts);
    addSide(scene, white, {{0, 2, -3}, {3, 0, 0}, {0, 2, 0}}, cuts);
    addSide(scene, red, {{-3, 2, 0}, {0, 0, -3}, {0, 2, 0}}, cuts);
    addSide(scene, green, {{3, 2, 0}, {0, 0, 3}, {0, 2, 0}}, cuts);
}

// Stands on the floor: no underside.
void addTessellatedBox(Scene& scene, uint32_t material, const vec3& half, uint32_t cuts, const mat4& toWorld) {
    const std::array<Patch, 5> sides{{{{half.x, half.y, 0}, {0, 0, -half.z}, {0, half.y, 0}},
                                      {{-half.x, half.y, 0}, {0, 0, half.z}, {0, half.y, 0}},
                                      {{0, 2 * half.y, 0}, {half.x, 0, 0}, {0, 0, -half.z}},
                                      {{0, half.y, half.z}, {half.x, 0, 0}, {0, half.y, 0}},
                                      {{0, half.y, -half.z}, {-half.x, 0, 0}, {0, half.y, 0}}}};
    for (const Patch& side : sides) {
        addSide(scene, material, side, cuts, toWorld);
    }
}

}  // namespace

std::optional<uint32_t> tessellatedTriangles(std::string_view name) {
    constexpr std::string_view prefix = "tessellated-";
    uint32_t triangles = 0;
    const char* end = name.data() + name.size();
    if (!name.starts_with(prefix)) {
        return std::nullopt;
    }
    const auto [rest, error] = std::from_chars(name.data() + prefix.size(), end, triangles);
    const auto cuts = static_cast<uint32_t>(std::lround(std::sqrt(triangles / minTriangles)));
    const bool whole = cuts > 0 && cuts <= maxCuts && cuts * cuts * minTriangles == triangles;
    return error == std::errc() && rest == end && whole ? std::optional(triangles) : std::nullopt;
}

Scene makeTessellated(uint32_t triangles) {
    const auto cuts = static_cast<uint32_t>(std::lround(std::sqrt(triangles / minTriangles)));
    Scene scene;
    scene.name = "tessellated";
    addTessellatedRoom(scene, cuts);
    const uint32_t painted = addMaterial(scene, plain("painted", {0xC9A85C, 0.6F}));
    const uint32_t metal = addMaterial(scene, plain("metal", {0xC0C4CC, 0.25F, 1.0F}));
    for (int i = 0; i < 9; ++i) {
        const vec3 foot(-1.8F + 1.8F * static_cast<float>(i % 3), 0.0F, -1.8F + 1.5F * static_cast<float>(i / 3));
        const float height = 0.35F + 0.12F * static_cast<float>((i * 4) % 9);
        addTessellatedBox(scene, i % 2 == 0 ? painted : metal, {0.35F, height, 0.35F}, cuts,
                          at(foot) * turned(static_cast<float>(i) * 23.0F));
    }
    scene.cameras.push_back(camera("main", {0.0F, 2.2F, 6.5F}, {0.0F, 1.4F, -1.0F}, 50));
    scene.sun = sun({0.35F, -0.75F, -0.6F}, {3.4F, 3.2F, 2.9F});
    scene.environment.radiance = {0.25F, 0.32F, 0.42F};
    return scene;
}

}  // namespace reflet::builtin
