// Exact results: the contents of the G-buffer, and direct light on planes and spheres.
#include "pass/harness.h"

#include <algorithm>
#include <cmath>

namespace reflet::test::direct_test {
namespace {

constexpr uvec2 size(160, 90);
const std::vector<std::string> lambert{"materials.lambert_only=true", "diffuse.rays=0", "specular.rays=0"};

TEST(GBuffer, DepthOfAPlaneIsItsDistanceAlongTheView) {
    const View view = viewFrom({0, 2, 6}, {0, 0, 0});
    const Scene scene = sceneOf(lambertMaterial(vec3(0.5F)), builtin::ground({50, 50}, {1, 1}, {1, 1}));
    const Pictures p = render(scene, view, size, settingsOf(lambert), {"depth"});
    const vec3 forward = glm::normalize(view.camera.target - view.camera.position);
    unsigned seen = 0;
    const auto distanceAlong = [&](const vec3& d) { return -view.camera.position.y / d.y * glm::dot(d, forward); };
    for (unsigned y = 0; y < size.y; ++y) {
        for (unsigned x = 0; x < size.x; ++x) {
            const vec3 d = pixelDirection(view.camera, size, x, y);
            const float t = -view.camera.position.y / d.y;
            const vec3 hit = view.camera.position + t * d;
            if (t < 0.0F || std::max(std::abs(hit.x), std::abs(hit.z)) > 49.0F) {
                continue;
            }
            const float expected = distanceAlong(d);
            // 1 / distance is linear on the screen, and vertices lie on a grid below the pixel (shaders/subpixel.glsl).
            const float step =
                std::abs(1.0F / expected - 1.0F / distanceAlong(pixelDirection(view.camera, size, x, y + 1)));
            const float slack = std::max(2e-4F * expected, expected * expected * step / 256.0F);
            ASSERT_NEAR(p.value("depth", x, y), expected, slack) << x << ", " << y;
            ++seen;
        }
    }
    EXPECT_GT(seen, size.x * size.y / 3);
    expectSilentValidation("depth");
}

TEST(GBuffer, NothingIsSeenWhereThereIsNothing) {
    View view = viewFrom({0, 2, 6}, {0, 4, 0});
    view.environment.radiance = {0.25F, 0.5F, 1.0F};
    const Scene scene = sceneOf(lambertMaterial(vec3(0.5F)), builtin::ground({1, 1}, {1, 1}, {1, 1}));
    const Pictures p = render(scene, view, size, settingsOf(lambert), {"depth", "normal", "direct", "final"});
    EXPECT_EQ(p.value("depth", 80, 0), 0.0F);
    EXPECT_EQ(p.color("normal", 80, 0), vec3(0.0F));
    EXPECT_EQ(p.color("direct", 80, 0), view.environment.radiance);
    EXPECT_EQ(p.color("final", 80, 0), view.environment.radiance);
}

TEST(GBuffer, NormalsOfASphereArePerpendicularToIt) {
    const View view = viewFrom({0, 0, 4}, {0, 0, 0});
    const Scene scene = sceneOf(lambertMaterial(vec3(0.5F)), builtin::sphere(1.0F, 96));
    const Pictures p = render(scene, view, size, settingsOf(lambert), {"depth", "normal", "geometric_normal"});
    unsigned seen = 0;
    for (unsigned y = 0; y < size.y; ++y) {
        for (unsigned x = 0; x < size.x; ++x) {
            if (!p.hasSurface(x, y)) {
                continue;
            }
            const vec3 expected = glm::normalize(p.position(x, y));
            EXPECT_GT(glm::dot(p.color("normal", x, y), expected), std::cos(glm::radians(0.6F))) << x << ", " << y;
            EXPECT_GT(glm::dot(p.color("geometric_normal", x, y), expected), std::cos(glm::radians(4.0F)));
            ++seen;
        }
    }
    EXPECT_GT(seen, 1000U);
}

TEST(GBuffer, MotionIsWhereAPointWasInTheLastFrame) {
    const Scene scene = sceneOf(lambertMaterial(vec3(0.5F)), builtin::ground({50, 50}, {1, 1}, {1, 1}));
    const View before = viewFrom({0.3F, 2.1F, 6}, {0.1F, 0, 0});
    const View now = viewFrom({0, 2, 6}, {0, 0, 0});
    EXPECT_EQ(rangeOf(render(scene, now, size, settingsOf(lambert), {"motion"}, 2).images.at("motion")).max, 0.0F)
        << "a still camera";
    const Pictures p = renderMoved(scene, before, now, size, settingsOf(lambert), {"motion", "depth"});
    const mat4 worldToClipBefore = makeViewParams(before.camera, size, 0, 0).worldToClip;
    for (unsigned y = size.y / 2; y < size.y; y += 4) {
        for (unsigned x = 0; x < size.x; x += 4) {
            const vec4 clip = worldToClipBefore * vec4(p.position(x, y), 1.0F);
            const vec2 uvBefore = 0.5F + 0.5F * vec2(clip) / clip.w;
            const vec2 expected = (vec2(x, y) + 0.5F) / vec2(size) - uvBefore;
            EXPECT_NEAR(p.value("motion", x, y, 0), expected.x, 2e-4F) << x << ", " << y;
            EXPECT_NEAR(p.value("motion", x, y, 1), expected.y, 2e-4F) << x << ", " << y;
        }
    }
}

TEST(DirectLight, OfAPlaneIsAlbedoOverPiTimesIrradianceTimesCosine) {
    View view = viewFrom({0, 3, 6}, {0, 0, 0});
    const vec3 toSun = glm::normalize(vec3(-0.4F, 0.9F, 0.2F));
    view.sun = builtin::sun(-toSun, vec3(glm::pi<float>(), 2.0F, 1.0F));
    const vec3 albedo(0.5F, 0.25F, 0.75F);
    const Scene scene = sceneOf(lambertMaterial(albedo), builtin::ground({50, 50}, {1, 1}, {1, 1}));
    const Pictures p = render(scene, view, size, settingsOf(lambert), {"direct", "albedo"});
    for (const unsigned y : {50U, 70U, 89U}) {
        const vec3 expected = p.color("albedo", 80, y) / glm::pi<float>() * view.sun.irradiance * toSun.y;
        for (int c = 0; c < 3; ++c) {
            EXPECT_NEAR(p.color("albedo", 80, y)[c], albedo[c], 0.002F * albedo[c]);
            // Half floats end after 11 bits.
            EXPECT_NEAR(p.color("direct", 80, y)[c], expected[c], 0.001F * expected[c]);
        }
    }
    expectSilentValidation("direct light");
}

TEST(DirectLight, OfASphereFollowsTheCosineAndEndsAtTheTerminator) {
    View view = viewFrom({0, 0, 4}, {0, 0, 0});
    const vec3 toSun = glm::normalize(vec3(0.5F, 0.6F, 0.6F));
    view.sun = builtin::sun(-toSun, vec3(glm::pi<float>()));
    const Scene scene = sceneOf(lambertMaterial(vec3(0.5F)), builtin::sphere(1.0F, 192));
    const Pictures p = render(scene, view, size, settingsOf(lambert), {"direct", "depth"});
    for (unsigned y = 0; y < size.y; ++y) {
        for (unsigned x = 0; x < size.x; ++x) {
            if (!p.hasSurface(x, y)) {
                continue;
            }
            const float cosine = glm::dot(glm::normalize(p.position(x, y)), toSun);
            if (std::abs(cosine) > 0.05F) {  // within it, single triangles face away from the sun
                EXPECT_NEAR(p.value("direct", x, y), 0.5F * std::max(cosine, 0.0F), 0.01F) << x << ", " << y;
            }
        }
    }
}

TEST(DirectLight, OfAPointLampFallsWithTheSquareOfItsDistance) {
    View view = viewFrom({0, 3, 6}, {0, 0, 0});
    Scene scene = sceneOf(lambertMaterial(vec3(0.5F)), builtin::ground({50, 50}, {1, 1}, {1, 1}));
    Lamp lamp;
    lamp.position = {0.5F, 2.0F, 0.0F};
    lamp.intensity = vec3(10.0F);
    scene.lamps.push_back(lamp);
    const Pictures p = render(scene, view, size, settingsOf(lambert), {"direct", "depth", "albedo"});
    for (unsigned y = 40; y < size.y; y += 7) {
        for (unsigned x = 0; x < size.x; x += 9) {
            const vec3 toLamp = lamp.position - p.position(x, y);
            const float square = glm::dot(toLamp, toLamp);
            const float cosine = toLamp.y / std::sqrt(square);
            const float expected = p.value("albedo", x, y) / glm::pi<float>() * 10.0F * cosine / square;
            EXPECT_NEAR(p.value("direct", x, y), expected, 0.005F * expected) << x << ", " << y;
        }
    }
}

TEST(DirectLight, EmissionIsWhatTheMaterialEmits) {
    const View view = viewFrom({0, 3, 6}, {0, 0, 0});
    Material material = lambertMaterial(vec3(0.0F));
    material.emissive = {3.0F, 0.5F, 0.25F};
    const Pictures p = render(sceneOf(material, builtin::ground({50, 50}, {1, 1}, {1, 1})), view, size,
                              settingsOf(lambert), {"direct"});
    for (int c = 0; c < 3; ++c) {
        EXPECT_NEAR(p.color("direct", 80, 70)[c], material.emissive[c], material.emissive[c] / 32.0F);
    }
}

}  // namespace
}  // namespace reflet::test::direct_test
