// Rays from a coarser grid: the view of that grid, and that the light is the same.
#include "pass/harness.h"

#include "compare/compare.h"
#include "effects/lobe/ray_surfaces.h"
#include "renderer/view_params.h"
#include "scene/builtin.h"

#include <gtest/gtest.h>

namespace reflet::test::ray_surfaces_test {

namespace {

vec3 pointAt(const ViewParams& view, uvec2 pixel, float depth) {
    const vec2 ndc = 2.0F * (vec2(pixel) + 0.5F) * view.pixel - 1.0F;
    const vec4 p = view.clipToWorld * vec4(ndc, depth, 1.0F);
    return vec3(p) / p.w;
}

TEST(RaySurfaces, ABlocksPixelSeesWhatThePickedPixelOfThePictureSees) {
    const Camera perspective = defaultView(findBuiltinScene("cubes")->make()).camera;
    Camera orthographic = perspective;
    orthographic.orthographicHeight = 5.0F;
    for (const Camera& camera : {perspective, orthographic}) {
        for (const uvec2 size : {uvec2(320, 180), uvec2(97, 55), uvec2(4, 3)}) {
            const ViewParams view = makeViewParams(camera, size, 0, 0);
            for (uint32_t scale = 1; scale <= 4; ++scale) {
                const ViewParams blocks = viewOfBlocks(view, scale);
                ASSERT_EQ(uvec2(blocks.size), (size + scale - 1U) / scale);
                const uvec2 last = (size - 1U - blockPixelOffset(scale)) / scale;
                for (const uvec2 block : {uvec2(0), last, uvec2(last.x / 2, last.y / 3)}) {
                    const uvec2 picked = block * scale + blockPixelOffset(scale);
                    const vec3 expected = pointAt(view, picked, 0.02F);
                    const vec3 point = pointAt(blocks, block, 0.02F);
                    EXPECT_LT(glm::distance(point, expected), 1e-4F * glm::length(expected));
                    const vec4 clip = blocks.worldToClip * vec4(expected, 1.0F);
                    const vec2 pixel = (0.5F + 0.5F * vec2(clip) / clip.w) * blocks.size - 0.5F;
                    EXPECT_LT(glm::distance(pixel, vec2(block)), 0.01F);
                }
            }
        }
    }
}

TEST(RaySurfaces, IndirectLightIsTheSameFromACoarserGrid) {
    const Scene scene = findBuiltinScene("cornell")->make();
    constexpr uvec2 size{97, 55};  // blocks go over the picture's edges
    const std::vector<std::string> shows{"indirect_diffuse", "indirect_specular", "direct"};
    const auto picture = [&](const char* scale) {
        return renderMean(
            scene, defaultView(scene), size,
            settingsOf({"diffuse.rays=16", "specular.rays=16", "trace_screen.light=direct",
                        std::string("diffuse.downsample=") + scale, std::string("specular.downsample=") + scale}),
            shows, 8);
    };
    const Pictures full = picture("1");
    for (const char* scale : {"2", "3"}) {
        const Pictures coarse = picture(scale);
        EXPECT_EQ(coarse.images.at("direct").data, full.images.at("direct").data);
        const Difference diffuse =
            compareImages(coarse.images.at("indirect_diffuse"), full.images.at("indirect_diffuse"), {}).difference;
        EXPECT_LT(std::abs(diffuse.bias), 0.02) << scale;
        EXPECT_LT(diffuse.relativeMse, 0.01) << scale;
        const Difference specular =
            compareImages(coarse.images.at("indirect_specular"), full.images.at("indirect_specular"), {}).difference;
        EXPECT_LT(std::abs(specular.bias), 0.03) << scale;
        EXPECT_LT(specular.relativeMse, 0.02) << scale;
    }
    expectSilentValidation("coarser grids");
}

// Over 5 s: each source has pipelines of its own.
TEST(RaySurfaces, EverySourceAnswersRaysFromACoarserGrid) {
    const Scene scene = findBuiltinScene("mirror-hall")->make();
    constexpr uvec2 size{66, 38};
    const auto picture = [&](const char* scale) {
        return renderMean(
            scene, defaultView(scene), size,
            settingsOf({"planar.enabled=true", "trace_scene.enabled=true", "diffuse.rays=4", "specular.rays=4",
                        "trace_screen.light=direct", std::string("diffuse.downsample=") + scale,
                        std::string("specular.downsample=") + scale}),
            {"indirect_specular", "source"}, 4);
    };
    const Pictures full = picture("1");
    const Pictures coarse = picture("2");
    // Diffuse light there comes by way of mirrors that few rays meet: this few rays do not tell its mean.
    const Difference specular =
        compareImages(coarse.images.at("indirect_specular"), full.images.at("indirect_specular"), {}).difference;
    EXPECT_LT(std::abs(specular.bias), 0.05);
    // Who answers whom changes at edges only.
    EXPECT_LT(std::abs(compareImages(coarse.images.at("source"), full.images.at("source"), {}).difference.bias), 0.02);
    expectSilentValidation("coarser grids, every source");
}

}  // namespace
}  // namespace reflet::test::ray_surfaces_test
