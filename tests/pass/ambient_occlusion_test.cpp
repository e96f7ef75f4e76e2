// Ambient occlusion by slices: nothing is darkened by itself, walls and grooves cover what their form factor says, and
// it dims only prefiltered light. Diffuse light by slices: light is neither made nor lost.
#include "compare/compare.h"
#include "pass/harness.h"
#include "reference/reference.h"

#include <cmath>
#include <functional>

namespace reflet::test::ambient_occlusion_test {
namespace {

constexpr uvec2 size(200, 112);

Settings with(std::vector<std::string> assignments) {
    assignments.insert(assignments.begin(), {"diffuse.rays=0", "specular.rays=0", "ao.slices=4", "ao.steps=16"});
    return settingsOf(assignments);
}

Scene openGround() {
    return sceneOf(lambertMaterial(vec3(0.5F)), builtin::ground({40, 40}, {1, 1}, {1, 1}));
}

void addBox(Scene& scene, const vec3& half, const vec3& position) {
    builtin::place(scene, "box", 0, builtin::box(half), builtin::at(position));
}

/// Mean over the pixels on the ground for which `where` holds, and of what `expected` says there.
struct Means {
    double seen = 0.0;
    double expected = 0.0;
    unsigned count = 0;
};

Means onGround(const Pictures& p, const std::function<bool(const vec3&)>& where,
               const std::function<double(const vec3&)>& expected) {
    Means sum;
    for (unsigned y = 0; y < p.size.y; ++y) {
        for (unsigned x = 0; x < p.size.x; ++x) {
            const vec3 at = p.hasSurface(x, y) ? p.position(x, y) : vec3(0, 9, 0);
            if (std::abs(at.y) < 0.002F && where(at)) {
                sum.seen += p.value("ambient_occlusion", x, y);
                sum.expected += expected(at);
                ++sum.count;
            }
        }
    }
    sum.seen /= sum.count;
    sum.expected /= sum.count;
    return sum;
}

// What a long wall of this height covers of a hemisphere whose base it stands on: the form factor of a plane at a right
// angle.
double coverOfWall(double distance, double height) {
    return 0.5 * (1.0 - distance / std::hypot(distance, height));
}

class Ao : public ::testing::TestWithParam<const char*> {};

INSTANTIATE_TEST_SUITE_P(Methods, Ao, ::testing::Values("horizon", "bitmask"),
                         [](const auto& of) { return std::string(of.param); });

TEST_P(Ao, ALonePlaneAndALoneSphereStayOpen) {
    Scene ball;
    ball.materials.push_back(lambertMaterial(vec3(0.5F)));
    builtin::place(ball, "ball", 0, builtin::sphere(1.0F, 64), builtin::at({0, 0, 0}));
    const Settings settings = with({std::string("ao.method=") + GetParam(), "ao.radius=3"});
    for (const float height : {0.3F, 2.0F, 30.0F}) {
        const Pictures p = render(openGround(), viewFrom({0, height, 8}, {0, 0, 0}), size, settings,
                                  {"ambient_occlusion", "bent_normal", "depth"});
        const Means ground = onGround(
            p, [](const vec3&) { return true; }, [](const vec3&) { return 1.0; });
        EXPECT_GT(ground.count, 1000U);
        EXPECT_GT(rangeOf(p.images.at("ambient_occlusion")).min, 0.99F) << "camera " << height << " m above the ground";
    }
    const Pictures p = render(ball, viewFrom({0, 1, 4}, {0, 0, 0}), size, settings, {"ambient_occlusion"});
    EXPECT_GT(rangeOf(p.images.at("ambient_occlusion")).min, 0.99F);
    expectSilentValidation("ambient occlusion");
}

TEST_P(Ao, AWallCoversItsFormFactor) {
    Scene scene = openGround();
    addBox(scene, {40, 0.5F, 0.5F}, {0, 0.5F, -0.5F});  // 1 m high, from z = 0 away from the camera
    const Pictures p = renderMean(scene, viewFrom({0, 2.5F, 3}, {0, 0, 0.5F}), size,
                                  with({std::string("ao.method=") + GetParam(), "ao.radius=30", "ao.thickness=1"}),
                                  {"ambient_occlusion", "depth"}, 16);
    for (const float z : {0.1F, 0.3F, 0.7F, 1.2F}) {
        const Means m = onGround(
            p, [&](const vec3& at) { return std::abs(at.z - z) < 0.05F && std::abs(at.x) < 0.5F; },
            [](const vec3& at) { return 1.0 - coverOfWall(at.z, 1.0); });
        EXPECT_GT(m.count, 20U);
        EXPECT_NEAR(m.seen, m.expected, 0.03 * m.expected) << z << " m from the wall";
    }
}

TEST_P(Ao, AGrooveIsCoveredByBothItsWalls) {
    Scene scene = openGround();
    addBox(scene, {0.5F, 0.25F, 40}, {-1.0F, 0.25F, 0});  // 0.5 m high, at x = -0.5 and 0.5
    addBox(scene, {0.5F, 0.25F, 40}, {1.0F, 0.25F, 0});
    const Pictures p = renderMean(scene, viewFrom({0, 3, 0.1F}, {0, 0, -0.1F}), size,
                                  with({std::string("ao.method=") + GetParam(), "ao.radius=30", "ao.thickness=1"}),
                                  {"ambient_occlusion", "depth"}, 16);
    for (const float x : {-0.3F, 0.0F, 0.3F}) {
        const Means m = onGround(
            p, [&](const vec3& at) { return std::abs(at.x - x) < 0.05F && std::abs(at.z) < 0.5F; },
            [](const vec3& at) { return 1.0 - coverOfWall(0.5 - at.x, 0.5) - coverOfWall(0.5 + at.x, 0.5); });
        EXPECT_GT(m.count, 20U);
        EXPECT_NEAR(m.seen, m.expected, 0.03 * m.expected) << "at x = " << x;
    }
}

TEST_P(Ao, OccludersBeyondTheRadiusDoNotCount) {
    Scene scene = openGround();
    addBox(scene, {40, 0.5F, 0.5F}, {0, 0.5F, -0.5F});
    const Pictures p =
        render(scene, viewFrom({0, 2.5F, 3}, {0, 0, 0.5F}), size,
               with({std::string("ao.method=") + GetParam(), "ao.radius=0.5"}), {"ambient_occlusion", "depth"});
    const auto open = [](const vec3&) { return 1.0; };
    EXPECT_GT(onGround(
                  p, [](const vec3& at) { return at.z > 0.55F; }, open)
                  .seen,
              0.999);
    EXPECT_LT(onGround(
                  p, [](const vec3& at) { return at.z > 0.0F && at.z < 0.2F; }, open)
                  .seen,
              0.85);
}

TEST(AmbientOcclusion, AThinSlatShadesLessByBitmaskThanByHorizon) {
    Scene scene = openGround();
    addBox(scene, {5, 0.04F, 0.002F}, {0, 0.5F, 0});  // a slat above the ground, of few pixels, and open around it
    const View view = viewFrom({0, 1.2F, 3}, {0, 0.2F, -0.5F});
    const auto covered = [&](const Pictures& p) {
        return 1.0 - onGround(
                         p, [](const vec3& at) { return std::abs(at.x) < 1.0F && at.z > -1.0F && at.z < 0.5F; },
                         [](const vec3&) { return 1.0; })
                         .seen;
    };
    const auto byMethod = [&](const char* method) {
        return renderMean(scene, view, size,
                          with({std::string("ao.method=") + method, "ao.radius=2", "ao.thickness=0.004"}),
                          {"ambient_occlusion", "depth"}, 8);
    };
    const Pictures bitmask = byMethod("bitmask");
    Pictures reference = bitmask;
    ReferenceOptions options;
    options.samples = 256;
    options.bounces = 0;
    options.filter = PixelFilter::center;
    options.ambientOcclusion = true;
    options.aoRadius = 2;
    reference.images.at("ambient_occlusion") = traceReference(scene, view, size, options).ambientOcclusion;
    const double truth = covered(reference);
    EXPECT_NEAR(covered(bitmask), truth,
                0.35 * truth);  // its 2.6 pixels of height show as 2 or 3
    EXPECT_GT(covered(byMethod("horizon")), 4.0 * truth);
}

TEST(AmbientOcclusion, DimsPrefilteredLightAndNeitherDirectNorTracedLight) {
    Scene scene = openGround();
    addBox(scene, {40, 0.5F, 0.5F}, {0, 0.5F, -0.5F});
    View view = viewFrom({0, 2.5F, 3}, {0, 0, 0.5F});
    view.environment.radiance = vec3(1.0F);
    view.sun = builtin::sun(glm::normalize(vec3(0, -1, -1)), vec3(1.0F));
    const auto pictures = [&](const char* method, const char* distribution) {
        return render(
            scene, view, size,
            settingsOf({std::string("ao.method=") + method, std::string("diffuse.distribution=") + distribution,
                        "trace_screen.enabled=false", "ao.radius=30"}),
            method == std::string("none")
                ? std::vector<std::string>{"direct", "indirect_diffuse", "depth"}
                : std::vector<std::string>{"direct", "indirect_diffuse", "depth", "ambient_occlusion"});
    };
    const Pictures off = pictures("none", "normal");
    const Pictures on = pictures("bitmask", "normal");
    EXPECT_EQ(off.images.at("direct").data, on.images.at("direct").data);
    unsigned dimmed = 0;
    for (unsigned y = 0; y < size.y; ++y) {
        for (unsigned x = 0; x < size.x; ++x) {
            const float open = on.value("ambient_occlusion", x, y);
            if (on.hasSurface(x, y)) {
                ASSERT_NEAR(on.value("indirect_diffuse", x, y), open * off.value("indirect_diffuse", x, y), 2e-3F);
                dimmed += open < 0.8F ? 1 : 0;
            }
        }
    }
    EXPECT_GT(dimmed, 300U);
    EXPECT_EQ(pictures("none", "cosine").images.at("indirect_diffuse").data,
              pictures("bitmask", "cosine").images.at("indirect_diffuse").data);
}

TEST(AmbientOcclusion, AtReducedResolutionIsNearlyTheSame) {
    Scene scene = openGround();
    addBox(scene, {0.5F, 0.5F, 0.5F}, {0, 0.5F, 0});
    const auto mean = [&](const char* downsample) {
        return renderMean(scene, viewFrom({1.5F, 1.5F, 2.5F}, {0, 0.3F, 0}), size,
                          with({"ao.method=bitmask", std::string("ao.downsample=") + downsample}),
                          {"ambient_occlusion"}, 16)
            .images.at("ambient_occlusion");
    };
    const FloatImage full = mean("1");
    for (const char* downsample : {"2", "4"}) {
        const FloatImage coarse = mean(downsample);
        double difference = 0.0;
        for (size_t i = 0; i < full.data.size(); ++i) {
            difference += std::abs(full.data[i] - coarse.data[i]);
        }
        EXPECT_LT(difference / static_cast<double>(full.data.size()), 0.01) << downsample;
    }
}

// In a white environment, open ground beside white walls that glow as much as the environment sees the same light from
// all directions.
TEST(DiffuseSlices, LightThatIsTheSameEverywhereStaysThat) {
    Scene scene = openGround();
    Material glow = lambertMaterial(vec3(0.0F));
    glow.emissive = vec3(1.0F);
    scene.materials.push_back(glow);
    builtin::place(scene, "wall", 1, builtin::box({3, 1, 0.5F}), builtin::at({0, 1, -1.5F}));
    View view = viewFrom({0, 2, 4}, {0, 0, 0});
    view.environment.radiance = vec3(1.0F);
    const Pictures p = renderMean(scene, view, size,
                                  settingsOf({"diffuse.method=slices", "diffuse.rays=2", "specular.rays=0",
                                              "environment.occluded_weight=1", "trace_screen.light=direct"}),
                                  {"diffuse_radiance", "depth"}, 1);
    for (unsigned y = size.y / 2; y < size.y; ++y) {
        for (unsigned x = 0; x < size.x; ++x) {
            if (p.hasSurface(x, y) && std::abs(p.position(x, y).y) < 0.002F) {
                // Black surfaces (the ground itself has only indirect light) are below its horizon.
                // Two slices a pixel: at the wall's foot a few take it for 2 % too low.
                ASSERT_NEAR(p.value("diffuse_radiance", x, y), 1.0F, 0.02F) << x << ' ' << y;
            }
        }
    }
    expectSilentValidation("diffuse light by slices");
}

TEST(DiffuseSlices, AGlowingWallLightsTheGroundByItsFormFactor) {
    Scene scene = openGround();
    Material glow = lambertMaterial(vec3(0.0F));
    glow.emissive = vec3(1.0F);
    scene.materials.push_back(glow);
    builtin::place(scene, "wall", 1, builtin::box({40, 0.5F, 0.5F}), builtin::at({0, 0.5F, -0.5F}));
    // At once, and by lists. The picture shows the wall to 3.3 m at each side: 3 % less, unless probes answer there.
    for (const auto& [probes, share] :
         {std::pair("probes.enabled=false", 0.97), std::pair("probes.enabled=true", 1.0)}) {
        View view = viewFrom({0, 2.5F, 3}, {0, 0, 0.5F});
        view.environment.radiance = vec3(0.0F);
        const Pictures p =
            renderMean(scene, view, size,
                       settingsOf({"diffuse.method=slices", "diffuse.rays=2", "diffuse.slice_steps=16",
                                   "specular.rays=0", "trace_screen.light=direct", "probes.resolution=32", probes}),
                       {"diffuse_radiance", "depth"}, 16);
        for (const float z : {0.3F, 0.7F, 1.2F}) {
            double seen = 0.0;
            double expected = 0.0;
            unsigned count = 0;
            for (unsigned y = 0; y < size.y; ++y) {
                for (unsigned x = 0; x < size.x; ++x) {
                    const vec3 at = p.hasSurface(x, y) ? p.position(x, y) : vec3(0, 9, 0);
                    if (std::abs(at.y) < 0.002F && std::abs(at.z - z) < 0.05F && std::abs(at.x) < 0.3F) {
                        seen += p.value("diffuse_radiance", x, y);
                        expected += coverOfWall(at.z, 1.0);
                        ++count;
                    }
                }
            }
            ASSERT_GT(count, 20U);
            EXPECT_NEAR(seen / expected, share, 0.06) << z << " m from the wall, " << probes;
        }
    }
}

}  // namespace
}  // namespace reflet::test::ambient_occlusion_test
