// Reflections are blurred by the distance of the image that they show: circles of confusion of plane and curved
// mirrors, and of surfaces that are none.
#include "capture/texels.h"
#include "device/device.h"
#include "device/frame.h"
#include "effects/depth_of_field/depth_of_field.h"
#include "effects/direct/direct.h"
#include "renderer/view_params.h"
#include "support/device_fixture.h"

#include <glm/gtc/packing.hpp>

namespace reflet::test::depth_of_field_reflections_test {
namespace {

constexpr uvec2 size(64, 48);
constexpr float wall = 4.0F;  // metres before the camera, which looks along -z

class DepthOfFieldReflections : public DeviceTest {};

struct Mirror {
    float hitDistance = 4.0F;
    float roughness = 0.0F;
    float metallic = 1.0F;
    float reflected = 1.0F;  // radiance
    float lit = 1.0F;
    float radius = 0.0F;  // of a sphere whose normals it has; positive: convex; 0: plane
    uint32_t scale = 1;   // of the lobe's images
    float focus = wall;
    bool orthographic = false;
    bool enabled = true;
};

Camera cameraOf(const Mirror& m) {
    Camera camera;
    camera.position = vec3(0.0F);
    camera.target = vec3(0.0F, 0.0F, -1.0F);
    camera.fovY = glm::radians(20.0F);
    if (m.orthographic) {
        camera.orthographicHeight = 1.0F;
    }
    return camera;
}

uint32_t packed(const vec3& n) {
    return glm::packSnorm2x16(vec2(n) / (std::abs(n.x) + std::abs(n.y) + std::abs(n.z)));
}

class MirrorRun {
public:
    explicit MirrorRun(gpu::Device& device) : frame_(device) {}

    /// The circle of confusion in the middle of the picture.
    float operator()(const Mirror& m) {
        const ViewParams view = makeViewParams(cameraOf(m), size, 0, 0);
        const vec4 onWall = view.worldToClip * vec4(0.0F, 0.0F, -wall, 1.0F);
        const auto filled = [&](const char* name, VkFormat format, uvec2 imageSize, auto&& texel) {
            std::vector<decltype(texel(vec2()))> texels;
            for (uint32_t i = 0; i < imageSize.x * imageSize.y; ++i) {
                texels.push_back(texel((vec2(i % imageSize.x, i / imageSize.x) + 0.5F) / vec2(imageSize) - 0.5F));
            }
            const gpu::Image made = frame_.image(name, format, imageSize);
            frame_.upload(made, std::as_bytes(std::span(texels)));
            return made;
        };
        const auto normalAt = [&](vec2 fromMiddle) {
            const float metresPerHeight = view.pixelAngle * view.size.y * wall;
            const vec2 at = fromMiddle * vec2(view.size.x / view.size.y, -1.0F) * metresPerHeight;
            return packed(m.radius == 0.0F ? vec3(0.0F, 0.0F, 1.0F) : glm::normalize(vec3(at / m.radius, 1.0F)));
        };
        const auto color = [](float grey, float alpha) {
            return [=](vec2) { return glm::packHalf4x16(vec4(vec3(grey), alpha)); };
        };
        const auto depthAt = [&](vec2) { return onWall.z / onWall.w; };
        constexpr VkFormat half4 = VK_FORMAT_R16G16B16A16_SFLOAT;

        frame_.begin();
        GBuffer g;
        g.depth = filled("depth", VK_FORMAT_R32_SFLOAT, size, depthAt);
        g.normal = filled("normal", VK_FORMAT_R32_UINT, size, normalAt);
        g.geometricNormal = filled("geometric_normal", VK_FORMAT_R32_UINT, size, [](vec2) {
            return packed({0.0F, 0.0F, 1.0F});
        });
        g.baseColor = filled("base_color", half4, size, color(1.0F, 1.0F));
        g.material = filled("material", half4, size,
                            [&](vec2) { return glm::packHalf4x16(vec4(m.roughness, m.metallic, 1.0F, 0.0F)); });
        LobeLight specular;
        const uvec2 traced = size / m.scale;
        specular.from.scale = m.scale;
        specular.from.g.depth = filled("lobe_depth", VK_FORMAT_R32_SFLOAT, traced, depthAt);
        specular.from.g.normal = filled("lobe_normal", VK_FORMAT_R32_UINT, traced, normalAt);
        specular.radiance = filled("radiance", half4, traced, color(m.reflected, m.hitDistance));
        const gpu::Image lit = filled("lit", half4, size, color(m.lit, 1.0F));
        DofSettings settings;
        settings.maxRadius = 0.25F;
        settings.reflections = m.enabled ? 1U : 0U;
        const Lens lens{.apertureRadius = aperture, .focusDistance = m.focus};
        const Reflections reflections{g, specular, lit, ggxTable(frame_, ggx_)};
        const DofInputs in{lit, g.depth, {}, view, lens, settings, reflections};
        const gpu::Readback copy = frame_.readback(depthOfField(frame_, coc_, in).coc);
        frame_.submit();
        frame_.wait();
        const std::vector<vec4> coc = decodeTexels(VK_FORMAT_R32_SFLOAT, frame_.bytes(copy));
        pixelAngle_ = view.pixelAngle;
        return coc[size.y / 2 * size.x + size.x / 2].x;
    }

    /// Of something at a distance, in the view of the last run: in pixels, by the thin lens.
    float expected(const Mirror& m, float z) const {
        const float atFocus = m.orthographic ? aperture * (z / m.focus - 1.0F) : aperture * (1.0F / m.focus - 1.0F / z);
        return atFocus / pixelAngle_;
    }

    static constexpr float aperture = 0.1F;

private:
    gpu::KeptImage ggx_{"ggx"};
    gpu::HistoryImage coc_{"circle_of_confusion"};
    gpu::Frame frame_;
    float pixelAngle_ = 1.0F;
};

TEST_F(DepthOfFieldReflections, APlaneMirrorsImageIsAtTheHitDistanceBehindIt) {
    MirrorRun run(device());
    for (const uint32_t scale : {1U, 2U}) {
        for (const float hit : {0.5F, 4.0F, 40.0F}) {
            const Mirror m{.hitDistance = hit, .scale = scale};
            const float radius = run(m);
            EXPECT_NEAR(radius, run.expected(m, wall + hit), 0.01F * run.expected(m, wall + hit))
                << hit << ' ' << scale;
        }
    }
    const Mirror focused{.hitDistance = 4.0F, .focus = 8.0F};
    EXPECT_NEAR(run(focused), 0.0F, 0.02F);
    const Mirror orthographic{.hitDistance = 2.0F, .orthographic = true};
    const float inOrthographic = run(orthographic);
    EXPECT_NEAR(inOrthographic, run.expected(orthographic, 6.0F), 0.05F);
}

TEST_F(DepthOfFieldReflections, ACurvedMirrorsImageFollowsTheMirrorEquation) {
    MirrorRun run(device());
    for (const float radius : {1.0F, 6.0F, -20.0F}) {
        const Mirror m{.hitDistance = 4.0F, .radius = radius};
        const float image = 1.0F / (1.0F / m.hitDistance + 2.0F / radius);
        const float got = run(m);
        EXPECT_NEAR(got, run.expected(m, wall + image), 0.04F * run.expected(m, wall + image)) << radius;
    }
    // A real image in front of the mirror: its focus is 1 m before it, and the image at 4/3 m.
    const Mirror concave{.hitDistance = 4.0F, .radius = -2.0F};
    const float got = run(concave);
    const float expected = run.expected(concave, wall - 4.0F / 3.0F);
    EXPECT_LT(expected, 0.0F);
    EXPECT_NEAR(got, expected, -0.05F * expected);
}

TEST_F(DepthOfFieldReflections, WhatIsNoMirrorHasItsOwnDistance) {
    MirrorRun run(device());
    EXPECT_NEAR(run({.roughness = 0.6F}), 0.0F, 0.01F);
    EXPECT_NEAR(run({.metallic = 0.0F}), 0.0F, 0.01F);  // reflects 4 %
    EXPECT_NEAR(run({.reflected = 0.1F}), 0.0F, 0.01F);
    EXPECT_NEAR(run({.enabled = false}), 0.0F, 0.01F);
    const Mirror blackFloor{.metallic = 0.0F, .lit = 0.045F};  // reflects little, and all of its light is that
    EXPECT_NEAR(run(blackFloor), run.expected(blackFloor, 8.0F), 0.02F);
}

}  // namespace
}  // namespace reflet::test::depth_of_field_reflections_test
