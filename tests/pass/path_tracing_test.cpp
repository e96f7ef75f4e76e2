// Path tracing on the device (preset pathtrace) against the path tracer on the CPU, and the means over frames.
#include "capture/show.h"
#include "compare/compare.h"
#include "pass/harness.h"
#include "reference/reference.h"
#include "renderer/presets.h"
#include "scene/builtin.h"
#include "support/device_fixture.h"

#include <algorithm>
#include <array>
#include <cstdio>
#include <map>

namespace reflet::test::path_tracing_test {
namespace {

constexpr uvec2 size(48, 27);

Settings pathTracing() {
    Settings settings;
    applyPreset(settings, "pathtrace");
    return settings;
}

class PathTracing : public DeviceTest, public testing::WithParamInterface<const char*> {
protected:
    /// The layers after each of these numbers of frames of one run.
    static std::vector<std::map<std::string, FloatImage>> after(const std::array<uint32_t, 2>& frames,
                                                                const Scene& scene, const View& view,
                                                                const std::vector<std::string>& layers) {
        Renderer renderer(device(), scene, [](const std::string&) {});
        std::vector<std::map<std::string, FloatImage>> all;
        for (uint32_t i = 1; i <= frames.back(); ++i) {
            std::vector<ShowReadback> readbacks;
            renderer.render(view, size, 0, pathTracing(), [&](gpu::Frame& f, const FrameImages& images) {
                for (const std::string& layer : layers) {
                    readbacks.push_back(requestShow(f, images, findShow(layer)));
                }
            });
            if (std::ranges::find(frames, i) != frames.end()) {
                auto& values = all.emplace_back();
                for (size_t k = 0; k < layers.size(); ++k) {
                    values[layers[k]] =
                        fetchValues(renderer.frame(), readbacks[k], makeViewParams(view.camera, size, 0, 0));
                }
            }
        }
        return all;
    }
};

// Over 5 s: the error falls slowly, so many frames are traced.
TEST_P(PathTracing, ComesNearerToTheReferenceAsTheNumberOfFramesGrows) {
    const Scene scene = findBuiltinScene(GetParam())->make();
    const View view = defaultView(scene);
    const ReferencePicture truth = traceReference(scene, view, size, {.samples = 768});
    const std::vector<std::string> layers{"direct", "indirect_diffuse"};
    const auto layersAfter = after({12, 48}, scene, view, layers);
    const auto differenceOf = [&](const std::map<std::string, FloatImage>& values, const char* layer,
                                  const FloatImage& expected) {
        const Difference d = compareImages(values.at(layer), expected, {}).difference;
        std::printf("%s %s: relative MSE %.5f, bias %+.4f\n", GetParam(), layer, d.relativeMse, d.bias);
        return d;
    };
    for (const auto& [layer, expected] :
         {std::pair("direct", &truth.direct), std::pair("indirect_diffuse", &truth.indirectDiffuse)}) {
        const Difference few = differenceOf(layersAfter[0], layer, *expected);
        const Difference many = differenceOf(layersAfter[1], layer, *expected);
        // A quarter, were both without bias: of the sun in mirrors, paths find hardly anything.
        EXPECT_LT(many.relativeMse, 0.42 * few.relativeMse) << layer;
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
