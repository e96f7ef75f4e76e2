// Glass in motion: temporal antialiasing follows its front, so that it does not smear.
#include "compare/compare.h"
#include "pass/harness.h"

#include <fmt/format.h>

namespace reflet::test::glass_motion_test {
namespace {

using builtin::at;

constexpr uvec2 size(96, 72);

// A ball in front of glowing bars.
Scene ballBeforeBars() {
    Scene scene;
    Material ball = lambertMaterial(vec3(1.0F));
    ball.roughness = 0.0F;
    ball.transmission = {.factor = 1.0F, .thickness = 1.4F};
    builtin::place(scene, "ball", builtin::addMaterial(scene, ball), builtin::sphere(0.7F, 64));
    for (int i = -12; i <= 12; ++i) {
        Material bar = lambertMaterial(vec3(0.0F));
        bar.emissive = i % 2 == 0 ? vec3(1.0F, 0.9F, 0.7F) : vec3(0.05F, 0.1F, 0.3F);
        builtin::place(scene, fmt::format("bar {}", i), builtin::addMaterial(scene, bar),
                       builtin::patch({.right = {0.25F, 0, 0}, .up = {0, 6, 0}}), at({0.5F * float(i), 0, -6}));
    }
    return scene;
}

View viewFrom(float x) {
    View view;
    view.camera.position = {x, 0.2F, 4};
    view.camera.target = {0.3F * x, 0, 0};
    view.camera.fovY = glm::radians(26.0F);
    return view;
}

// Mean of squares over the ball, of the last frame of a moving camera to what it sees at rest.
TEST(GlassMotion, ItDoesNotSmear) {
    const Scene scene = ballBeforeBars();
    const Settings settings =
        settingsOf({"temporal.enabled=true", "diffuse.rays=0", "specular.rays=0", "trace_scene.enabled=true"});
    std::vector<View> path;
    for (int i = 0; i < 16; ++i) {
        path.push_back(viewFrom(-0.3F + 0.04F * float(i)));
    }
    const Pictures moving = renderPath(scene, path, size, settings, {"final"}).back();
    const Pictures still = render(scene, path.back(), size, settings, {"final"}, 16);
    const Pictures shape = render(scene, path.back(), size, settingsOf({"transmission.layers=0"}), {"depth"});
    double sum = 0.0;
    int pixels = 0;
    for (unsigned i = 0; i < size.x * size.y; ++i) {
        const unsigned x = i % size.x;
        const unsigned y = i / size.x;
        if (shape.hasSurface(x, y) && glm::length(shape.position(x, y)) < 0.71F) {
            const vec3 difference = moving.color("final", x, y) - still.color("final", x, y);
            sum += glm::dot(difference, difference) / 3.0;
            ++pixels;
        }
    }
    ASSERT_GT(pixels, 300);
    RecordProperty("error", fmt::format("{}", sum / pixels));
    EXPECT_LT(sum / pixels, 0.025) << "0.04 if it followed what is behind the glass";
}

}  // namespace
}  // namespace reflet::test::glass_motion_test
