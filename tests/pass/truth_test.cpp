// Screen-space tracing against the path tracer: where the screen has the data, the result must match.
#include "compare/compare.h"
#include "pass/harness.h"
#include "reference/reference.h"
#include "scene/builtin.h"
#include "support/swept_scenes.h"

#include <algorithm>

namespace reflet::test::truth_test {
namespace {

constexpr uvec2 size(80, 45);
constexpr uvec2 large(320, 180);

FloatImage flipped(const FloatImage& image) {
    FloatImage result = image;
    const size_t row = size_t(image.width) * image.channels.size();
    for (size_t y = 0; y < image.height; ++y) {
        std::copy_n(image.data.begin() + static_cast<ptrdiff_t>((image.height - 1 - y) * row), row,
                    result.data.begin() + static_cast<ptrdiff_t>(y * row));
    }
    return result;
}

View boxesView() {
    View view;
    view.camera = builtin::camera("eye", {0.5F, 1.6F, 5.0F}, {0, 0.4F, 0}, 50.0F);
    view.sun = builtin::sun(glm::normalize(vec3(-0.4F, -0.6F, -0.8F)), vec3(3.0F));
    return view;
}

void placeBoxes(Scene& scene) {
    const auto box = [&](const char* name, const vec3& color, const vec3& at, float degrees) {
        builtin::place(scene, name, builtin::addMaterial(scene, lambertMaterial(color)),
                       builtin::box({0.5F, 0.7F, 0.5F}), builtin::at(at) * builtin::turned(degrees));
    };
    box("red", {0.8F, 0.2F, 0.1F}, {-1.2F, 0.7F, 0}, 20.0F);
    box("green", {0.2F, 0.7F, 0.2F}, {0.4F, 0.7F, -0.6F}, -35.0F);
    box("blue", {0.2F, 0.3F, 0.8F}, {1.6F, 0.7F, 0.4F}, 50.0F);
    builtin::place(scene, "wall", builtin::addMaterial(scene, lambertMaterial(vec3(0.6F))),
                   builtin::patch({{0, 1.5F, -2}, {4, 0, 0}, {0, 1.5F, 0}, {1, 1}, {1, 1}}));
}

// A camera mirrored at the plane, without the mirror, sees what the mirror shows, upside down.
TEST(Truth, AFlatMirrorShowsThePathTracersFlippedPictureWhereTheScreenKnowsIt) {
    const View view = boxesView();
    Material mirror = lambertMaterial(vec3(1.0F));
    mirror.metallic = 1.0F;
    mirror.roughness = 0.0F;
    Scene scene = sceneOf(mirror, builtin::ground({4, 4}, {1, 1}, {1, 1}));
    placeBoxes(scene);
    const Pictures p =
        render(scene, view, large, settingsOf({"diffuse.rays=0", "trace_screen.light=direct"}), {"indirect_specular"});

    Scene withoutMirror;
    placeBoxes(withoutMirror);
    View below = view;
    below.camera.position.y *= -1.0F;
    below.camera.target.y *= -1.0F;
    const ReferencePicture truth =
        traceReference(withoutMirror, below, large, {.bounces = 0, .samples = 16, .filter = PixelFilter::center});

    // The screen has the data if the camera sees the hit point, too.
    const ReferencePicture seen = traceReference(
        scene, view, large, {.bounces = 1, .samples = 16, .filter = PixelFilter::center, .visibleOnly = true});
    const FloatImage expected = flipped(truth.direct);
    // A hit is a whole pixel of the screen: at the edges of what is reflected it may be the wrong one of two.
    const auto isEdge = [&](size_t i) {
        const auto differs = [&](size_t j) {
            return std::abs(expected.data[3 * i] - expected.data[3 * j]) > 0.05F * expected.data[3 * i];
        };
        return differs(i - 1) || differs(i + 1) || differs(i - large.x) || differs(i + large.x);
    };
    CompareOptions options;
    for (size_t i = 0; i < size_t(large.x) * large.y; ++i) {
        const float* e = &expected.data[3 * i];
        const float* s = &seen.indirectSpecular.data[3 * i];
        const unsigned x = i % large.x;
        const auto y = static_cast<unsigned>(i / large.x);
        const bool inside = x > 0 && y > 0 && x + 1 < large.x && y + 1 < large.y;
        options.mask.push_back(e[0] > 0.0F && inside && !isEdge(i) && std::abs(s[0] - e[0]) < 0.05F * e[0] &&
                               std::abs(s[2] - e[2]) < 0.05F * e[2]);
    }
    const Difference d = compareImages(p.images.at("indirect_specular"), expected, options).difference;
    RecordProperty("relative_mse", std::to_string(d.relativeMse));
    EXPECT_GT(d.pixels, 8000U);
    EXPECT_LT(d.relativeMse, 0.01);
    EXPECT_NEAR(d.bias, 0.0, 0.01);
    expectSilentValidation("mirror");
}

class VisibleOnly : public testing::TestWithParam<const char*> {};

// 256 rays a pixel: their noise is under a third of the error that is left.
// Over 5 s: many rays, so that noise does not hide a bias.
TEST_P(VisibleOnly, DiffuseLightOfOneBounceIsThatOfAPathTracerThatSeesWhatTheCameraSees) {
    const Scene scene = findBuiltinScene(GetParam())->make();
    const View view = defaultView(scene);
    const ReferencePicture truth =
        traceReference(scene, view, size, {.bounces = 1, .samples = 256, .visibleOnly = true});
    for (const char* mode : {"constant", "second_layer"}) {
        const Pictures p = render(scene, view, size,
                                  settingsOf({"diffuse.rays=256", "specular.rays=0", "trace_screen.light=direct",
                                              std::string("trace_screen.thickness_mode=") + mode}),
                                  {"indirect_diffuse"});
        const Difference d = compareImages(p.images.at("indirect_diffuse"), truth.indirectDiffuse, {}).difference;
        RecordProperty(std::string("relative_mse_") + mode, std::to_string(d.relativeMse));
        RecordProperty(std::string("bias_") + mode, std::to_string(d.bias));
        EXPECT_LT(d.relativeMse, 0.02) << mode;
        EXPECT_NEAR(d.bias, 0.0, 0.08) << mode;  // with hits behind silhouettes: 0.5 in the cave
    }
}

INSTANTIATE_TEST_SUITE_P(Scenes, VisibleOnly, testing::Values("cubes", "cornell", "cave"),
                         [](const auto& scene) { return std::string(scene.param); });

class Energy : public testing::TestWithParam<std::string> {};

// Over 5 s: noise must be far below the 2 % that are tested.
TEST_P(Energy, IsAtMostTwoPercentAboveTheTruthWithOneBounceAndWithAll) {
    const Scene scene = findBuiltinScene(GetParam())->make();
    View view = defaultView(scene);
    view.camera.apertureRadius = 0.0F;  // it is about light, not about blur
    for (const bool one : {true, false}) {
        const ReferencePicture truth =
            traceReference(scene, view, size,
                           {.bounces = one ? 1U : ReferenceOptions::unlimited,
                            .samples = 64,
                            .filter = PixelFilter::center});  // as the frame: lamps may be smaller than a pixel
        const Pictures p = render(scene, view, size,
                                  settingsOf({"diffuse.rays=16", "specular.rays=16",
                                              std::string("trace_screen.light=") + (one ? "direct" : "previous")}),
                                  {"final"}, one ? 1 : 6);
        const Difference d = compareImages(p.images.at("final"), truth.final, {}).difference;
        // Glass: 1.8 % on llvmpipe, 2.1 % on a GPU.
        EXPECT_LT(d.bias, GetParam() == "glass" ? 0.022 : 0.02) << (one ? "one bounce" : "all bounces");
        RecordProperty(one ? "bias_one_bounce" : "bias_all_bounces", std::to_string(d.bias));
    }
}

INSTANTIATE_TEST_SUITE_P(Scenes, Energy, testing::ValuesIn(sweptScenes()),
                         [](const auto& chosen) { return nameInTests(chosen.param); });

}  // namespace
}  // namespace reflet::test::truth_test
