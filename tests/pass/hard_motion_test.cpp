// Temporal antialiasing where things, light and the sky move: the last frame of a sequence shows what the same moment
// shows at rest.
#include "compare/compare.h"
#include "pass/harness.h"
#include "scene/builtin/animate.h"

#include <fmt/format.h>

#include <memory>

namespace reflet::test::hard_motion_test {
namespace {

using builtin::at;

constexpr uvec2 size(96, 54);
constexpr double step = 1.0 / 24.0;
constexpr int moves = 7;

Settings withScale(const char* scale) {
    return settingsOf({"temporal.enabled=on", fmt::format("temporal.scale={}", scale), "diffuse.rays=0",
                       "specular.rays=0", "shadow.filter=hard"});
}

// A wall of tiles of this side [m]. facing: 1 or -1, along z.
Scene tiledWall(float side = 0.5F, float z = 0.0F, float facing = 1.0F) {
    Scene scene;
    const uint32_t dark = builtin::addMaterial(scene, lambertMaterial(vec3(0.06F)));
    const uint32_t light = builtin::addMaterial(scene, lambertMaterial(vec3(0.8F)));
    for (int i = 0; i < 12 * 8; ++i) {
        const vec3 middle{(-5.5F + float(i % 12)) * side, (-3.5F + float(i / 12)) * side, z};
        builtin::place(scene, fmt::format("tile {}", i), (i % 12 + i / 12) % 2 == 0 ? dark : light,
                       builtin::patch({.right = {0.5F * facing * side, 0, 0}, .up = {0, 0.5F * side, 0}}), at(middle));
    }
    return scene;
}

void slide(Scene& scene, int32_t node, float from, float z) {
    builtin::animate(scene, node,
                     {.target = Channel::Target::translation,
                      .interpolation = Interpolation::linear,
                      .times = {0.0F, 1.0F},
                      .values = {vec4(from, 0, z, 0), vec4(-from, 0, z, 0)}});
}

Scene boxBeforeWall(float alpha) {
    Scene scene = tiledWall();
    const int32_t node = builtin::addNode(scene, {1.5, 0, 0.6});
    slide(scene, node, 1.5F, 0.6F);
    Material red = lambertMaterial(vec3(0.7F, 0.1F, 0.05F));
    red.baseColor.a = alpha;
    red.blended = alpha < 1.0F;
    builtin::place(scene, "box", builtin::addMaterial(scene, red), builtin::box({0.25F, 0.5F, 0.1F}),
                   at({1.5F, 0, 0.6F}));
    scene.instances.back().node = node;
    return scene;
}

// Slides over a mirror.
Scene glowingBoxOverMirror() {
    Scene scene = tiledWall();
    Material metal = lambertMaterial(vec3(0.9F));
    metal.metallic = 1.0F;
    metal.roughness = 0.0F;
    builtin::place(scene, "mirror", builtin::addMaterial(scene, metal), builtin::ground({3, 3}, {1, 1}, {1, 1}),
                   at({0, -0.5F, 1.5F}));
    const int32_t node = builtin::addNode(scene, {1.5, 0, 0.6});
    slide(scene, node, 1.5F, 0.6F);
    Material red = lambertMaterial(vec3(0.7F, 0.1F, 0.05F));
    red.emissive = {20.0F, 16.0F, 8.0F};
    builtin::place(scene, "box", builtin::addMaterial(scene, red), builtin::box({0.2F, 0.2F, 0.2F}),
                   at({1.5F, 0, 0.6F}));
    scene.instances.back().node = node;
    return scene;
}

View before(double time) {
    View view;
    view.camera.position = {0, 0, 4};
    view.camera.target = {0, 0, 0};
    view.environment.radiance = vec3(0.6F);
    view.sun.direction = glm::normalize(vec3(0.1F, -0.3F, -1.0F));
    view.sun.irradiance = vec3(3.0F);
    view.time = time;
    return view;
}

// Of the last of some frames that move after some at rest, against the mean of many at rest.
double errorInMotion(const Scene& scene, const std::vector<View>& path, const Settings& settings) {
    const Pictures moving = renderPath(scene, path, size, settings, {"final"}).back();
    Settings mean = settings;
    mean.temporal.enabled = 0;
    mean.accumulate.enabled = 1;
    const Pictures still = render(scene, path.back(), size, mean, {"final"}, 64);
    return compareImages(moving.images.at("final"), still.images.at("final"), {}).difference.relativeMse;
}

std::vector<View> inTime(double from) {
    std::vector<View> path(16, before(from));
    for (int i = 1; i <= moves; ++i) {
        path.push_back(before(from + step * double(i)));
    }
    return path;
}

class HardMotion : public testing::TestWithParam<const char*> {
protected:
    void expectAtMost(double limit, const Scene& scene, const std::vector<View>& path) {
        const double error = errorInMotion(scene, path, withScale(GetParam()));
        RecordProperty("error", fmt::format("{}", error));
        EXPECT_LT(error, limit);
    }
    [[nodiscard]] bool isUpscaled() const { return GetParam() != std::string("1"); }
};

TEST_P(HardMotion, ABoxLeavesNoTrail) {
    expectAtMost(isUpscaled() ? 0.11 : 0.02, boxBeforeWall(1.0F), inTime(0.3));
}

TEST_P(HardMotion, ABlendedBoxKeepsItsShape) {
    expectAtMost(isUpscaled() ? 0.065 : 0.012, boxBeforeWall(0.6F), inTime(0.3));
}

TEST_P(HardMotion, LightFollowsALamp) {
    Scene scene = tiledWall();
    const int32_t node = builtin::addNode(scene, {2, 0, 1});
    slide(scene, node, 2.0F, 1.0F);
    scene.lamps.push_back({.name = "lamp", .intensity = vec3(4.0F), .node = node});
    std::vector<View> path = inTime(0.3);
    for (View& view : path) {
        view.sun.irradiance = vec3(0.0F);
    }
    expectAtMost(isUpscaled() ? 0.06 : 0.02, scene, path);
}

TEST_P(HardMotion, StarsStayWhileTheCameraTurns) {
    auto sky = std::make_shared<FloatImage>(FloatImage{512, 256, {"R", "G", "B"}, {}});
    sky->data.assign(size_t{3} * 512 * 256, 0.02F);
    for (size_t i = 0; i < 3000; ++i) {
        const size_t texel = i * 7919 % (size_t{512} * 256);
        std::fill_n(sky->data.begin() + std::ptrdiff_t(3 * texel), 3, 1.0F);
    }
    Scene scene = boxBeforeWall(1.0F);
    scene.instances.erase(scene.instances.begin(), scene.instances.end() - 1);
    std::vector<View> path;
    for (int i = 0; i < 16 + moves; ++i) {
        View view = before(0.0);
        const float angle = glm::radians(0.8F) * float(std::max(i - 16, 0));
        view.camera.target = view.camera.position + vec3(std::sin(angle), 0, -std::cos(angle));
        view.environment = {.image = sky};
        path.push_back(view);
    }
    expectAtMost(0.02, scene, path);
}

// From above, so that the mirror shows the box in front of the wall.
std::vector<View> overMirror() {
    std::vector<View> path = inTime(0.3);
    for (View& view : path) {
        view.camera.position = {0, 0.8F, 3.6F};
    }
    return path;
}

// With a history that follows the mirror, the errors are 0.062 and 19.
TEST_P(HardMotion, AGlowingThingsImageLeavesNoTrail) {
    Settings settings = withScale(GetParam());
    settings.specular.rays = 1;
    const double error = errorInMotion(glowingBoxOverMirror(), overMirror(), settings);
    RecordProperty("error", fmt::format("{}", error));
    EXPECT_LT(error, isUpscaled() ? 1.0 : 0.045);
}

// A mirror turns about its middle and shows tiles behind the camera.
Scene turningMirror() {
    Scene scene = tiledWall(1.0F, 7.0F, -1.0F);
    const int32_t node = builtin::addNode(scene, {0, 0, 0});
    builtin::animate(scene, node,
                     {.target = Channel::Target::rotation,
                      .interpolation = Interpolation::linear,
                      .times = {0.0F, 1.0F},
                      .values = {builtin::rotation(-30.0, {0, 1, 0}), builtin::rotation(42.0, {0, 1, 0})}});
    Material metal = lambertMaterial(vec3(0.9F));
    metal.metallic = 1.0F;
    metal.roughness = 0.0F;
    builtin::place(scene, "mirror", builtin::addMaterial(scene, metal),
                   builtin::patch({.right = {1.2F, 0, 0}, .up = {0, 0.9F, 0}}));
    scene.instances.back().node = node;
    return scene;
}

// With a history that follows the mirror's surface, the error is 0.083 at half the resolution.
TEST_P(HardMotion, AMirrorThatTurnsShowsWhatItShowsNow) {
    Settings settings = withScale(GetParam());
    settings.specular.rays = 1;
    settings.traceScene.enabled = 1;
    const double error = errorInMotion(turningMirror(), inTime(0.2), settings);
    RecordProperty("error", fmt::format("{}", error));
    EXPECT_LT(error, isUpscaled() ? 0.05 : 0.005);
}

// Where it was at rest before, jitter had it in some frames and the wall in others, as if it were a thin bar.
TEST_P(HardMotion, WhatStartsToMoveLeavesNoLine) {
    Scene scene = sceneOf(lambertMaterial(vec3(0.1F)), builtin::patch({.right = {3, 0, 0}, .up = {0, 3, 0}}));
    const int32_t node = builtin::addNode(scene, {1.5, 0, 0.6});
    slide(scene, node, 1.5F, 0.6F);
    Material glowing = lambertMaterial(vec3(0.7F));
    glowing.emissive = vec3(8.0F);
    builtin::place(scene, "ball", builtin::addMaterial(scene, glowing), builtin::sphere(0.3F, 24), at({1.5F, 0, 0.6F}));
    scene.instances.back().node = node;
    std::vector<View> path(16, before(0.15));
    for (int i = 1; i <= 4; ++i) {
        path.push_back(before(0.15 + 3.0 * step * double(i)));
    }
    const Settings settings = withScale(GetParam());
    const Pictures moving = renderPath(scene, path, size, settings, {"final"}).back();
    const Pictures still = render(scene, path.back(), size, settings, {"final"}, 32);
    uint32_t line = 0;
    for (uint32_t y = 0; y < size.y; ++y) {
        for (uint32_t x = 58; x < 84; ++x) {  // where it was
            line += moving.value("final", x, y) > still.value("final", x, y) + 0.1F ? 1 : 0;
        }
    }
    RecordProperty("pixels", std::to_string(line));
    EXPECT_EQ(line, 0U);
}

INSTANTIATE_TEST_SUITE_P(Scales, HardMotion, testing::Values("1", "0.5"), [](const auto& scale) {
    return std::string(scale.param == std::string("1") ? "full" : "half");
});

}  // namespace
}  // namespace reflet::test::hard_motion_test
