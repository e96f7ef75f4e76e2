// Path tracing on the device (preset pathtrace) against the path tracer on the CPU, and the means over frames.
#include "compare/compare.h"
#include "pass/harness.h"
#include "reference/reference.h"
#include "renderer/presets.h"
#include "scene/builtin.h"

#include <cstdio>

namespace reflet::test::path_tracing_test {
namespace {

constexpr uvec2 size(64, 36);

Settings pathTracing() {
    Settings settings;
    applyPreset(settings, "pathtrace");
    return settings;
}

class PathTracing : public testing::TestWithParam<const char*> {};

// Over 5 s: the error falls slowly, so hundreds of frames are traced.
TEST_P(PathTracing, ComesNearerToTheReferenceAsTheNumberOfFramesGrows) {
    const Scene scene = findBuiltinScene(GetParam())->make();
    const View view = defaultView(scene);
    const ReferencePicture truth = traceReference(scene, view, size, {.samples = 1024});
    const std::vector<std::string> layers{"direct", "indirect_diffuse"};
    const Pictures after12 = render(scene, view, size, pathTracing(), layers, 12);
    const Pictures after48 = render(scene, view, size, pathTracing(), layers, 48);
    const auto differenceOf = [&](const Pictures& p, const char* layer, const FloatImage& expected) {
        const Difference d = compareImages(p.images.at(layer), expected, {}).difference;
        std::printf("%s %s: relative MSE %.5f, bias %+.4f\n", GetParam(), layer, d.relativeMse, d.bias);
        return d;
    };
    for (const auto& [layer, expected] :
         {std::pair("direct", &truth.direct), std::pair("indirect_diffuse", &truth.indirectDiffuse)}) {
        const Difference few = differenceOf(after12, layer, *expected);
        const Difference many = differenceOf(after48, layer, *expected);
        EXPECT_LT(many.relativeMse, 0.36 * few.relativeMse) << layer;  // a quarter, were both without bias
        EXPECT_LT(many.relativeMse, 0.03) << layer;
        EXPECT_NEAR(many.bias, 0.0, 0.015) << layer;
    }
    expectSilentValidation(GetParam());
}

INSTANTIATE_TEST_SUITE_P(Scenes, PathTracing, testing::Values("cornell", "cubes"));

TEST(Accumulate, StartsAnewWhenTheViewChanges) {
    const Scene scene = findBuiltinScene("cubes")->make();
    const View now = defaultView(scene);
    View before = now;
    before.camera.position += vec3(0.5F, 0.3F, 0.0F);
    const Settings settings = settingsOf(
        {"accumulate.enabled=on", "accumulate.jitter=off", "shadow.filter=hard", "diffuse.rays=0", "specular.rays=0"});
    const Pictures fresh = render(scene, now, size, settings, {"final"});
    const Pictures moved = renderMoved(scene, before, now, size, settings, {"final"}, 3);
    EXPECT_EQ(fresh.images.at("final").data, moved.images.at("final").data);
    EXPECT_NE(fresh.images.at("final").data, render(scene, before, size, settings, {"final"}).images.at("final").data);
}

TEST(Accumulate, IsTheMeanOfItsFrames) {
    const Scene scene = findBuiltinScene("cornell")->make();
    const View view = defaultView(scene);
    const Settings alone = settingsOf({"shadow.filter=hard", "diffuse.rays=1"});
    Settings together = alone;
    together.accumulate.enabled = 1;
    together.accumulate.jitter = 0;
    const Pictures mean = renderMean(scene, view, size, alone, {"indirect_diffuse"}, 5);
    const Pictures p = render(scene, view, size, together, {"indirect_diffuse"}, 5);
    const Difference d =
        compareImages(p.images.at("indirect_diffuse"), mean.images.at("indirect_diffuse"), {}).difference;
    EXPECT_LT(d.max, 1e-4);
    EXPECT_GT(rangeOf(p.images.at("indirect_diffuse")).max, 0.1F);
}

}  // namespace
}  // namespace reflet::test::path_tracing_test
