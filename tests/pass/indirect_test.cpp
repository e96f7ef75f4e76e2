// Indirect light with known results: the furnace test, form factors, a mirror, and rays that must miss.
#include "pass/harness.h"

#include <algorithm>
#include <cmath>

namespace reflet::test::indirect_test {
namespace {

constexpr uvec2 size(160, 90);

// Mean of the pixels that show a surface.
float meanOnSurfaces(const Pictures& p, const std::string& show) {
    double sum = 0.0;
    unsigned count = 0;
    for (unsigned y = 0; y < p.size.y; ++y) {
        for (unsigned x = 0; x < p.size.x; ++x) {
            if (p.hasSurface(x, y)) {
                sum += p.value(show, x, y);
                ++count;
            }
        }
    }
    return static_cast<float>(sum / std::max(count, 1U));
}

float meanOfBlock(const Pictures& p, const std::string& show, unsigned left, unsigned top, unsigned side) {
    float sum = 0.0F;
    for (unsigned y = top; y < top + side; ++y) {
        for (unsigned x = left; x < left + side; ++x) {
            sum += p.value(show, x, y);
        }
    }
    return sum / static_cast<float>(side * side);
}

// A convex body in a white environment: every ray must reach the environment, and all energy must come back.
struct FurnaceCase {
    const char* name;
    float roughness;
    float metallic;
    bool lambertOnly;
};

class Furnace : public testing::TestWithParam<FurnaceCase> {};

TEST_P(Furnace, AWhiteSphereInAWhiteEnvironmentIsWhite) {
    Material material = lambertMaterial(vec3(1.0F));
    material.roughness = GetParam().roughness;
    material.metallic = GetParam().metallic;
    View view = viewFrom({0, 0, 4}, {0, 0, 0});
    view.environment.radiance = vec3(1.0F);
    Settings settings;
    settings.materials.lambertOnly = GetParam().lambertOnly ? 1 : 0;
    settings.diffuse.rays = 1;
    settings.specular.rays = 64;
    const Pictures p = render(sceneOf(material, builtin::sphere(1.0F, 96)), view, size, settings, {"final", "depth"});
    EXPECT_NEAR(meanOnSurfaces(p, "final"), 1.0F, 0.01F);
    // The weights of sampled rays vary by up to their mean, which leaves 1 / 8 for the 64 rays of a pixel and 1 / 40
    // for those of 5 x 5 pixels; those of mirrors and Lambert surfaces do not vary.
    const bool drawn = !GetParam().lambertOnly && GetParam().roughness > 0.0F;
    const unsigned block = drawn ? 5 : 1;
    for (unsigned y = 0; y < size.y; y += block) {
        for (unsigned x = 0; x < size.x; x += block) {
            EXPECT_NEAR(meanOfBlock(p, "final", x, y, block), 1.0F, drawn ? 0.1F : 0.01F) << x << ", " << y;
        }
    }
    expectSilentValidation("the furnace");
}

INSTANTIATE_TEST_SUITE_P(
    Materials, Furnace,
    testing::Values(FurnaceCase{"lambert", 1.0F, 0.0F, true}, FurnaceCase{"dielectric_smooth", 0.0F, 0.0F, false},
                    FurnaceCase{"dielectric_half", 0.5F, 0.0F, false},
                    FurnaceCase{"dielectric_rough", 1.0F, 0.0F, false}, FurnaceCase{"metal_smooth", 0.0F, 1.0F, false},
                    FurnaceCase{"metal_half", 0.5F, 1.0F, false}, FurnaceCase{"metal_rough", 1.0F, 1.0F, false}),
    [](const auto& furnace) { return furnace.param.name; });

TEST(Indirect, RaysThatLeaveTheScreenAreAnsweredByTheEnvironment) {
    View view = viewFrom({0, 3, 6}, {0, 0, 0});
    view.environment.radiance = {1.0F, 0.5F, 0.25F};
    const Scene scene = sceneOf(lambertMaterial(vec3(0.5F)), builtin::ground({50, 50}, {1, 1}, {1, 1}));
    const Pictures p = render(scene, view, size, settingsOf({"materials.lambert_only=true"}),
                              {"indirect_diffuse", "diffuse_source", "diffuse_confidence", "diffuse_radiance"});
    for (unsigned x = 0; x < size.x; x += 5) {
        const vec3 got = p.color("indirect_diffuse", x, 80);
        for (int c = 0; c < 3; ++c) {
            EXPECT_NEAR(got[c], 0.5F * view.environment.radiance[c], 0.005F) << x;
        }
        EXPECT_EQ(p.value("diffuse_confidence", x, 80), 0.0F) << "nothing on the screen was met";
        EXPECT_NEAR(p.value("diffuse_source", x, 80, 2), 0.9F, 0.01F) << "the weights of a ray sum to 1";
    }
}

TEST(Indirect, UniformAndCosineRaysConvergeToTheSameLight) {
    View view = viewFrom({0, 3, 6}, {0, 1, 0});
    Scene scene = sceneOf(lambertMaterial(vec3(0.5F)), builtin::ground({5, 5}, {1, 1}, {1, 1}));
    Material lamp = lambertMaterial(vec3(0.0F));
    lamp.emissive = vec3(2.0F);
    lamp.doubleSided = true;
    builtin::place(scene, "wall", builtin::addMaterial(scene, lamp),
                   builtin::patch({{0, 1, -2}, {3, 0, 0}, {0, 1, 0}, {1, 1}, {1, 1}}));
    const std::vector<std::string> base{"materials.lambert_only=true", "diffuse.rays=64", "trace_screen.step=0.1",
                                        "trace_screen.max_steps=100"};
    auto withUniform = base;
    withUniform.emplace_back("diffuse.distribution=uniform");
    const Pictures cosine = render(scene, view, size, settingsOf(base), {"indirect_diffuse", "depth"});
    const Pictures uniform = render(scene, view, size, settingsOf(withUniform), {"indirect_diffuse", "depth"});
    const float mean = meanOnSurfaces(cosine, "indirect_diffuse");
    EXPECT_GT(mean, 0.02F);
    EXPECT_NEAR(meanOnSurfaces(uniform, "indirect_diffuse"), mean, 0.02F * mean);
}

// Irradiance at a point of the floor, `far` in front of a wall of radiance 1 and that height, of which it sees `width`
// to one side (form factor of an element to a perpendicular rectangle at its corner; Howell, A Catalog of Radiation
// Heat Transfer Configuration Factors).
float wallIrradiance(float width, float height, float far) {
    const float a = width / far;
    const float b = height / far;
    const float root = std::sqrt(1.0F + b * b);
    return 0.5F * (std::atan(a) - std::atan(a / root) / root);
}

TEST(Indirect, LightOfAGlowingWallOnTheFloorIsItsFormFactor) {
    const float half = 1.5F;
    const float height = 1.0F;
    View view = viewFrom({0, 4, 7}, {0, 0.5F, 0});
    Scene scene = sceneOf(lambertMaterial(vec3(1.0F)), builtin::ground({4, 4}, {1, 1}, {1, 1}));
    Material lamp = lambertMaterial(vec3(0.0F));
    lamp.emissive = vec3(1.0F);
    builtin::place(scene, "wall", builtin::addMaterial(scene, lamp),
                   builtin::patch({{0, 0.5F * height, 0}, {half, 0, 0}, {0, 0.5F * height, 0}, {1, 1}, {1, 1}}));
    const Pictures p = render(scene, view, size,
                              settingsOf({"materials.lambert_only=true", "diffuse.rays=256", "trace_screen.step=0.03",
                                          "trace_screen.max_steps=200", "trace_screen.thickness=0.1"}),
                              {"indirect_diffuse", "depth"});
    float sum = 0.0F;
    float expected = 0.0F;
    unsigned count = 0;
    for (unsigned y = 0; y < size.y; ++y) {
        for (unsigned x = 0; x < size.x; ++x) {
            const vec3 at = p.hasSurface(x, y) ? p.position(x, y) : vec3(100.0F);
            if (std::abs(at.y) < 0.01F && at.z > 0.1F && at.z < 2.5F && std::abs(at.x) < 1.2F) {
                sum += p.value("indirect_diffuse", x, y);
                expected += (wallIrradiance(half - at.x, height, at.z) + wallIrradiance(half + at.x, height, at.z)) /
                            glm::pi<float>();
                ++count;
            }
        }
    }
    ASSERT_GT(count, 400U);  // of 256 rays each: noise of under 1 %
    EXPECT_NEAR(sum / expected, 1.0F, 0.03F);
}

TEST(Indirect, AFloorMirrorShowsThePictureFlipped) {
    // A glowing board stands on a mirror. Where a reflected ray meets the board, the mirror shows what it emits; where
    // it passes the board, the mirror is black.
    const View view = viewFrom({0, 1.5F, 5}, {0, 0.7F, 0});
    Material mirror = lambertMaterial(vec3(1.0F));
    mirror.metallic = 1.0F;
    mirror.roughness = 0.0F;
    Scene scene = sceneOf(mirror, builtin::ground({4, 4}, {1, 1}, {1, 1}));
    Material board = lambertMaterial(vec3(0.0F));
    board.emissive = {1.0F, 0.5F, 0.25F};
    const vec2 half(1.0F, 0.75F);
    builtin::place(scene, "board", builtin::addMaterial(scene, board),
                   builtin::patch({{0, 0.8F, 0}, {half.x, 0, 0}, {0, half.y, 0}, {1, 1}, {1, 1}}));
    const Pictures p = render(scene, view, size,
                              settingsOf({"diffuse.rays=0", "trace_screen.step=0.02", "trace_screen.max_steps=400",
                                          "trace_screen.thickness=0.05", "trace_screen.count_hits=true"}),
                              {"indirect_specular", "specular_hit_distance", "depth"});
    unsigned shown = 0;
    for (unsigned y = 0; y < size.y; ++y) {
        for (unsigned x = 0; x < size.x; ++x) {
            const vec3 at = p.hasSurface(x, y) ? p.position(x, y) : vec3(0, 9, 0);
            if (std::abs(at.y) > 1e-3F || at.z < 0.05F) {
                continue;  // not the floor before the board
            }
            const vec3 d = pixelDirection(view.camera, size, x, y) * vec3(1, -1, 1);
            const vec3 hit = at + d * (-at.z / d.z);
            const float inside = std::min(half.x - std::abs(hit.x), half.y - std::abs(hit.y - 0.8F));
            if (inside > 0.06F) {
                EXPECT_NEAR(p.color("indirect_specular", x, y).r, 1.0F, 0.02F) << hit.x << ", " << hit.y;
                EXPECT_NEAR(p.color("indirect_specular", x, y).b, 0.25F, 0.01F);
                EXPECT_NEAR(p.value("specular_hit_distance", x, y), glm::length(hit - at), 0.1F);
                ++shown;
            } else if (inside < -0.06F) {
                EXPECT_EQ(p.color("indirect_specular", x, y).r, 0.0F) << hit.x << ", " << hit.y;
            }
        }
    }
    EXPECT_GT(shown, 500U);
}

// Half of a rough mirror's rays miss the board: the mean is that of the others.
TEST(Indirect, TheHitDistanceIsThatOfTheRaysThatHit) {
    const View view = viewFrom({0, 1.5F, 5}, {0, 0.7F, 0});
    Material rough = lambertMaterial(vec3(1.0F));
    rough.metallic = 1.0F;
    rough.roughness = 0.5F;
    Scene scene = sceneOf(rough, builtin::ground({4, 4}, {1, 1}, {1, 1}));
    builtin::place(scene, "board", builtin::addMaterial(scene, lambertMaterial(vec3(0.5F))),
                   builtin::patch({{0, 0.8F, 0}, {1.0F, 0, 0}, {0, 0.75F, 0}, {1, 1}, {1, 1}}));
    const std::vector<std::string> settings{"diffuse.rays=2", "specular.rays=10", "trace_screen.count_hits=true"};
    const std::vector<std::string> shows{"specular_hit_distance", "specular_confidence", "hit_distance", "final"};
    const Pictures p = render(scene, view, size, settingsOf(settings), shows);
    unsigned mixed = 0;
    unsigned none = 0;
    for (unsigned y = 0; y < size.y; ++y) {
        for (unsigned x = 0; x < size.x; ++x) {
            const float distance = p.value("specular_hit_distance", x, y);
            const float share = p.value("specular_confidence", x, y);
            ASSERT_LT(distance, 12.0F) << "the scene is smaller, at " << x << ", " << y;
            ASSERT_EQ(distance > 0.0F, share > 0.004F) << share << " at " << x << ", " << y;
            ASSERT_EQ(distance, p.value("hit_distance", x, y, 1));
            mixed += share > 0.2F && share < 0.8F ? 1 : 0;
            none += share == 0.0F ? 1 : 0;
        }
    }
    EXPECT_GT(mixed, 200U);
    EXPECT_GT(none, 200U);
    // Counting takes lists of rays; without it, they are traced at once, in two batches.
    const Pictures uncounted = render(scene, view, size, settingsOf({"diffuse.rays=2", "specular.rays=10"}), {"final"});
    EXPECT_EQ(p.images.at("final").data, uncounted.images.at("final").data) << "counting changes the picture";
}

TEST(Indirect, ARayWithoutStepsLeftMisses) {
    const View view = viewFrom({0, 1.5F, 5}, {0, 0.7F, 0});
    Material mirror = lambertMaterial(vec3(1.0F));
    mirror.metallic = 1.0F;
    mirror.roughness = 0.0F;
    Scene scene = sceneOf(mirror, builtin::ground({4, 4}, {1, 1}, {1, 1}));
    Material board = lambertMaterial(vec3(0.0F));
    board.emissive = vec3(1.0F);
    builtin::place(scene, "board", builtin::addMaterial(scene, board),
                   builtin::patch({{0, 0.8F, 0}, {1, 0, 0}, {0, 0.75F, 0}, {1, 1}, {1, 1}}));
    const auto reflected = [&](unsigned steps) {
        const Pictures p =
            render(scene, view, size,
                   settingsOf({"diffuse.rays=0", "trace_screen.method=linear", "trace_screen.step=0.02",
                               "trace_screen.thickness=0.05", "trace_screen.max_steps=" + std::to_string(steps)}),
                   {"indirect_specular", "depth"});
        float farthest = 0.0F;  // of the floor points that reflect the board
        for (unsigned y = 0; y < size.y; ++y) {
            const bool floor = p.hasSurface(size.x / 2, y) && std::abs(p.position(size.x / 2, y).y) < 1e-3F;
            if (floor && p.value("indirect_specular", size.x / 2, y) > 0.0F) {
                farthest = std::max(farthest, p.position(size.x / 2, y).z);
            }
        }
        return farthest;
    };
    // 20 steps of 2 cm reach 40 cm; the board is no farther than that from the points that see it.
    EXPECT_LT(reflected(20), 0.4F);
    EXPECT_GT(reflected(400), 1.5F);
}

TEST(Indirect, TheLastFramesLightBringsFurtherBouncesUpToTheirSum) {
    // Two mirrors would never converge; two grey surfaces converge to the sum of a geometric series.
    View view = viewFrom({0, 3, 6}, {0, 1, 0});
    view.sun = builtin::sun(glm::normalize(vec3(0.3F, -1.0F, -0.5F)), vec3(3.0F));
    Scene scene = sceneOf(lambertMaterial(vec3(0.8F)), builtin::ground({3, 3}, {1, 1}, {1, 1}));
    builtin::place(scene, "wall", 0, builtin::patch({{0, 1, -2}, {3, 0, 0}, {0, 1, 0}, {1, 1}, {1, 1}}));
    const auto meanAfter = [&](const char* light, uint32_t frames) {
        return meanOnSurfaces(render(scene, view, size,
                                     settingsOf({"materials.lambert_only=true", "diffuse.rays=16",
                                                 std::string("trace_screen.light=") + light}),
                                     {"indirect_diffuse", "depth"}, frames),
                              "indirect_diffuse");
    };
    EXPECT_EQ(meanAfter("previous", 1), meanAfter("direct", 1)) << "there is no last frame yet";
    const float one = meanAfter("direct", 12);
    const float many = meanAfter("previous", 12);
    EXPECT_GT(one, 0.01F);
    EXPECT_GT(many, 1.02F * one);
    EXPECT_LT(many, one / (1.0F - 0.8F));
    expectSilentValidation("feedback");
}

TEST(Indirect, LambertOnlyHasNoReflections) {
    View view = viewFrom({0, 3, 6}, {0, 0, 0});
    view.environment.radiance = vec3(1.0F);
    Material mirror = lambertMaterial(vec3(0.5F));
    mirror.metallic = 1.0F;
    mirror.roughness = 0.0F;
    const Pictures p = render(sceneOf(mirror, builtin::ground({5, 5}, {1, 1}, {1, 1})), view, size,
                              settingsOf({"materials.lambert_only=true"}), {"indirect_specular", "indirect_diffuse"});
    EXPECT_EQ(rangeOf(p.images.at("indirect_specular")).max, 0.0F);
    EXPECT_NEAR(p.value("indirect_diffuse", 80, 80), 0.5F, 0.01F);
}

}  // namespace
}  // namespace reflet::test::indirect_test
